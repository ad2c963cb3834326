"""SO-101: what does the freest static law leave of the measured joint's motions?

To the joint of `so101_diagnosis.py` comes dry friction that sticks and falls with speed, then a law as free
as it may be in speed (odd and even steps at four speeds), a ripple of the motor's turn with three harmonics,
and four waves over the whole travel. All are fitted in free runs, from what the diagnosis has found: to the
motions that it fits, and once to the test motions themselves, where nothing of the kind should do better.

    python examples/so101_bound.py [--data DIR]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from inertance import Network, fit, parameter, rotational
from inertance.identification import Campaign, Fit
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parent))

import so101_diagnosis as joint

Array = NDArray[np.float64]
SPEEDS = (0.1, 0.3, 1.0, 3.0)  # rad/s
TURN = 2 * np.pi / 345  # rad of the arm a turn of the motor
RIPPLES = tuple(TURN / harmonic for harmonic in (1, 2, 3))
WAVES = tuple(2 * np.pi / harmonic for harmonic in (1, 2, 3, 4))
LAWS = {
    "dry friction that falls with speed": ((), ()),
    "and any law of speed": (SPEEDS, ()),
    "and a ripple of the motor": (SPEEDS, RIPPLES),
    "and any law of position": (SPEEDS, RIPPLES + WAVES),
}
FREE = {"min": -3.0, "max": 3.0}  # N.m


class Step(rotational.CompliantWithSpeed):
    """Steps of torque about a speed: tau = odd tanh(x) + even x^2/(1 + x^2) with x = w_rel/w_0."""

    odd = parameter("N.m", "torque that turns its sign with the speed", default=0.0)
    even = parameter("N.m", "torque that does not", default=0.0)
    w_0 = parameter("rad/s", "speed at which it rises", above=0)

    def equations(self) -> Iterator[Any]:
        x = self.w_rel / self.w_0
        yield self.tau == self.odd * ca.tanh(x) + self.even * x**2 / (1 + x**2)


class Wave(rotational.Compliant):
    """A wave over the angle: tau = c cos(2 pi phi_rel/period) + s sin(2 pi phi_rel/period)."""

    c = parameter("N.m", "share of the cosine", default=0.0)
    s = parameter("N.m", "share of the sine", default=0.0)
    period = parameter("rad", "angle after which it comes back", above=0)

    def equations(self) -> Iterator[Any]:
        at = 2 * ca.pi * self.phi_rel / self.period
        yield self.tau == self.c * ca.cos(at) + self.s * ca.sin(at)


def servo(steps: tuple[float, ...], waves: tuple[float, ...]) -> Network:
    """Return the joint with dry friction, as its diagnosis found it, and a law that does nothing yet."""
    net = joint.servo()
    parts: dict[str, rotational.Compliant] = {
        f"step_{n}": Step(w_0=speed) for n, speed in enumerate(steps, start=1)
    }
    parts |= {f"wave_{n}": Wave(period=period) for n, period in enumerate(waves, start=1)}
    dry = rotational.StribeckFriction(tau_c=0.057, tau_s=0.078, w_s=0.09)
    for name, part in {"dry": dry, **parts}.items():
        net.add(**{name: part}).connect(net.base.flange, part.flange_a).connect(part.flange_b, net.arm.flange)
    net.stiffness.k, net.damping.d = 7.4, 0.6
    return net


def fitted(directory: Path, law: str, motions: Mapping[str, tuple[float, float]]) -> Fit:
    """Return the joint with a law, fitted to some of the motions."""
    steps, waves = LAWS[law]
    dry = {f"dry.{name}": {"rel": 1.0} for name in ("tau_c", "tau_s", "w_s")}
    free = [f"step_{n}.{part}" for n in range(1, len(steps) + 1) for part in ("odd", "even")]
    free += [f"wave_{n}.{part}" for n in range(1, len(waves) + 1) for part in "cs"]
    priors = {**joint.PARAMETERS, **dry, **dict.fromkeys(free, FREE)}
    judging = {} if motions == joint.TESTED else joint.TESTED
    train, test = (joint.records(directory, some) for some in (motions, judging))
    return fit(Campaign(servo(steps, waves), joint.CHANNELS, priors, train, test), rtol=1e-5)


def left(found: Fit) -> float:
    """Return what free runs miss of the test motions, over how much these move."""

    def apart() -> Iterator[tuple[Array, Array]]:
        for compared in found.comparisons:
            measured = compared.experiment.record.values["position"]
            if Path(compared.experiment.source).stem in joint.TESTED:
                missed = measured - compared.after["position"]
                yield missed - missed.mean(), measured - measured.mean()

    missed, moved = (np.concatenate(parts) for parts in zip(*apart(), strict=True))
    return float(np.std(missed) / np.std(moved))


def main() -> None:
    """Print what each law leaves."""
    parser = argparse.ArgumentParser(description="SO-101: what the freest static law leaves.")
    parser.add_argument(
        "--data", type=Path, default=joint.DATA, help="directory of the records (%(default)s)"
    )
    options = parser.parse_args()
    for name in (*joint.FITTED, *joint.TESTED):
        if not (options.data / f"{name}.csv").is_file():
            sys.exit(joint.MISSING.format(file=f"{name}.csv", directory=options.data))
    print(f"{'missed of the test motions':38}{'fitted to others':>18}{'to themselves':>16}")
    for law in LAWS:
        shares = (left(fitted(options.data, law, motions)) for motions in (joint.FITTED, joint.TESTED))
        print(
            f"{law:38}"
            + "".join(f"{share:{width}.2%}" for share, width in zip(shares, (18, 16), strict=True))
        )


if __name__ == "__main__":
    main()
