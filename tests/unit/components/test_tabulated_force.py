"""A force by points over position, speed or both, against SciPy's interpolation."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.analysis import linearise
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.interpolate import PchipInterpolator, RegularGridInterpolator

X = (-0.03, -0.012, -0.002, 0.004, 0.015, 0.03)
F = (-5.0, -4.0, 1.0, 2.0, 2.5, 9.0)
CURVE = tuple(zip(X, F, strict=True))
GRID_X, GRID_V = np.array([-0.03, 0.0, 0.01, 0.03]), np.array([-0.2, -0.01, 0.02, 0.2])
MAP = np.random.default_rng(5).normal(0, 3, (4, 4))
HEAVY = [
    (x, v, 30 * np.tanh(20 * v) + 40 * x + MAP[i, j])
    for i, x in enumerate(GRID_X)
    for j, v in enumerate(GRID_V)
]
ROWS = [(x, v, MAP[i, j]) for i, x in enumerate(GRID_X) for j, v in enumerate(GRID_V)]


def driven(element: ia.Component, turning: bool = False) -> ia.Result:
    kind, reference = (rotational, "phi_ref") if turning else (ia, "s_ref")
    drive = kind.Position(**{reference: lambda t: 0.02 * np.sin(3 * t) + 0.004 * np.cos(11 * t)})
    net = ia.Network("driven", ground=kind.Fixed(), element=element, drive=drive)
    net.connect(net.ground.flange, net.element.flange_b)  # the other way about: s_rel = -s
    net.connect(net.element.flange_a, net.drive.flange)
    return net.simulate(2.0, step=1e-3)


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("over", ["position", "speed"])
@pytest.mark.parametrize("how", ["linear", "smooth"])
def test_a_curve(turning: bool, over: str, how: str) -> None:
    kind: Any = rotational if turning else ia
    across, speed, through = ("phi", "w", "tau") if turning else ("s", "v", "f")
    table = CURVE if over == "position" else tuple((5 * x, f) for x, f in CURVE)
    rest = 0.001
    element = kind.TabulatedForce(table=table, over=over, interpolation=how, **{f"{across}_rel0": rest})
    run = driven(element, turning)
    at = run[f"element.{across}_rel"] - rest if over == "position" else run[f"element.{speed}_rel"] / 5
    assert np.ptp(at) > 0.02
    law: Any = PchipInterpolator(X, F) if how == "smooth" else lambda x: np.interp(x, X, F)
    inside = (at > X[0]) & (at < X[-1])
    assert inside.sum() > 1000
    assert run[f"element.{through}"][inside] == pytest.approx(law(at[inside]), abs=1e-6)


def test_a_map() -> None:
    run = driven(ia.TabulatedForce(table=ROWS, over="position"))
    s, v = run["element.s_rel"], run["element.v_rel"]
    wanted = RegularGridInterpolator((GRID_X, GRID_V), MAP)(np.column_stack([s, v]))
    assert run["element.f"] == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize(
    "half", [CURVE[3:], ((0.0, 1.5), *CURVE[3:]), tuple((-x, -f) for x, f in CURVE[:2:-1])]
)
def test_an_odd_law_needs_one_half(half: tuple[tuple[float, float], ...]) -> None:
    run = driven(ia.TabulatedForce(table=half, over="position", odd=True))
    s, f = run["element.s_rel"], run["element.f"]
    size = np.abs(s)
    outer = size > 0.004
    assert f[outer] == pytest.approx(np.sign(s[outer]) * np.interp(size[outer], X, F), abs=1e-9)
    assert np.abs(f[size < 1e-4]).max() < 0.06


def test_an_odd_map_needs_one_quarter() -> None:
    quarter = [(x, v, 7 * x + v) for x in (0.0, 0.03) for v in (0.0, 0.2)]
    with pytest.raises(ia.ModelError, match="fill a grid"):
        ia.Network("one", force=ia.TabulatedForce(table=[*quarter[:3]])).dae()
    half = [(x, v, 7 * x + v) for x in (0.0, 0.03) for v in (-0.2, 0.2)]
    run = driven(ia.TabulatedForce(table=half, odd=True))
    assert run["element.f"] == pytest.approx(7 * run["element.s_rel"] + run["element.v_rel"], abs=1e-9)


@pytest.mark.parametrize("table", [CURVE, HEAVY])
def test_it_swings_as_its_equation_says(table: Any) -> None:
    net = ia.Network("swing", ground=ia.Fixed(), law=ia.TabulatedForce(table=table, over="position"))
    net.add(spring=ia.Spring(k=500.0), mass=ia.Mass(m=0.8, s=0.012, v=-0.05))
    net.connect(net.ground.flange, net.law.flange_a, net.spring.flange_a)
    net.connect(net.law.flange_b, net.spring.flange_b, net.mass.flange)
    run = net.simulate(0.6, step=1e-2, rtol=1e-9, atol=1e-11)
    if len(table[0]) == 2:
        force: Any = lambda s, v: np.interp(s, X, F)  # noqa: E731
    else:
        heavy = np.array(HEAVY)[:, 2].reshape(4, 4)
        beyond: Any = {"bounds_error": False, "fill_value": None}
        grid = RegularGridInterpolator((GRID_X, GRID_V), heavy, **beyond)
        force = lambda s, v: float(grid((s, v)))  # noqa: E731
    rates = lambda t, y: (y[1], -(500 * y[0] + force(*y)) / 0.8)  # noqa: E731
    apart = solve_ivp(rates, (0, 0.6), (0.012, -0.05), t_eval=run.time, rtol=1e-9, atol=1e-12, max_step=1e-3)
    assert run["mass.s"] == pytest.approx(apart.y[0], abs=2e-6)


@pytest.mark.parametrize(
    ("table", "over"), [(CURVE, "position"), (tuple((5 * x, f) for x, f in CURVE), "speed"), (ROWS, "speed")]
)
def test_its_energy_is_accounted_for(table: Any, over: Any) -> None:
    how: Any = "linear" if len(table[0]) == 3 else "smooth"
    run = driven(ia.TabulatedForce(table=table, over=over, interpolation=how))
    assert run.energy().closes < 1e-6
    s, v, f = run["element.s_rel"], run["element.v_rel"], run["element.f"]
    taken = cumulative_trapezoid(f * v - run["element.lossPower"], x=run.time, initial=0)
    stored = run["element.potential"]
    assert stored - stored[0] == pytest.approx(taken, abs=2e-4 * np.ptp(taken) + 1e-9)
    if over == "position":
        assert run["element.lossPower"] == pytest.approx(0, abs=1e-12)
        assert np.ptp(stored) > 0.01
    elif len(table[0]) == 2:
        assert run["element.lossPower"] == pytest.approx(f * v)
    else:
        law = RegularGridInterpolator((GRID_X, GRID_V), MAP)
        slow = np.column_stack([s, 0 * s])
        assert run["element.lossPower"] == pytest.approx((f - law(slow)) * v, abs=1e-9)


def test_it_is_linearised() -> None:
    net = ia.Network("swing", ground=ia.Fixed(), mass=ia.Mass(m=2.0), push=ia.Force())
    net.add(
        law=ia.TabulatedForce(table=[(s, v, 30 * s + 4 * v) for s in (-1, 1) for v in (-1, 1)]),
    )
    net.connect(net.ground.flange, net.law.flange_a)
    net.connect(net.law.flange_b, net.mass.flange, net.push.flange)
    system = linearise(net, inputs=["push.f"], outputs=["mass.s"])
    assert np.sort(np.poly(system.A)) == pytest.approx(np.sort([1.0, 2.0, 15.0]))


@pytest.mark.parametrize(
    "table",
    [
        ((0.0, 1.0),),
        ((1.0, 0.0), (0.0, 1.0)),
        ((0.0, 0.0, 1.0), (0.0, 1.0, 2.0)),
        ((0.0, 0.0, 1.0, 1.0),) * 2,
        "table",
    ],
)
def test_a_table_that_is_none(table: Any) -> None:
    with pytest.raises(ia.ModelError, match="takes at least two rows"):
        ia.Network("one", force=ia.TabulatedForce(table=table)).dae()
