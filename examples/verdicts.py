"""One case for each verdict: a carriage on a spring and a guide, and data of a machine that differs.

The machine that is measured differs each time, the model never: nothing at all, parameters only, friction,
more of everything by 3 % (a heavier carriage, or a position sensor that reads 3 % low: a force alone cannot
tell), a stop that no known effect is like but a law of position is, and a part that hangs on it and swings,
which no law is.

    python examples/verdicts.py [CASE]
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from textwrap import shorten

import numpy as np
from inertance import (
    CoulombFriction,
    Damper,
    ElastoGap,
    Fixed,
    Force,
    Mass,
    Network,
    Sampled,
    Spring,
    SpringDamper,
    diagnose,
)
from inertance.diagnosis import Verdict
from inertance.identification import Campaign, Multisine, Record, sampled

RATE, DURATION, NOISE = 250.0, 8.0, 2e-5


def rig(k: float = 800.0, d: float = 6.0, m: float = 2.0) -> Network:
    """Return the carriage as it is modelled, with its stiffness, damping and mass."""
    net = Network(
        "carriage", wall=Fixed(), spring=Spring(k=k), guide=Damper(d=d), carriage=Mass(m=m), push=Force()
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)


def with_friction() -> Network:
    """Return the carriage with 0.8 N of dry friction in its guide."""
    net = rig(k=820.0).add(rail=CoulombFriction(f_c=0.8))
    net.connect(net.wall.flange, net.rail.flange_a)
    return net.connect(net.rail.flange_b, net.carriage.flange)


def with_a_stop() -> Network:
    """Return the carriage with a rubber stop 12 mm to one side, which it strikes now and then."""
    net = rig(k=820.0).add(stop=ElastoGap(k=2e4, d=5.0, s_rel0=-0.012))
    net.connect(net.wall.flange, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.carriage.flange)


def with_a_pendant() -> Network:
    """Return the carriage with 0.3 kg on a soft spring of its own, which swings at 4 Hz."""
    net = rig(k=820.0).add(hanger=SpringDamper(k=190.0, d=0.4), pendant=Mass(m=0.3))
    net.connect(net.carriage.flange, net.hanger.flange_a)
    return net.connect(net.hanger.flange_b, net.pendant.flange)


def random_force(seed: int) -> Sampled:
    """Return a random force from 0.5 to 8 Hz."""
    force = Multisine(rms=5.0, low=0.5, high=8.0, period=DURATION, seed=seed)
    return sampled(force, DURATION, RATE, fade=0.5)


def measured(machine: Network, force: Sampled, seed: int) -> Record:
    """Return what an instrument with noise records of a machine under a force."""
    run = machine.simulate(DURATION, inputs={"push.f": force}, step=1 / RATE, rtol=1e-9, atol=1e-11)
    s = run["carriage.s"][np.searchsorted(run.time, force.time + 1e-6, side="right") - 1]
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(s))
    return Record(f"run {seed}", force.time, {"F": force.values, "s": s + noise})


def verdict_on(machine: Network) -> Verdict:
    """Hold three records of a machine against the model: two are fitted, one is the test."""
    records = [
        {"record": measured(machine, random_force(seed), seed), "initial": "rest"} for seed in (1, 2, 3)
    ]
    campaign = Campaign(
        rig(),
        channels={"F": {"input": "push.f", "unit": "N"}, "s": {"output": "carriage.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.1}},
        train=records[:2],
        test=records[2:],
        noise={"s": NOISE},
    )
    return diagnose(campaign)


CASES: dict[str, Callable[[], Verdict]] = {
    "none": lambda: verdict_on(rig()),
    "parameters": lambda: verdict_on(rig(k=980.0, d=9.0)),
    "effect": lambda: verdict_on(with_friction()),
    "ambiguous": lambda: verdict_on(rig(k=824.0, d=6.18, m=2.06)),
    "law": lambda: verdict_on(with_a_stop()),
    "unknown": lambda: verdict_on(with_a_pendant()),
}


def main() -> None:
    """Print the verdicts."""
    for name in sys.argv[1:] or CASES:
        found = CASES[name]()
        print(f"{name}: {found.verdict}. {found.sentence}")
        for line in found.lines:
            print(f"  {shorten(line, 110)}")
        if found.next_experiment:
            print(f"  next: {found.next_experiment}")


if __name__ == "__main__":
    main()
