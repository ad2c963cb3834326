"""Machines that put FMUs to the test: sticking, clearance, stops, a loop of equations, a thousand masses.

    inertance fmu check examples/fmu_models.py:stick_slip --stop 4
    python examples/fmu_models.py [NAME ...]

prints for each machine how far its FMUs (FMI 2.0 and 3.0, Model Exchange and Co-Simulation) are from the
native run, and ends with exit code 1 if one of them is too far.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, field

import inertance as ia
from inertance.fmu import CheckReport
from inertance.machines import Sinusoid

ROLLING = ("inerter.screw.contact", "inerter.flywheel.planet")


def pfi_rig() -> ia.Network:
    """The planetary flywheel inerter on its rig, 5 mm at 0.5 Hz: it sticks, and its clearances open."""
    return ia.machines.inerter_rig(ia.machines.ge_wang.planetary_inerter(), Sinusoid(0.005, 0.5))


def tid_quarter_car() -> ia.Network:
    """A quarter car with a tuned inerter damper in its strut, over a swell of the road."""
    strut = ia.machines.suspension("S5", k=6e4, d=3.2e3, b=330.0, k_b=3e4)
    car = ia.Network(
        "TID quarter car",
        road=ia.Position(s_ref=Sinusoid(0.02, 1.5)),
        tyre=ia.SpringDamper(k=1.5e5, d=100.0),
        wheel=ia.Mass(m=35.0),
        strut=strut,
        body=ia.Mass(m=250.0),
        wind=ia.Force(),
    )
    car.connect(car.road.flange, car.tyre.flange_a)
    car.connect(car.tyre.flange_b, car.wheel.flange, car.strut.flange_a)
    return car.connect(car.strut.flange_b, car.body.flange, car.wind.flange)


def stick_slip() -> ia.Network:
    """A block on a moving belt, held back by a spring: it sticks and slips for ever."""
    net = ia.Network(
        "stick-slip",
        belt=ia.Speed(v_ref=0.1),
        rub=ia.StribeckFriction(f_c=5.0, f_s=8.0, v_s=0.05),
        block=ia.Mass(m=1.0),
        spring=ia.Spring(k=100.0),
        wall=ia.Fixed(),
    )
    net.connect(net.belt.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.block.flange, net.spring.flange_b)
    return net.connect(net.wall.flange, net.spring.flange_a)


def bouncing_ball() -> ia.Network:
    """A ball that bounces ever lower and comes to rest."""
    net = ia.Network(
        "bouncing ball",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-0.5 * 9.81),
    )
    net.connect(net.floor.flange, net.stop.flange_a)
    return net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange)


def two_stops() -> ia.Network:
    """Two balls of different mass that strike the floor at the same instant, and then part."""
    net = ia.Network("two stops", floor=ia.Fixed())
    for name, m, e in (("light", 0.5, 0.7), ("heavy", 1.5, 0.5)):
        stop, ball, weight = f"{name}_stop", f"{name}_ball", f"{name}_weight"
        net.add(**{stop: ia.HardStop(e=e), ball: ia.Mass(m=m, s=1.0)})
        net.add(**{weight: ia.ConstantForce(f_constant=-9.81 * m)})
        net.connect(net.floor.flange, getattr(net, stop).flange_a)
        net.connect(getattr(net, stop).flange_b, getattr(net, ball).flange, getattr(net, weight).flange)
    return net


def loop() -> ia.Network:
    """Two cubic springs in line: the place between them is the root of a cubic equation."""
    net = ia.Network(
        "loop",
        wall=ia.Fixed(),
        inner=ia.CubicSpring(k=100.0, k3=1e4),
        outer=ia.CubicSpring(k=50.0, k3=3e4),
        mass=ia.Mass(m=1.0, s=0.1),
        damper=ia.Damper(d=1.0),
    )
    net.connect(net.wall.flange, net.inner.flange_a, net.damper.flange_a)
    net.connect(net.inner.flange_b, net.outer.flange_a)
    return net.connect(net.outer.flange_b, net.mass.flange, net.damper.flange_b)


def chain(count: int = 1000) -> ia.Network:
    """A chain of masses, along which a pulse runs."""
    net = ia.Network("chain", wall=ia.Fixed())
    last = net.wall.flange
    for k in range(count):
        link, mass = ia.SpringDamper(k=1e4, d=5.0), ia.Mass(m=1.0, **({} if k else {"s": 0.01}))
        net.add(**{f"link{k}": link, f"mass{k}": mass})
        net.connect(last, link.flange_a)
        net.connect(link.flange_b, mass.flange)
        last = mass.flange
    return net


@dataclass(frozen=True)
class Case:
    """A machine, how long it runs [s], what it shows and how it starts."""

    build: Callable[[], ia.Network]
    stop: float
    outputs: list[str]
    start: dict[str, float] = field(default_factory=dict)
    inputs: dict[str, float] = field(default_factory=dict)
    step: float | None = None


CASES = {
    "pfi_rig": Case(
        pfi_rig,
        2.0,
        ["inerter.flange_a.f"],
        {f"{c}.{x}": 0.0 for c in ROLLING for x in ("s_rel", "v_rel")},
        step=1e-3,
    ),
    "tid_quarter_car": Case(
        tid_quarter_car, 2.0, ["body.s", "body.a", "tyre.f", "strut.f"], inputs={"wind.f": -50.0}
    ),
    "stick_slip": Case(stick_slip, 4.0, ["block.s", "block.v", "rub.f"], {"rub.v_rel": 0.0}),
    "bouncing_ball": Case(bouncing_ball, 3.0, ["ball.s", "ball.v"]),
    "two_stops": Case(two_stops, 1.5, ["light_ball.s", "light_ball.v", "heavy_ball.v"]),
    "loop": Case(loop, 2.0, ["mass.s", "mass.a", "inner.f", "inner.s_rel"]),
    "chain": Case(chain, 0.5, ["mass0.s", "mass0.a", "mass20.v", "link30.f"]),
}


def check(name: str, **options: object) -> CheckReport:
    """Return the check of one of the machines."""
    case = CASES[name]
    return ia.fmu.check_fmu(
        case.build(), case.stop, step=case.step, start=case.start, inputs=case.inputs, outputs=case.outputs,
        **options,  # type: ignore[arg-type]
    )  # fmt: skip


def main(names: list[str]) -> int:
    """Check some machines, print the tables, and return the exit code."""
    failed = 0
    for name in names or CASES:
        report = check(name)
        print(report, end="\n\n", flush=True)
        failed += not report.passed
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
