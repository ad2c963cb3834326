"""Random trees of shafts, gears, clutches, screws and carriages: reaction, power, order of parts."""

import re
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from inertance import rotational as turning

FEW = settings(derandomize=True, max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow])
LOSSES = ((0.0, 0.9, 0.8, 0.02, 0.03), (10.0, 0.7, 0.6, 0.05, 0.06))
Energy = Callable[[ia.Result, str, float], Any]


class Kind(NamedTuple):
    """An element of one size, joined to a body that turns (or slides) and to new bodies behind it."""

    make: Callable[[float], ia.Component]
    begin: str
    ends: tuple[str, ...] = ()
    stored: Energy = lambda run, name, v: 0.0
    lossless: bool = False


def spring(signal: str, stiffness: float = 9.0, gap: float = 0.0) -> Energy:
    def stored(run: ia.Result, name: str, v: float) -> Any:
        return 0.5 * stiffness * v * np.maximum(abs(run[f"{name}.{signal}"]) - gap, 0) ** 2

    return stored


def moving(signal: str, inertia: float = 1.0) -> Energy:
    return lambda run, name, v: 0.5 * inertia * v * run[f"{name}.{signal}"] ** 2


def added(*energies: Energy) -> Energy:
    return lambda run, name, v: sum(energy(run, name, v) for energy in energies)


def shafts(make: Callable[[float], ia.Component], **more: Any) -> Kind:
    return Kind(make, "turning flange_a", ("turning flange_b",), **more)


def carriages(make: Callable[[float], ia.Component], **more: Any) -> Kind:
    return Kind(make, "sliding flange_a", ("sliding flange_b",), **more)


def screws(make: Callable[[float], ia.Component], **more: Any) -> Kind:
    return Kind(make, "turning flange_r", ("sliding flange_t",), **more)


def loads(make: Callable[[float], ia.Component], **more: Any) -> Kind:
    return Kind(make, "turning flange", **more)


def planets(v: float) -> ia.Component:
    return ia.PlanetaryFlywheel(
        R=0.1, r=0.03, alpha=0.0, J_s=v, J_p=v, J_r=v, k_r=900 * v, c_r=v, g_r=0.01, T_pm=0.1 * v, T_pv=0.1
    )


def rubs(v: float) -> ia.Component:
    return turning.StribeckFriction(tau_c=0.2 * v, tau_s=0.3 * v, w_s=0.5)


KINDS = {
    "spring": shafts(lambda v: turning.Spring(c=9 * v), stored=spring("phi_rel")),
    "damper": shafts(lambda v: turning.Damper(d=v)),
    "strut": shafts(lambda v: turning.SpringDamper(c=9 * v, d=0.5), stored=spring("phi_rel")),
    "friction": shafts(rubs),
    "gear": shafts(lambda v: turning.IdealGear(ratio=-v), lossless=True),
    "worn": shafts(lambda v: turning.LossyGear(ratio=v, lossTable=LOSSES)),
    "mesh": shafts(
        lambda v: turning.GearMesh(r_a=1.0, r_b=v, k=90 * v, d=v, g=0.02), stored=spring("s_rel", 90, 0.02)
    ),
    "clutch": shafts(lambda v: turning.Clutch(fn_max=v, f_normalized=lambda t: np.sin(7 * t))),
    "freewheel": shafts(lambda v: turning.OneWayClutch(fn_max=v, f_normalized=0.1)),
    "bearing": loads(lambda v: turning.BearingFriction(friction=rubs(v))),
    "disk": loads(lambda v: ia.DiskFlywheel(m=2 * v, R=1.0), stored=moving("w")),
    "planets": loads(
        planets,
        stored=added(
            moving("bracket.w"), moving("planet.w_s", 4), moving("planet.w_p", 4),
            spring("planet.s_rel", 3600, 0.01),
        ),
    ),
    "planetary": Kind(
        lambda v: turning.IdealPlanetary(ratio=v),
        "turning sun", ("turning carrier", "turning ring"), lossless=True,
    ),
    "screw": screws(lambda v: ia.NutScrew(lead=v), lossless=True),
    "loose": screws(
        lambda v: ia.CompliantNutScrew(lead=3.0, m_r=v, k=90 * v, d=v, eps=0.02, friction=rubs(v)),
        stored=added(moving("nut.v"), spring("contact.s_rel", 90, 0.02)),
    ),
    "rack": screws(lambda v: ia.RackPinion(R=v), lossless=True),
    "wheel": screws(lambda v: ia.RollingWheel(R=v), lossless=True),
    "lever": carriages(lambda v: ia.Lever(ratio=-v), lossless=True),
    "backlash": carriages(lambda v: ia.Backlash(k=90 * v, d=v, eps=0.02), stored=spring("s_rel", 90, 0.02)),
    "inerter": carriages(lambda v: ia.Inerter(b=v), stored=moving("v_rel")),
}  # fmt: skip


class Body(NamedTuple):
    way: str
    size: float
    speed: float


class Part(NamedTuple):
    kind: str
    size: float
    joins: list[int]


Tree = tuple[list[Body], list[Part]]
size = st.sampled_from([0.5, 1.0, 2.0])


@st.composite
def trees(draw: st.DrawFn) -> Tree:
    """Draw bodies, the first a shaft, and parts that each go from one body to new ones."""
    bodies, parts = [Body("turning", draw(size), 3.0)], []
    for _ in range(draw(st.integers(2, 5))):
        at = draw(st.integers(0, len(bodies) - 1))
        kind = draw(st.sampled_from([n for n, k in KINDS.items() if k.begin.startswith(bodies[at].way)]))
        ends = KINDS[kind].ends
        parts.append(Part(kind, draw(size), [at, *range(len(bodies), len(bodies) + len(ends))]))
        speed = st.sampled_from([-1.0, 0.0, 2.0])
        bodies += [Body(end.split()[0], draw(size), draw(speed)) for end in ends]
    return bodies, parts


def ports(kind: str) -> list[str]:
    return [port.split()[1] for port in (KINDS[kind].begin, *KINDS[kind].ends)]


def network(tree: Tree, order: list[int] | None = None) -> ia.Network:
    bodies, parts = tree
    named: dict[str, ia.Component] = {}
    for i, body in enumerate(bodies):
        named[f"b{i}"] = turning.Inertia(J=body.size) if body.way == "turning" else ia.Mass(m=body.size)
    named |= {f"e{i}": KINDS[part.kind].make(part.size) for i, part in enumerate(parts)}
    names = list(named)
    net = ia.Network("tree", **{names[k]: named[names[k]] for k in order or range(len(names))})
    for i, part in enumerate(parts):
        for at, port in zip(part.joins, ports(part.kind), strict=True):
            net.connect(named[f"b{at}"].flange, getattr(named[f"e{i}"], port))
    return net


def speeds(tree: Tree) -> dict[str, float]:
    return {f"b{i}.{'w' if b.way == 'turning' else 'v'}": b.speed for i, b in enumerate(tree[0])}


def driven(tree: Tree, order: list[int]) -> ia.Result:
    """Run from rest under a torque on the first shaft."""
    net = network(tree, order).add(motor=turning.ConstantTorque(tau_constant=3.0))
    return net.connect(net.motor.flange, net.b0.flange).simulate(1.0, rtol=1e-9, atol=1e-11)


def into(run: ia.Result, port: str) -> Any:
    """What flows into an element at a port."""
    return run[f"{port}.tau" if f"{port}.tau" in run else f"{port}.f"]


def reactions(run: ia.Result, name: str) -> Iterator[Any]:
    """Sum of forces, and of torques, on an element."""
    for across, through in (("s", "f"), ("phi", "tau")):
        found = [n for n in run.names() if re.fullmatch(rf"{name}\.\w+\.{across}", n)]
        yield sum(run[n.removesuffix(across) + through] for n in found)


@FEW
@given(trees())
def test_drivetrains_react_and_lose_what_friction_takes(tree: Tree) -> None:
    bodies, parts = tree
    run = network(tree).simulate(1.0, guess=speeds(tree), rtol=1e-9, atol=1e-11)
    speed = [run[name] for name in speeds(tree)]
    energy: Any = sum(0.5 * body.size * v**2 for body, v in zip(bodies, speed, strict=True))
    balance: Any = sum(
        b.size * v * run[f"b{i}.a"] for i, (b, v) in enumerate(zip(bodies, speed, strict=True))
    )
    for i, part in enumerate(parts):
        kind, name = KINDS[part.kind], f"e{i}"
        pairs = zip(ports(part.kind), part.joins, strict=True)
        power = sum(into(run, f"{name}.{port}") * speed[body] for port, body in pairs)
        balance, energy = balance + power, energy + kind.stored(run, name, part.size)
        if part.kind not in ("disk", "planets", "loose"):
            for total in reactions(run, name):
                assert total == pytest.approx(0.0, abs=1e-9), part
        if kind.lossless:
            assert power == pytest.approx(0.0, abs=1e-8), part
    assert balance == pytest.approx(0.0, abs=1e-7 * max(1.0, energy[0]))
    assert np.diff(energy).max() <= 1e-7 * max(1.0, energy[0])


@FEW
@given(trees(), st.randoms(use_true_random=False))
def test_the_order_of_a_drivetrains_parts_changes_nothing(tree: Tree, random: Any) -> None:
    order = list(range(len(tree[0]) + len(tree[1])))
    random.shuffle(order)
    first, second = driven(tree, sorted(order)), driven(tree, order)
    for signal in speeds(tree):
        assert first[signal][-1] == pytest.approx(second[signal][-1], abs=1e-6)
