"""Quarter car: published and twice computed optima, S1-S8 as in the literature, real inerters."""

from math import pi, sqrt
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import Tuned

J1 = {  # layout, k: (J1, d, b)
    ("S1", 60e3): (1.759967, 2615.339, None),
    ("S3", 60e3): (1.660764, 2328.81, 31.266),
    ("S4", 60e3): (1.585094, 3224.24, 333.298),
    ("S1", 120e3): (2.488969, 5230.679, None),
    ("S3", 120e3): (2.215093, 4142.89, 122.741),
    ("S4", 120e3): (2.082711, 7470.32, 447.298),
}
J3 = {
    ("S1", 60e3): (507.985, 2682.4, None),
    ("S3", 60e3): (507.985, 2682.4, 0.0),
    ("S4", 60e3): (477.811, 3031.92, 383.425),
    ("S1", 120e3): (686.720, 4902.2, None),
    ("S3", 120e3): (655.809, 4470.79, 87.649),
    ("S4", 120e3): (594.654, 6537.61, 450.722),
}
D = {"S1": "strut.rest.d", "S3": "strut.rest.damper.d", "S4": "strut.rest.damper.d"}
B = "strut.rest.inerter.b"


def tuned(layout: str, k: float, measure: Any) -> Tuned:
    car = ia.machines.quarter_car(ia.machines.suspension(layout, k, 3e3, b=100.0))
    bounds = {D[layout]: (500.0, 15e3)} | ({B: (0.0, 1000.0)} if layout != "S1" else {})
    return ia.analysis.tune(car, measure, bounds, starts=1)


@pytest.mark.parametrize(("layout", "k"), J1)
def test_ride_optimum(layout: str, k: float) -> None:
    value, d, b = J1[layout, k]
    best = tuned(layout, k, ia.analysis.ride_j1)
    assert best.value == pytest.approx(value, abs=1e-6)
    assert best.parameters[D[layout]] == pytest.approx(d, rel=5e-6)
    assert b is None or best.parameters[B] == pytest.approx(b, rel=2e-5)


@pytest.mark.parametrize(("layout", "k"), J3)
def test_tyre_load_optimum(layout: str, k: float) -> None:
    value, d, b = J3[layout, k]
    best = tuned(layout, k, ia.analysis.tyre_j3)
    assert best.value == pytest.approx(value, abs=1e-3)
    assert best.parameters[D[layout]] == pytest.approx(d, rel=2e-5)
    assert b is None or best.parameters[B] == pytest.approx(b, rel=1e-5, abs=2e-7)
    assert (B in best.at_bound) == (b == 0.0)


@pytest.mark.parametrize("k", [60e3, 120e3])
def test_closed_form_of_spring_and_damper(k: float) -> None:
    d = ia.analysis.quarter_car_damping(k, 250.0, 35.0, 150e3)
    car = ia.machines.quarter_car(ia.machines.suspension("S1", k, d))
    assert ia.analysis.ride_j1(car) == pytest.approx(
        ia.analysis.quarter_car_j1(k, 250.0, 35.0, 150e3), rel=1e-12
    )


def test_ride_is_the_rms_of_a_simulated_drive() -> None:
    """J1 against 60 s on a random road of the same kappa; the road is cut off in wavelength."""
    car = ia.machines.quarter_car(ia.machines.suspension("S1", 60e3, 2615.0)).dae()
    low, high, speed = 0.011, 2.83, 25.0
    road = ia.analysis.road_profile("C", speed, 60.0, seed=3, low=low, high=high)
    run = ia.simulate(car, 60.0, inputs={"road.s_ref": road}, step=4e-3)
    system = ia.analysis.linearise(car, ["road.s_ref"], ["body.a"])

    def spectrum(f: Any) -> Any:
        return ia.analysis.road_spectrum("C", f / speed) / speed

    rms = ia.analysis.response_rms(system, spectrum, low * speed, high * speed)
    assert run.std("body.a") == pytest.approx(rms["body.a"], rel=0.05)
    whole = ia.analysis.ride_j1(car, V=speed, kappa=ia.analysis.roughness("C"))
    assert rms["body.a"] == pytest.approx(whole, rel=0.01)


def test_classes_of_roads() -> None:
    assert [1e6 * ia.analysis.road_spectrum(c, 0.1) for c in "ABCDE"] == pytest.approx(
        [16, 64, 256, 1024, 4096]
    )
    n = np.array([0.05, 0.2])
    assert np.log(ia.analysis.road_spectrum("A", n[1]) / ia.analysis.road_spectrum("A", n[0])) / np.log(
        4
    ) == pytest.approx(-2)
    road = ia.analysis.road_profile("B", 20.0, 100.0, seed=1)
    frequency = np.fft.rfftfreq(len(road.time) - 1, road.time[1])
    power = 2 * np.abs(np.fft.rfft(road.values[:-1]) / (len(road.time) - 1)) ** 2 * 100.0
    band = (frequency > 1.0) & (frequency < 40.0)
    assert power[band] == pytest.approx(
        ia.analysis.road_spectrum("B", frequency[band] / 20.0) / 20.0, rel=1e-6
    )


RANGES = {"d": (100.0, 30e3), "b": (1.0, 3000.0), "k": (100.0, 1e8)}


def best_of(layout: str, k: float, measure: Any) -> Tuned:
    car = ia.machines.quarter_car(
        ia.machines.suspension(layout, k, 3e3, 300.0, k_b=1e6, k_1=1e3, k_2=1e3)
    ).dae()
    free = [n for n in car.parameter_values if n.startswith("strut.rest") and n[-1] in RANGES]
    bounds = {n: RANGES[n[-1]] for n in free}
    start = {n: car.parameter_values[n] for n in bounds}
    return ia.analysis.tune(car, measure, bounds, start=start, starts=1)


BETTER = [("S3", "S1"), ("S6", "S4")]


@pytest.mark.parametrize("measure", [ia.analysis.ride_j1, ia.analysis.tyre_j3])
def test_layouts_are_ranked_as_their_generality_demands(measure: Any) -> None:
    """A layout that contains another is as good; inerters in series beat both layouts without one."""
    layouts = ("S1", "S2", "S3", "S4", "S6")
    from_layout = {layout: best_of(layout, 60e3, measure).value for layout in layouts}
    for general, special in BETTER:
        assert from_layout[general] <= from_layout[special] * (1 + 1e-3)
    without = min(from_layout["S1"], from_layout["S2"])
    assert max(from_layout[name] for name in ("S4", "S6")) < without


def test_load_and_travel_against_equations_by_hand() -> None:
    """J5 as the greatest gain on a fine grid; rms travel by the integral over all frequencies."""
    m_s, m_u, k_t, k, d, V, kappa = 250.0, 35.0, 150e3, 60e3, 2600.0, 25.0, 5e-7
    car = ia.machines.quarter_car(ia.machines.suspension("S1", k, d))

    def moved(w: Any, force: float, road: float) -> Any:
        s = 1j * w
        strut = k + d * s
        det = (m_s * s**2 + strut) * (m_u * s**2 + strut + k_t) - strut**2
        z_s = (force * (m_u * s**2 + strut + k_t) + strut * k_t * road) / det
        z_u = (force * strut + (m_s * s**2 + strut) * k_t * road) / det
        return z_s, z_s - z_u

    w = np.linspace(1e-3, 400.0, 400_001)
    found = ia.analysis.load_j5(car)
    assert found == pytest.approx(abs(moved(w, 1.0, 0.0)[0]).max(), rel=1e-8)
    assert found.frequency is not None
    power = abs(moved(w, 0.0, 1.0)[1] / w) ** 2
    rms = 2 * pi * sqrt(V * kappa) * sqrt(np.trapezoid(power, w) / pi)
    assert ia.analysis.suspension_travel(car, V=V, kappa=kappa) == pytest.approx(rms, rel=1e-3)


def test_iso_2631_weights_are_those_of_the_table() -> None:
    f = [0.5, 1.0, 2.0, 4.0, 6.3, 8.0, 16.0, 31.5, 80.0]
    table = [0.418, 0.482, 0.531, 0.967, 1.054, 1.036, 0.768, 0.405, 0.132]
    assert abs(ia.analysis.comfort_filter("Wk").response(f).ravel()) == pytest.approx(table, rel=3e-3)
    sideways = [0.853, 1.011, 0.890, 0.512, 0.323, 0.253, 0.125, 0.0632]
    assert abs(ia.analysis.comfort_filter("Wd").response(f[:-1]).ravel()) == pytest.approx(sideways, rel=0.02)


def test_comfort_of_a_record_is_that_of_the_spectrum() -> None:
    t = np.arange(0.0, 60.0, 2e-3)
    felt = ia.analysis.weighted_rms(t, np.sin(2 * pi * 5.0 * t))
    assert felt == pytest.approx(abs(ia.analysis.comfort_filter().response(5.0).item()) / sqrt(2), rel=0.01)
