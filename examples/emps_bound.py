"""EMPS: what could any law of position, speed, direction and memory explain of the measured axis?

The force of the drive, as its command tells it, less what a law makes of the measured motion. Laws are linear
in mass, viscous friction, a bias, dry friction, friction that builds up over 0.2 mm (Dahl) and splines over
position, over speed, and over position times direction: far freer than any effect of a diagnosis. They are
fitted to the estimation record, and once to the record with pulses itself, where nothing of the kind can do
better. Both channels go through the same filter.

    python examples/emps_bound.py [--data DIR]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parent))

import emps
from inertance.identification import Filter

Array = NDArray[np.float64]
GAIN = 35.1507  # [N/V] of the drive
RATE, CUTOFF = 1000.0, 60.0  # [Hz]
KEPT = slice(200, -500)  # samples, away from the ends of the filter
REST_SPEED, PRESLIDING = 3e-4, 2e-4  # [m/s], [m]
TRAVEL, SPEED = (0.0, 0.25), (-0.13, 0.13)  # [m], [m/s]
LAWS = {
    "mass, viscous friction": (),
    "and dry friction": ("dry",),
    "and that builds up": ("dry", "built"),
    "and by speed": ("dry", "speed"),
    "and by position": ("dry", "speed", "place"),
    "and by position and direction": ("dry", "speed", "place", "side"),
    "and all that": ("dry", "built", "speed", "place", "side"),
}


class Motion:
    """A record as position [m], speed, acceleration and force [N]."""

    def __init__(self, record: emps.Record) -> None:
        low = Filter(cutoff=CUTOFF)
        q, force = low.apply(record.qm, RATE), low.apply(GAIN * record.vir, RATE)
        v = np.gradient(q, 1 / RATE)
        self.q, self.v, self.a, self.force = (x[KEPT] for x in (q, v, np.gradient(v, 1 / RATE), force))

    def columns(self, parts: Sequence[str]) -> Array:
        """Return what a law is linear in, each column with mean square 1."""
        side = np.tanh(self.v / REST_SPEED)[:, None]
        of: dict[str, Callable[[], Array]] = {
            "dry": lambda: side,
            "built": lambda: built(self.q),
            "speed": lambda: splines(self.v, *SPEED, 60),
            "place": lambda: splines(self.q, *TRAVEL, 120),
            "side": lambda: splines(self.q, *TRAVEL, 120) * side,
        }
        plain = np.column_stack([self.a, self.v, np.ones(len(self.q))])
        return np.hstack([plain, *(of[part]() for part in parts)])


def splines(x: Array, low: float, high: float, pieces: int) -> Array:
    """Return cubic B-splines over a range at values."""
    from scipy.interpolate import BSpline

    knots = np.concatenate([[low] * 3, np.linspace(low, high, pieces + 1), [high] * 3])
    matrix: Array = BSpline.design_matrix(np.clip(x, low, high - 1e-12), knots, 3).toarray()
    return matrix


def built(q: Array) -> Array:
    """Return the share of dry friction that has built up: PRESLIDING dz = dq - |dq| z."""
    z = np.zeros(len(q))
    for n, (one, other) in enumerate(pairwise(q.tolist()), start=1):
        moved = (other - one) / PRESLIDING
        z[n] = z[n - 1] + moved - abs(moved) * z[n - 1]
    return z[:, None]


class Fit:
    """Least squares in columns of a law, in which large weights may cost a little."""

    def __init__(self, columns: Array, force: Array) -> None:
        self.size = np.sqrt(np.mean(columns**2, axis=0)) + 1e-12
        scaled = columns / self.size
        self.squares, self.products = scaled.T @ scaled / len(scaled), scaled.T @ force / len(scaled)

    def weights(self, ridge: float) -> Array:
        """Return the best weights, `ridge` being what a large one costs."""
        normal = self.squares + ridge * np.eye(len(self.size))
        found: Array = np.linalg.solve(normal, self.products) / self.size
        return found


def bounds(train: Motion, test: Motion) -> dict[str, tuple[float, float]]:
    """Return by law what it misses of the test [N]: fitted to the training record, and to the test itself.

    Of how much large weights may cost, what is best for the test is taken, which flatters the law.
    """
    found = {}
    for name, parts in LAWS.items():
        columns = test.columns(parts)
        trained, own = Fit(train.columns(parts), train.force), Fit(columns, test.force)
        weights = [*(trained.weights(10.0**-power) for power in range(2, 9)), own.weights(1e-9)]
        left = np.std(test.force[:, None] - columns @ np.column_stack(weights), axis=0)
        found[name] = float(left[:-1].min()), float(left[-1])
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="EMPS: what no law of its motion explains.")
    parser.add_argument("--data", type=Path, default=emps.DATA, help="directory of the records (%(default)s)")
    options = parser.parse_args()
    for file in emps.FILES.values():
        if not (options.data / file).is_file():
            sys.exit(emps.MISSING.format(file=file, directory=options.data))
    train, test = (Motion(emps.load(options.data / file)) for file in emps.FILES.values())
    size = float(np.std(test.force))
    print(f"{'missed of the test record':34}{'trained':>16}{'fitted to it':>18}")
    for name, found in bounds(train, test).items():
        print(f"{name:34}" + "".join(f"{rms:8.2f} N {rms / size:6.1%}" for rms in found))


if __name__ == "__main__":
    main()
