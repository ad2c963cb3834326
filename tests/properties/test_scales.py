"""What may not matter: whether a rig moves by metres or micrometres, weighs grams or tonnes, units."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Fit
from numpy.typing import NDArray

Array = NDArray[np.float64]
SOLVERS = ("cvodes", "idas", "rosenbrock", "compiled")
STOP = 3.0
TIME = np.linspace(0.0, STOP, 301)


def smooth(length: float = 1.0, mass: float = 1.0) -> ia.Network:
    """An oscillator pushed by 200 N."""
    net = ia.Network(
        "rig", wall=ia.Fixed(), spring=ia.Spring(k=400.0 * mass), damper=ia.Damper(d=0.4 * mass),
        mass=ia.Mass(m=mass, s=0.3 * length, v=0.0), push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    return net


def sticking(length: float = 1.0, mass: float = 1.0) -> ia.Network:
    """The same with dry friction, a stop, and a second mass beyond a clearance."""
    net = smooth(length, mass)
    net.add(
        rub=ia.CoulombFriction(f_c=30.0 * length * mass),
        stop=ia.HardStop(e=0.3, s_min=-0.2 * length, v_rest=1e-3 * length),
        gap=ia.Backlash(k=1000.0 * mass, d=5.0 * mass, eps=0.02 * length),
        second=ia.Mass(m=0.3 * mass, s=0.3 * length, v=0.0),
    )
    net.connect(net.wall.flange, net.rub.flange_a, net.stop.flange_a)
    net.connect(net.mass.flange, net.rub.flange_b, net.stop.flange_b, net.gap.flange_a)
    net.connect(net.gap.flange_b, net.second.flange)
    return net


def push(size: float, kind: str) -> Any:
    if kind == "function":
        return lambda t: 200.0 * size * ca.sin(19.0 * t)
    return TIME, 200.0 * size * np.sin(19.0 * TIME)


def course(build: Callable[..., ia.Network], length: float, mass: float, kind: str, solver: str) -> Array:
    run = build(length, mass).simulate(
        STOP, step=0.01, inputs={"push.f": push(length * mass, kind)}, solver=solver
    )
    assert run.notes == []
    found: Array = run.at("mass.s", TIME) / length
    return found


@cache
def wanted(build: Callable[..., ia.Network], kind: str) -> Array:
    net = build()
    run = net.simulate(STOP, step=0.01, inputs={"push.f": push(1.0, kind)}, rtol=1e-10, atol=1e-14)
    found: Array = run.at("mass.s", TIME)
    return found


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("kind", ["function", "samples"])
@pytest.mark.parametrize("length", [1e3, 1e-3, 1e-6])
def test_a_smooth_rig_moves_alike_in_every_size(length: float, kind: str, solver: str) -> None:
    """At micrometres, tolerances of 1e-8 m were a hundredth of the motion, and nobody said so."""
    reference = wanted(smooth, kind)
    got = course(smooth, length, 1.0, kind, solver)
    assert np.abs(got - reference).max() < 1e-4 * np.ptp(reference)


@pytest.mark.parametrize("solver", ["auto", "rosenbrock", "compiled"])
@pytest.mark.parametrize(("length", "mass"), [(30.0, 1.0), (1e-3, 1.0), (1e-6, 1.0), (1.0, 1e6), (1.0, 1e-6)])
def test_a_rig_that_sticks_and_strikes_moves_alike_in_every_size(
    length: float, mass: float, solver: str
) -> None:
    reference = wanted(sticking, "function")
    got = course(sticking, length, mass, "function", solver)
    assert np.abs(got - reference).max() < 1e-3 * np.ptp(reference)


@pytest.mark.parametrize("solver", SOLVERS)
def test_motion_below_the_tolerance_is_told(solver: str) -> None:
    """Of nanometres, and of micrometres a metre away from zero."""
    inputs = {"push.f": push(1e-12, "function")}
    run = smooth(1e-12).simulate(1.0, inputs=inputs, solver=solver)
    assert any("mass.s moves by no more than" in note and "atol=" in note for note in run.notes)
    atol = float(run.notes[0].split("atol=")[1])
    assert smooth(1e-12).simulate(1.0, inputs=inputs, solver=solver, atol=atol).notes == []
    far = smooth(1e-6)
    far.spring.s_rel0, far.mass.s = 1.0, 1.0 + 3e-7
    inputs = {"push.f": push(1e-6, "function")}
    run = far.simulate(1.0, inputs=inputs, solver=solver)
    (note,) = run.notes
    assert "mass.s moves by no more than" in note
    assert "about 1 m" in note
    rtol = float(note.split("rtol=")[1])
    again = far.simulate(1.0, inputs=inputs, solver=solver, rtol=rtol)
    assert again.notes == []
    near = smooth(1e-6).simulate(1.0, inputs=inputs, rtol=1e-9)
    assert again["mass.s"] - 1.0 == pytest.approx(near["mass.s"], abs=1e-3 * np.ptp(near["mass.s"]))


MODEL = """
import inertance as ia

def build():
    net = ia.Network(
        "rig", wall=ia.Fixed(), spring=ia.Spring(k=380.0), damper=ia.Damper(d=0.6), push=ia.Force(),
        mass=ia.Mass(m=1.0, s={start}, v=0.0),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    return net
"""
CAMPAIGN = """
model = "rig.py:build"
[channels]
x = {{ output = "mass.s", unit = "{length}" }}
F = {{ input = "push.f", unit = "{force}" }}
[parameters]
"spring.k" = {{ rel = 0.2 }}
"damper.d" = {{ rel = 0.5 }}
[[train]]
file = "train.csv"
[noise]
x = {noise}
"""
NUMBERS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "N": 1.0, "kN": 1e3}


def fitted(folder: Path, length: str, force: str, size: float = 1.0) -> Fit:
    """Fit k and d of a rig of `size` times a metre, whose records are in such units."""
    folder.mkdir()
    (folder / "rig.py").write_text(MODEL.format(start=0.3 * size))
    position, push_ = size * wanted(smooth, "samples"), size * push(1.0, "samples")[1]
    noise = 1e-2 * size
    position = position + noise * np.random.default_rng(7).normal(size=len(TIME))
    columns = TIME, position / NUMBERS[length], push_ / NUMBERS[force]
    text = CAMPAIGN.format(length=length, force=force, noise=noise / NUMBERS[length])
    (folder / "campaign.toml").write_text(text)
    rows = [",".join(f"{value:.15g}" for value in row) for row in zip(*columns, strict=True)]
    (folder / "train.csv").write_text("\n".join([f"time [s],x [{length}],F [{force}]", *rows]) + "\n")
    return ia.fit(Campaign.load(folder / "campaign.toml"))


def test_a_fit_finds_the_same_from_records_in_other_units_and_of_other_sizes(tmp_path: Path) -> None:
    fits = {
        (length, force, size): fitted(tmp_path / f"{length}{force}{size}", length, force, size)
        for length, force, size in [
            ("m", "N", 1.0), ("mm", "kN", 1.0), ("um", "N", 1.0), ("m", "N", 1e-6), ("um", "kN", 1e-6),
        ]
    }  # fmt: skip
    first = fits["m", "N", 1.0]
    assert first.values["spring.k"] == pytest.approx(400.0, rel=1e-2)
    for fit in fits.values():
        for name, value in first.values.items():
            assert fit.values[name] == pytest.approx(value, abs=0.5 * first.errors[name])
            assert fit.errors[name] == pytest.approx(first.errors[name], rel=0.05)
