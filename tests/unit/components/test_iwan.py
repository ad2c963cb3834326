"""Joints that slip bit by bit, against cells that yield sharply and against what is known of them."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from numpy.typing import NDArray

Array = NDArray[np.float64]
K, YIELD = 500.0, 0.02


def moved(element: ia.Component, s: Any, stop: float, turning: bool = False) -> ia.Result:
    kind, reference = (rotational, "phi_ref") if turning else (ia, "s_ref")
    net = ia.Network("lap", wall=kind.Fixed(), joint=element, drive=kind.Position(**{reference: s}))
    net.connect(net.wall.flange, net.joint.flange_a).connect(net.joint.flange_b, net.drive.flange)
    return net.simulate(stop, step=stop / 2000, rtol=1e-9, atol=1e-12)


def wandering(t: Any) -> Any:
    return 0.013 * np.sin(2 * t) + 0.009 * np.sin(5.3 * t) + 0.004 * (1 - np.cos(11.7 * t))


def sharp_cells(s: Array, p: float, cells: int = 400) -> Array:
    yields = YIELD * ((np.arange(cells) + 0.5) / cells) ** p
    sliders, found = np.full(cells, s[0]), []
    for now in s:
        sliders = np.clip(sliders, now - yields, now + yields)
        found.append(K * np.mean(now - sliders))
    return np.array(found)


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0])
def test_few_round_cells_are_many_sharp_ones(p: float) -> None:
    run = moved(ia.Iwan(k=K, s_y=YIELD, p=p), wandering, 6.0)
    expected = sharp_cells(wandering(run.time), p)
    left = np.sqrt(np.mean((run["joint.f"] - expected) ** 2)) / np.sqrt(np.mean(expected**2))
    assert 0.005 < left < 0.025


@pytest.mark.parametrize("p", [1.0, 2.0])
@pytest.mark.parametrize(
    ("size", "cells", "force", "work"),
    [(5.0, 6, 0.02, 0.02), (0.1, 6, 0.045, 0.6), (0.1, 20, 0.015, 0.12), (0.1, 40, 0.015, 0.07)],
)
def test_how_many_cells_it_takes_where_it_hardly_slips_and_where_it_slides_far(
    p: float, size: float, cells: int, force: float, work: float
) -> None:
    def motion(t: Any) -> Any:
        return 2.5 * YIELD + size * wandering(t)

    run = moved(ia.Iwan(k=K, s_y=YIELD, p=p, cells=cells), motion, 6.0)
    expected, found = sharp_cells(motion(run.time), p), run["joint.f"]
    spent, told = (float(np.trapezoid(f * run["joint.v_rel"], run.time)) for f in (expected, found))
    assert np.sqrt(np.mean((found - expected) ** 2) / np.mean(expected**2)) < force
    assert told == pytest.approx(spent, rel=work)


@pytest.mark.parametrize("p", [0.0, 1.0, 3.0])
def test_pulled_on_it_slides(p: float) -> None:
    run = moved(ia.Iwan(k=K, s_y=YIELD, p=p, cells=30), lambda t: 0.1 * t, 1.5)
    assert run["joint.f"][-1] == pytest.approx(K * YIELD / (1 + p), rel=2e-3)
    assert run["joint.f"][1] == pytest.approx(K * run["joint.s_rel"][1], rel=0.2)


@pytest.mark.parametrize("p", [1.0, 2.0])
def test_before_it_slides_what_a_loop_loses_grows_by_a_power_of_its_size(p: float) -> None:
    sizes = np.array([0.1, 0.2, 0.4]) * YIELD
    lost = []
    for size in sizes:
        run = moved(ia.Iwan(k=K, s_y=YIELD, p=p, cells=60), lambda t, size=size: size * np.sin(t), 4 * np.pi)
        late = run.time > 2 * np.pi
        lost.append(np.trapezoid(run["joint.lossPower"][late], run.time[late]))
    powers = np.diff(np.log(lost)) / np.diff(np.log(sizes))
    assert powers == pytest.approx(2 + 1 / p, abs=0.1)


def test_with_all_yields_alike_it_is_a_hysteretic_spring() -> None:
    iwan = moved(ia.Iwan(k=K, s_y=YIELD, p=0.0, cells=3), wandering, 4.0)
    shape = 0.5 / YIELD**8
    spring = moved(ia.BoucWen(k=K, alpha=0.0, beta=shape, gamma=shape, n=8.0), wandering, 4.0)
    times = np.linspace(0.0, 4.0, 401)  # of both: a cell's law jumps at each turn, where points are two
    assert iwan.at("joint.f", times) == pytest.approx(spring.at("joint.f", times), abs=1e-6)


def test_turning_it_is_the_sliding_one_in_other_units() -> None:
    slid = moved(ia.Iwan(k=K, s_y=YIELD, p=1.5), wandering, 2.0)
    turned = moved(rotational.Iwan(c=K, phi_y=YIELD, p=1.5), wandering, 2.0, turning=True)
    assert turned["joint.tau"] == pytest.approx(slid["joint.f"], abs=1e-7)


def test_cells_are_counted() -> None:
    with pytest.raises(ia.ModelError, match="cells"):
        moved(ia.Iwan(k=K, s_y=YIELD, p=1.0, cells=0), wandering, 1.0)
