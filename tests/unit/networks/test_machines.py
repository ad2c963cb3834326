"""Ready machines: what goes in as power is stored or lost, in each of them."""

from collections.abc import Callable, Iterator
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.machines import (
    TMD,
    TMDI,
    BallScrewInerter,
    BilinearDamper,
    BumpStop,
    DigressiveDamper,
    PitchingBody,
    PlanetaryFlywheelInerter,
    RackPinionInerter,
    RigidBody,
)
from numpy.typing import NDArray

Array = NDArray[np.float64]
STRUT = ia.machines.suspension("S8", 20e3, 1200.0, 80.0, k_b=1e5, k_1=2e3, k_2=1e3)
STOPPED = ia.parallel(
    spring=ia.Spring(k=15e3),
    damper=BilinearDamper(d_c=600.0, d_r=1800.0),
    stop=BumpStop(k=50e3, k3=1e9, s_min=-0.01, s_max=0.02),
    inerter=ia.Inerter(b=30.0),
)
DIGRESSIVE = ia.parallel(ia.Spring(k=15e3), DigressiveDamper(d=3e3, d_h=400.0, v_k=0.1))
DISK = ia.DiskFlywheel(m=0.5, R=0.05)
ABSORBERS: dict[tuple[int, int], ia.Component] = {
    (0, 1): ia.machines.tid(3e4, 300.0, 200.0),
    (1, 2): ia.machines.tvmd(3e4, 300.0, 100.0),
    (1, 3): TMDI(m=50.0, k=5e3, d=100.0, b=80.0),
    (0, 3): TMD(m=40.0, k=6e3, d=90.0),
}
MACHINES: dict[str, Callable[[], ia.Network]] = {
    **{
        f"quarter car {layout}": lambda layout=layout: ia.machines.quarter_car(  # type: ignore[misc]
            ia.machines.suspension(layout, 60e3, 2600.0, 100.0, k_b=2e5, k_1=5e3, k_2=2e3)
        )
        for layout in (f"S{n}" for n in range(1, 9))
    },
    "half car": lambda: ia.machines.half_car(STRUT.clone(), DIGRESSIVE.clone()),
    "full car": lambda: ia.machines.full_car(STRUT.clone(), STOPPED.clone()),
    "seat": lambda: ia.machines.seat_in_cab(STOPPED.clone(), STRUT.clone()),
    "frame": lambda: ia.machines.shear_frame(
        [1e3] * 3, [1.5e6] * 3, [2e3] * 3, {at: a.clone() for at, a in ABSORBERS.items()}
    ),
    "cable": lambda: ia.machines.taut_cable(50.0, 1e6, 20.0, 8, ia.machines.tvmd(1e5, 1e3, 50.0)),
    "isolated machine": lambda: ia.machines.isolated_machine(STRUT.clone()),
    "ball screw": lambda: ia.machines.isolated_machine(
        ia.parallel(
            ia.SpringDamper(k=1e4, d=200.0), BallScrewInerter(screw=ia.NutScrew(lead=0.02), flywheel=DISK)
        )
    ),
    "rack and pinion": lambda: ia.machines.isolated_machine(
        ia.parallel(
            ia.SpringDamper(k=1e4, d=200.0), RackPinionInerter(pinion=ia.RackPinion(R=0.01), flywheel=DISK)
        )
    ),
    "planetary": lambda: ia.machines.isolated_machine(
        ia.parallel(ia.SpringDamper(k=1e4, d=200.0), ia.machines.ge_wang.ideal_inerter())
    ),
}
DRIVEN = {"cable": "wind.f", "half car": "front_road.s_ref", "full car": "front_left_road.s_ref"}


def leaves(component: ia.Component, path: str) -> Iterator[tuple[str, Any]]:
    if component._parts:
        for name, part in component._parts.items():
            yield from leaves(part, f"{path}.{name}" if path else name)
    else:
        yield path, component


def stored(run: ia.Result, path: str, part: Any) -> Any:
    """Energy that an element stores [J]."""
    if isinstance(part, ia.Mass):
        return 0.5 * run[f"{path}.m"] * run[f"{path}.v"] ** 2
    if isinstance(part, ia.Spring):
        return 0.5 * _number(run, path, part, "k") * run[f"{path}.s_rel"] ** 2
    if isinstance(part, ia.SpringDamper):
        return 0.5 * _number(run, path, part, "k") * run[f"{path}.s_rel"] ** 2
    if isinstance(part, ia.Inerter):
        return 0.5 * _number(run, path, part, "b") * run[f"{path}.v_rel"] ** 2
    if isinstance(part, ia.DiskFlywheel):
        return 0.25 * part.m * part.R**2 * run[f"{path}.w"] ** 2
    if isinstance(part, ia.IdealPlanetaryFlywheel):
        return 0.5 * ia.machines.ge_wang.J_E * run[f"{path}.w"] ** 2
    if isinstance(part, PitchingBody):
        return 0.5 * part.m * run[f"{path}.v"] ** 2 + 0.5 * part.J * run[f"{path}.q"] ** 2
    if isinstance(part, RigidBody):
        turning = part.J_x * run[f"{path}.p"] ** 2 + part.J_y * run[f"{path}.q"] ** 2
        return 0.5 * (part.m * run[f"{path}.v"] ** 2 + turning)
    if isinstance(part, BumpStop):
        e = np.maximum(run[f"{path}.s_rel"] - part.s_max, 0) + np.minimum(
            run[f"{path}.s_rel"] - part.s_min, 0
        )
        return 0.5 * part.k * e**2 + 0.25 * part.k3 * e**4
    return 0.0


def _number(run: ia.Result, path: str, part: Any, name: str) -> float:
    return float(run[f"{path}.{name}"][0])


def lost(run: ia.Result, path: str, part: Any) -> Any:
    """Power that an element loses [W]."""
    if isinstance(part, ia.SpringDamper):
        return _number(run, path, part, "d") * run[f"{path}.v_rel"] ** 2
    if isinstance(part, ia.Damper | BilinearDamper | DigressiveDamper):
        return run[f"{path}.f"] * run[f"{path}.v_rel"]
    return 0.0


def given(run: ia.Result, driven: str, size: float) -> Array:
    """Power that the source gives [W]: a road that moves, or wind on the fourth bead of the cable."""
    source = driven.rpartition(".")[0]
    if driven == "wind.f":
        return run["wind.f"] * run["bead4.v"]
    return -run[f"{source}.flange.f"] * size * 9 * np.sin(18 * run.time)


@pytest.mark.parametrize("name", MACHINES)
def test_energy_is_kept(name: str) -> None:
    net = MACHINES[name]()
    size = 1e3 if name == "cable" else 0.02
    driven = DRIVEN.get(name) or next(i for i in net.dae().input_names if i.endswith("s_ref"))
    run = net.simulate(
        0.6, inputs={driven: lambda t: size * np.sin(9 * t) ** 2}, step=2e-4, rtol=1e-9, atol=1e-11
    )
    parts = list(leaves(net, ""))
    energy: Any = sum(stored(run, *part) for part in parts)
    power: Any = given(run, driven, size) - sum(lost(run, *part) for part in parts)
    balance = np.concatenate([[0.0], np.cumsum(np.diff(run.time) * (power[1:] + power[:-1]) / 2)])
    assert max(abs(energy)) > 0.01
    assert energy - energy[0] == pytest.approx(balance, abs=2e-4 * max(abs(energy)))
    assert all(np.min(lost(run, *part)) >= -1e-9 for part in parts)


def real() -> PlanetaryFlywheelInerter:
    return ia.machines.ge_wang.planetary_inerter()


def real_strut() -> Any:
    return ia.machines.suspension("S8", 20e3, 1200.0, real(), k_b=1e5, k_1=2e3, k_2=1e3)


WITH_REAL_INERTERS: dict[str, Callable[[], ia.Network]] = {
    **{
        f"quarter car {layout}": lambda layout=layout: ia.machines.quarter_car(  # type: ignore[misc]
            ia.machines.suspension(layout, 60e3, 2600.0, real(), k_b=2e5, k_1=5e3, k_2=2e3)
        )
        for layout in (f"S{n}" for n in range(3, 9))
    },
    "half car": lambda: ia.machines.half_car(real_strut(), real_strut()),
    "full car": lambda: ia.machines.full_car(real_strut(), real_strut()),
    "seat": lambda: ia.machines.seat_in_cab(real_strut(), real_strut()),
    "TID": lambda: framed(ia.machines.tid(3e4, 300.0, real())),
    "TVMD": lambda: framed(ia.machines.tvmd(3e4, 300.0, real())),
    "TMDI": lambda: framed(TMDI(m=50.0, k=5e3, d=100.0, inerter=real())),
    "cable": lambda: ia.machines.taut_cable(50.0, 1e6, 20.0, 8, ia.machines.tvmd(1e5, 1e3, real())),
    "isolator": lambda: ia.machines.isolated_machine(ia.parallel(ia.SpringDamper(k=1e4, d=200.0), real())),
    "isolator in series": lambda: ia.machines.isolated_machine(
        ia.series(ia.SpringDamper(k=1e4, d=200.0), real())
    ),
}


def framed(absorber: ia.Component) -> ia.Network:
    return ia.machines.shear_frame([1e3] * 3, [1.5e6] * 3, [2e3] * 3, {(0, 2): absorber})


def inerters(component: ia.Component, path: str = "") -> Iterator[str]:
    for name, part in component._parts.items():
        inner = f"{path}.{name}" if path else name
        if isinstance(part, PlanetaryFlywheelInerter):
            yield inner
        yield from inerters(part, inner)


@pytest.mark.parametrize("name", WITH_REAL_INERTERS)
def test_any_composition_takes_a_real_inerter(name: str) -> None:
    """It runs and is linearised; each inerter moves, and gives back no more than it got."""
    net = WITH_REAL_INERTERS[name]()
    driven = DRIVEN.get(name) or next(i for i in net.dae().input_names if i.endswith("s_ref"))
    size = 1e4 if name == "cable" else 0.02
    run = net.simulate(0.15, inputs={driven: lambda t: size * np.sin(9 * t) ** 2}, step=2e-4)
    assert run.time[-1] == pytest.approx(0.15)
    moved = 0.0
    for path in inerters(net):
        f, s_rel = run[f"{path}.f"], run[f"{path}.s_rel"]
        got = np.cumsum(np.diff(s_rel) * (f[1:] + f[:-1]) / 2)
        moved = max(moved, got.max())
        assert got.min() >= -0.02 * got.max()
    assert moved > 1e-6
    assert np.isfinite(ia.analysis.linearise(net).A).all()


@pytest.mark.parametrize("layout", [f"S{n}" for n in range(3, 9)])
def test_a_real_inerter_stands_where_an_ideal_one_does(layout: str) -> None:
    ideal = ia.machines.ge_wang.ideal_inerter()
    cars = [
        ia.machines.quarter_car(ia.machines.suspension(layout, 60e3, 2600.0, b, k_b=2e5, k_1=5e3, k_2=2e3))
        for b in (ia.machines.ge_wang.B, ideal)
    ]
    assert ia.analysis.ride_j1(cars[1]) == pytest.approx(ia.analysis.ride_j1(cars[0]), rel=1e-9)


def test_a_rough_planetary_inerter_sticks_at_rest() -> None:
    car = ia.machines.quarter_car(
        ia.machines.suspension("S4", 60e3, 3200.0, ia.machines.ge_wang.planetary_inerter())
    )
    system = ia.analysis.linearise(car, ["road.s_ref"], ["body.v"])
    assert any("'stuck'" in note for note in system.notes)


def test_layouts_and_floors_that_are_wrong_are_told() -> None:
    with pytest.raises(ia.ModelError, match="S1, S2"):
        ia.machines.suspension("S9", 1.0, 1.0)
    with pytest.raises(ia.ModelError, match="there are 0 to 1"):
        ia.machines.shear_frame([1.0], [1.0], absorbers={(0, 2): ia.machines.tid(1.0, 1.0, 1.0)})
    with pytest.raises(ia.ModelError, match="beads 1 to 19"):
        ia.machines.taut_cable(1.0, 1.0, 1.0, at=20)


def test_full_car_heaves_pitches_and_rolls() -> None:
    strut = ia.SpringDamper(k=20e3, d=1500.0)
    car = ia.machines.full_car(strut, strut.clone())
    assert len(ia.analysis.linearise(car).states) == 14
    left = {f"{axle}_left_road.s_ref": 0.01 for axle in ("front", "rear")}
    rolled = ia.analysis.operating_point(
        car.dae(), inputs=left | {f"{a}_right_road.s_ref": 0.0 for a in ("front", "rear")}
    )
    assert rolled.values["body.s"] == pytest.approx(0.005, rel=1e-9)
    assert rolled.values["body.phi"] == pytest.approx(0.01 / 1.4, rel=1e-9)
    front = {f"front_{side}_road.s_ref": 0.01 for side in ("left", "right")}
    pitched = ia.analysis.operating_point(car.dae(), inputs=front)
    assert pitched.values["body.theta"] == pytest.approx(-0.01 / 2.5, rel=1e-9)
