"""Springs and dampers given by points, against SciPy's interpolation; tables read from files."""

from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator, RegularGridInterpolator

Array = NDArray[np.float64]
X = (-0.02, -0.013, -0.004, 0.0, 0.003, 0.011, 0.02)
Y = (-900.0, -600.0, -150.0, 0.0, 0.0, 500.0, 700.0)
TABLE = tuple(zip(X, Y, strict=True))


def driven(element: ia.Component, turning: bool = False, size: float = 0.03) -> ia.Network:
    kind, reference = (rotational, "phi_ref") if turning else (ia, "s_ref")
    drive = kind.Position(**{reference: lambda t: size * np.sin(3 * t)})
    net = ia.Network("driven", wall=kind.Fixed(), element=element, drive=drive)
    net.connect(net.wall.flange, net.element.flange_a)
    return net.connect(net.element.flange_b, net.drive.flange)


def straight_on(curve: Any, at: Array) -> Array:
    """A curve that goes on straight beyond its ends."""
    inside = np.clip(at, X[0], X[-1])
    slope = (curve(inside + 1e-9 * np.sign(0.0 - inside)) - curve(inside)) / (1e-9 * np.sign(0.0 - inside))
    return np.asarray(np.where(at == inside, curve(at), curve(inside) + slope * (at - inside)))


CURVES = {
    "linear": lambda at: np.interp(at, X, Y),
    "smooth": PchipInterpolator(X, Y),
}


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("how", CURVES)
def test_a_spring_by_points(how: Any, turning: bool) -> None:
    kind = rotational if turning else ia
    rest = {"phi_rel0" if turning else "s_rel0": 0.002}
    net = driven(kind.TabulatedSpring(table=np.array(TABLE), interpolation=how, **rest), turning)
    run = net.simulate(2.0, step=1e-3)
    e = 0.03 * np.sin(3 * run.time) - 0.002
    assert e.max() > X[-1]
    assert e.min() < X[0]
    expected = straight_on(CURVES[how], e)
    assert run["element.tau" if turning else "element.f"] == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("how", CURVES)
def test_a_damper_by_points(how: Any, turning: bool) -> None:
    kind = rotational if turning else ia
    net = driven(kind.TabulatedDamper(table=TABLE, interpolation=how), turning, 0.006)
    run = net.simulate(2.0, step=1e-3)
    v = 0.018 * np.cos(3 * run.time)
    assert run["element.tau" if turning else "element.f"] == pytest.approx(CURVES[how](v), abs=1e-6)
    assert run["element.lossPower"] == pytest.approx(CURVES[how](v) * v, abs=1e-6)


@pytest.mark.parametrize("count", [2, 3, 4, 9])
def test_smooth_curves_of_any_number_of_points(count: int) -> None:
    random = np.random.default_rng(count)
    x, y = np.sort(random.uniform(-0.03, 0.03, count)), random.normal(size=count)
    run = driven(ia.TabulatedSpring(table=np.column_stack([x, y]), interpolation="smooth")).simulate(2.0)
    e = 0.03 * np.sin(3 * run.time)
    inside = (e > x[0]) & (e < x[-1])
    assert run["element.f"][inside] == pytest.approx(PchipInterpolator(x, y)(e[inside]), abs=1e-9)


def test_a_smooth_curve_has_steady_slopes_and_no_overshoot() -> None:
    """So a mass that swings on it keeps its energy."""
    net = ia.Network("swing", wall=ia.Fixed(), mass=ia.Mass(m=1.0, s=0.019, v=0.0))
    net.add(spring=ia.TabulatedSpring(table=TABLE, interpolation="smooth"))
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
    run = net.simulate(2.0, rtol=1e-11)
    kinetic = run["mass.v"] ** 2 / 2
    energy = kinetic + PchipInterpolator(X, Y).antiderivative()(run["mass.s"])
    assert energy == pytest.approx(np.full(len(energy), energy[0]), abs=1e-6 * kinetic.max())
    assert np.abs(run["mass.v"]).max() > 0.1


S, V = np.array([-0.02, -0.005, 0.01, 0.02]), np.array([-0.1, 0.0, 0.02, 0.1])
GRID = [(s, v) for s in S for v in V]


def test_a_map_over_stretch_and_speed() -> None:
    random = np.random.default_rng(4)
    values = random.normal(size=(4, 4))
    rows = [(s, v, values[i // 4, i % 4]) for i, (s, v) in enumerate(GRID)]
    random.shuffle(rows)
    run = driven(ia.MapSpringDamper(table=rows, s_rel0=0.001), size=0.018).simulate(3.0, step=1e-3)
    e, v = 0.018 * np.sin(3 * run.time) - 0.001, 0.054 * np.cos(3 * run.time)
    expected = RegularGridInterpolator((S, V), values)(np.column_stack([e, v]))
    assert run["element.f"] == pytest.approx(expected, abs=1e-8)


def test_a_smooth_map_is_exact_for_what_is_quadratic() -> None:
    def law(s: Any, v: Any) -> Any:
        return (3 + 200 * s + 4e3 * s**2) * (1 - 10 * v + 50 * v**2)

    table = [(s, v, law(s, v)) for s, v in GRID]
    element = ia.MapSpringDamper(table=table, interpolation="smooth")
    run = driven(element, size=0.018).simulate(3.0, step=1e-3)
    e, v = 0.018 * np.sin(3 * run.time), 0.054 * np.cos(3 * run.time)
    assert run["element.f"] == pytest.approx(law(e, v), rel=1e-9)


def test_a_cam_follows_a_periodic_spline_through_its_points() -> None:
    angles, lifts = np.array([0.3, 1.0, 2.2, 3.9, 5.5]), np.array([0.0, 0.004, 0.01, 0.002, 0.001])
    spline = CubicSpline([*angles, 0.3 + 2 * np.pi], [*lifts, 0.0], bc_type="periodic")
    net = ia.Network("cam", shaft=rotational.Speed(w_ref=40.0), follower=ia.Mass(m=2.0))
    net.add(cam=ia.Cam(table=np.column_stack([angles, lifts])))
    net.connect(net.shaft.flange, net.cam.flange_r).connect(net.cam.flange_t, net.follower.flange)
    run = net.simulate(0.5, step=1e-4, start={"cam.phi": -8.0}, rtol=1e-9)
    phi = -8.0 + 40 * run.time
    turned = (phi - 0.3) % (2 * np.pi) + 0.3
    assert run["follower.s"] == pytest.approx(spline(turned), abs=1e-9)
    assert run["follower.a"] == pytest.approx(1600 * spline(turned, 2), abs=1e-5)
    power = run["cam.flange_r.tau"] * 40 + run["cam.flange_t.f"] * run["follower.v"]
    assert np.abs(power).max() < 1e-9 * np.abs(run["cam.flange_r.tau"] * 40).max()


def test_tables_are_read_in_other_units_and_orders(tmp_path: Path) -> None:
    path = tmp_path / "map.csv"
    lines = [f"{1e-3 * law:.9g};{1e3 * s:.9g};{v:.9g}".replace(".", ",") for s, v in GRID for law in [s + v]]
    path.write_text("F [kN];s [mm];v [m/s]\n" + "\n".join(lines))
    table = ia.load_points(path, {"s": "m", "v": "m/s", "F": "N"})
    assert len(table) == 16
    assert np.array(table)[:, 2] == pytest.approx(np.array(table)[:, :2].sum(axis=1))
    assert "must" not in "; ".join(ia.MapSpringDamper(table=table).problems())


def test_files_without_what_is_wanted_are_told(tmp_path: Path) -> None:
    path = tmp_path / "spring.csv"
    path.write_text("s [mm],F [N]\n0,0\n1,\n")
    with pytest.raises(ia.ModelError, match="line 3, column 'F': nan is no usable number"):
        ia.load_points(path, {"s": "m", "F": "N"})
    with pytest.raises(ia.ModelError, match="no column 'f'"):
        ia.load_points(path, {"s": "m", "f": "N"})
    with pytest.raises(ia.ModelError, match="column 's'"):
        ia.load_points(path, {"s": "N", "F": "N"})
    with pytest.raises(ia.ModelError, match="must map names of columns to units"):
        ia.load_points(path, {})


@pytest.mark.parametrize(
    ("element", "told"),
    [
        (ia.TabulatedSpring(table=((0, 0),)), "at least two rows"),
        (ia.TabulatedSpring(table=((0, 0), (0, 1))), "x increasing"),
        (ia.MapSpringDamper(table=[(0, 0, 1), (1, 1, 1), (0, 1, 1)]), "one for each pair"),
        (ia.MapSpringDamper(table=[(0, 0, 1), (0, 1, 1)]), "one for each pair"),
        (ia.Cam(table=[(0, 0), (1, 1), (7, 0)]), "within one turn"),
        (ia.TabulatedDamper().with_values(interpolation="spline"), "must be one of"),
    ],
    ids=["one row", "no width", "a hole", "a line", "two turns", "another way"],
)
def test_bad_tables_are_told(element: ia.Component, told: str) -> None:
    assert any(told in problem for problem in element.problems())
