"""Tuning with limits, fronts and scatter; roads, bumps and records from files."""

from collections.abc import Mapping
from math import sqrt
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import Norm, Varied
from inertance.machines import TMDI

D, K = "strut.d", "strut.k"
BOUNDS = {D: (500.0, 10e3)}


def car() -> ia.DAE:
    return ia.machines.quarter_car(ia.SpringDamper(k=60e3, d=2000.0)).dae()


def test_a_limit_is_kept_and_costs() -> None:
    dae = car()
    bound = ia.analysis.tune(dae, ia.analysis.ride_j1, {K: (20e3, 60e3), **BOUNDS}, starts=1)
    travel = ia.analysis.suspension_travel(dae, parameters=bound.parameters)
    kept = ia.analysis.tune(
        dae,
        ia.analysis.ride_j1,
        {K: (20e3, 60e3), **BOUNDS},
        limits=[(ia.analysis.suspension_travel, 0.8 * travel)],
        starts=1,
    )
    assert ia.analysis.suspension_travel(dae, parameters=kept.parameters) <= 0.8 * travel * (1 + 1e-6)
    assert kept.value > bound.value
    assert K in bound.at_bound


@pytest.mark.parametrize("missing", [False, True], ids=["value on the bound", "none on the bound"])
@pytest.mark.parametrize("seed", range(3))
def test_a_parameter_is_driven_to_its_bound_whatever_the_last_bits(seed: int, missing: bool) -> None:
    noise = np.random.default_rng(seed)

    def softness(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
        if missing and parameters[K] <= 20e3:
            raise ia.ModelError("there is nothing to solve for")
        bits = 1 + 1e-15 * noise.standard_normal()
        return bits * (parameters[K] / 20e3 + (parameters[D] / 1e3 - 2) ** 2)

    found = ia.analysis.tune(car(), softness, {K: (20e3, 60e3), **BOUNDS}, starts=1)
    assert found.at_bound == (K,)
    assert found.parameters[K] == pytest.approx(20e3, rel=1e-9 if missing else 0, abs=0)
    assert found.parameters[D] == pytest.approx(2e3, rel=1e-4)


def test_a_front_goes_from_one_optimum_to_the_other() -> None:
    dae = car()
    designs = ia.analysis.pareto_front(
        dae, ia.analysis.ride_j1, ia.analysis.suspension_travel, {D: (1500.0, 6e3)}, points=4, starts=1
    )
    first, second = zip(*[d[:2] for d in designs], strict=True)
    assert len(designs) == 4
    assert list(first) == sorted(first)
    assert list(second) == sorted(second, reverse=True)
    assert first[0] == pytest.approx(1.759967, abs=1e-6)
    assert designs[-1][2][D] == pytest.approx(6e3, rel=1e-6)


def test_scatter_of_a_linear_measure_is_that_of_its_parameter() -> None:
    def stiffness(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
        return parameters.get(K, 60e3)

    spread = ia.analysis.scatter(car(), stiffness, {K: 0.05}, samples=400)
    assert spread.nominal == 60e3
    assert spread.mean == pytest.approx(60e3, rel=1e-3)
    assert spread.std == pytest.approx(0.05 * 60e3, rel=0.02)
    assert spread.quantile(0.975) == pytest.approx(60e3 * (1 + 0.05 * 1.95), rel=0.01)


def test_what_cannot_be_tuned_is_told() -> None:
    with pytest.raises(ia.ModelError, match=r"did you mean 'strut\.k'"):
        ia.analysis.tune(car(), ia.analysis.ride_j1, {"strut.e": (1.0, 2.0)})
    with pytest.raises(ia.ModelError, match="lower to a higher"):
        ia.analysis.tune(car(), ia.analysis.ride_j1, {D: (2.0, 1.0)})
    with pytest.raises(ia.ModelError, match=r"ride_j1 <= 0\.1"):
        ia.analysis.tune(car(), ia.analysis.tyre_j3, BOUNDS, limits=[(ia.analysis.ride_j1, 0.1)], starts=1)


def test_bump_lifts_a_car_and_lets_it_down() -> None:
    run = ia.machines.quarter_car(ia.SpringDamper(k=60e3, d=2600.0)).simulate(
        3.0, inputs={"road.s_ref": ia.analysis.bump(0.05, 2.0, 10.0, begin=0.1)}
    )
    assert run["road.s_ref"].max() == pytest.approx(0.05, rel=1e-3)
    assert abs(run["body.s"][-1]) < 1e-4
    assert run["body.s"].max() > 0.02


def test_records_are_read_from_files(tmp_path: Path) -> None:
    table = tmp_path / "wind.csv"
    table.write_text("time,force\n0,1\n0.1,2\n0.2,4\n0.3,3\n", encoding="utf-8")
    assert ia.analysis.load_signal(table, scale=1e3).values.tolist() == [1e3, 2e3, 4e3, 3e3]
    with pytest.raises(ia.ModelError, match="did you mean 'force'"):
        ia.analysis.load_signal(table, "forse")
    table.write_text("time,force\n0,1\n0.1,x\n", encoding="utf-8")
    with pytest.raises(ia.ModelError, match="line 3"):
        ia.analysis.load_signal(table)
    quake = tmp_path / "quake.at2"
    quake.write_text(
        "PEER\nsomewhere\nacceleration in g\nNPTS=   5, DT=   .0100 SEC\n 0 .1 .2\n .1 0\n", encoding="utf-8"
    )
    found = ia.analysis.load_signal(quake)
    assert found.time[1] == 0.01
    assert found.values[2] == pytest.approx(0.2 * 9.80665)


def test_road_too_short_for_its_waves_is_told() -> None:
    with pytest.raises(ia.ModelError, match="holds no wave"):
        ia.analysis.road_profile("A", 10.0, 1.0)
    with pytest.raises(ia.ModelError, match="A to H"):
        ia.analysis.roughness("Z")


def test_base_shear_and_drift_of_one_storey() -> None:
    zeta, w = 0.05, 10.0
    frame = ia.machines.shear_frame([1e3], [1e3 * w**2], [2 * zeta * 1e3 * w])
    peak = 1 / (2 * zeta * sqrt(1 - zeta**2) * w**2)
    assert ia.analysis.storey_drift(frame) == pytest.approx(peak, rel=1e-9)
    assert ia.analysis.base_shear(frame) == pytest.approx(1e3 * sqrt(1 + 4 * zeta**2) * w**2 * peak, rel=2e-3)


def test_white_noise_by_the_spectrum_and_by_lyapunov() -> None:
    system = ia.analysis.linearise(car(), ["road.s_ref"], ["body.v"])
    rms = ia.analysis.response_rms(system, 2.0, 1e-3, 1e4)["body.v"]
    assert rms == pytest.approx(system.h2(), rel=1e-4)  # one-sided 2 is two-sided 1
    assert np.isscalar(rms)


STRUTS: Mapping[str, ia.Component] = {
    layout: ia.machines.suspension(layout, 60e3, 3e3, b=100.0, k_b=1e5, k_1=1e3, k_2=2e3)
    for layout in ("S1", "S2", "S4", "S5", "S7", "S8")
} | {"hardening": ia.parallel(ia.CubicSpring(k=60e3, k3=1e7), ia.Damper(d=3e3))}


@pytest.mark.parametrize("strut", STRUTS)
@pytest.mark.parametrize(
    "measure",
    [
        ia.analysis.ride_j1,
        ia.analysis.tyre_j3,
        ia.analysis.load_j5,
        ia.analysis.suspension_travel,
        ia.analysis.ride_comfort,
    ],
    ids=lambda m: m.__name__,
)
def test_gradients_of_measures_are_exact(strut: str, measure: Any) -> None:
    """Against central differences, whose error is what the tolerance allows."""
    dae = ia.machines.quarter_car(STRUTS[strut].clone(), m_s=240.0).dae()
    names = [n for n in dae.parameter_values if n.startswith("strut.") and not n.endswith("s_rel0")]
    given = {name: dae.parameter_values[name] for name in names}
    norm = measure(dae, parameters=Varied(given))
    assert isinstance(norm, Norm)
    if np.isinf(norm):
        assert norm.reason
        return
    assert set(norm.gradient) == set(names)
    for name in names:
        step = 1e-4 * (given[name] or 1e6)  # k2, which is 0, beside k and k3
        ahead, behind = (measure(dae, parameters=given | {name: given[name] + e}) for e in (step, -step))
        tolerance = (
            (1e-9 if measure is ia.analysis.ride_comfort else 1e-11) * norm / step
        )  # rounding, by the filter's
        assert norm.gradient[name] == pytest.approx((ahead - behind) / (2 * step), rel=1e-4, abs=tolerance)


def test_gradient_follows_the_operating_point() -> None:
    """A weight on a hardening spring: its slope, and what it has of it, depend on where it hangs."""
    net = ia.Network(
        "hanging", wall=ia.Fixed(), spring=ia.CubicSpring(k=100.0, k3=1e5), damper=ia.Damper(d=2.0),
        mass=ia.Mass(m=1.0), weight=ia.ConstantForce(f_constant=9.81), push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b)
    net.connect(net.mass.flange, net.spring.flange_b, net.weight.flange, net.push.flange)
    dae, given = net.dae(), {"weight.f_constant": 9.81, "spring.k3": 1e5, "spring.k": 100.0}

    def sway(parameters: Mapping[str, float]) -> Norm:
        return ia.analysis.linearise(dae, ["push.f"], ["mass.s"], parameters=parameters).h2()

    norm = sway(Varied(given))
    x = sway(given)
    assert norm == pytest.approx(x, rel=1e-12)
    for name, value in given.items():
        expected = (
            sway(given | {name: value * (1 + 1e-5)}) - sway(given | {name: value * (1 - 1e-5)})
        ) / 2e-5
        assert norm.gradient[name] * value == pytest.approx(expected, rel=1e-6)


def test_peak_of_several_inputs_has_its_gradient() -> None:
    frame = ia.machines.shear_frame([1.0, 1.2], [1.0, 0.8], [0.02, 0.03]).dae()
    given = {"storey1.k": 1.0, "storey2.d": 0.03, "floor2.m": 1.2}

    def worst(parameters: Mapping[str, float]) -> Norm:
        inputs = ["wind.f", "der(der(ground.s_ref))"]
        return ia.analysis.linearise(
            frame, inputs, ["storey1.s_rel", "storey2.s_rel"], parameters=parameters
        ).hinf()

    norm = worst(Varied(given))
    assert len(norm.peaks) >= 2
    for name, value in given.items():
        ahead, behind = (worst(given | {name: value * factor}) for factor in (1 + 1e-4, 1 - 1e-4))
        assert norm.gradient[name] * value == pytest.approx((ahead - behind) / 2e-4, rel=1e-5)


def test_an_absorber_is_tuned_to_two_equal_peaks_in_few_steps() -> None:
    mu = 0.05
    frame = ia.machines.shear_frame(
        [1.0], [1.0], absorbers={(0, 1): ia.machines.tid(0.8 * mu, 0.05 * mu, mu)}
    )

    def peak(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> Norm:
        return ia.analysis.linearise(dae, ["wind.f"], ["floor1.s"], parameters=parameters).hinf()

    bounds = {"absorber1.link.k": (0.5 * mu, mu), "absorber1.link.d": (0.01 * mu, mu)}
    tuned = ia.analysis.tune(frame, peak, bounds, starts=1)
    assert tuned.exact
    assert tuned.value == pytest.approx(6.40792, abs=1e-5)
    assert tuned.evaluations < 40
    first, second = peak(frame.dae(), parameters=Varied(tuned.parameters)).peaks[:2]
    assert first == pytest.approx(second, rel=1e-7)


def test_a_measure_whose_derivatives_are_not_its_own_is_tuned_by_differences() -> None:
    dae = car()

    def cheap(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
        norm = ia.analysis.ride_j1(dae, parameters=parameters)
        return Norm(norm + parameters[D] * 1e-3, gradient=norm.gradient)

    def squared(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
        return ia.analysis.ride_j1(dae, parameters=parameters) ** 2

    tuned = ia.analysis.tune(dae, cheap, BOUNDS, starts=1)
    assert not tuned.exact
    assert tuned.parameters[D] < 2000.0
    tuned = ia.analysis.tune(dae, squared, BOUNDS, starts=1)
    assert not tuned.exact
    assert tuned.parameters[D] == pytest.approx(2615.34, rel=1e-4)


def test_peaks_that_merge_on_the_way_do_not_stop_the_search() -> None:
    """A TMDI of 2 % mass and 10 % inertance from a start with one peak twice the other."""
    absorber = TMDI(m=0.02, k=0.08, d=0.02, b=0.1)
    dae = ia.machines.shear_frame([1.0], [1.0], [0.02], {(0, 1): absorber}).dae()

    def peak(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
        return ia.analysis.linearise(dae, ["wind.f"], ["floor1.s"], parameters=parameters).hinf()

    bounds = {"absorber1.k": (0.02, 0.4), "absorber1.d": (1e-3, 0.2)}
    start = {"absorber1.k": 0.08, "absorber1.d": 0.02}
    tuned = ia.analysis.tune(dae, peak, bounds, start=start, starts=1)
    assert tuned.value == pytest.approx(3.94323135, abs=1e-8)  # by Nelder-Mead on the transfer function
    assert tuned.evaluations < 100


def test_gradient_goes_through_algebraic_unknowns() -> None:
    """A hardening spring in series with another, under a load: the force between them is not solved for."""
    strut = ia.series(hard=ia.CubicSpring(k=100.0, k3=1e4), soft=ia.Spring(k=50.0))
    net = ia.Network(
        "series", wall=ia.Fixed(), strut=strut, damper=ia.Damper(d=1.0), mass=ia.Mass(m=1.0), push=ia.Force()
    )
    net.connect(net.wall.flange, net.strut.flange_a, net.damper.flange_a)
    net.connect(net.strut.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    dae, given = net.dae(), {"strut.hard.k": 100.0, "strut.hard.k3": 1e4, "strut.soft.k": 50.0}
    assert dae.z.numel() == 1

    def sway(parameters: Mapping[str, float]) -> Norm:
        return ia.analysis.linearise(
            dae, "push.f", "mass.s", signals={"push.f": 3.0}, parameters=parameters
        ).h2()

    norm = sway(Varied(given))
    for name, value in given.items():
        ahead, behind = (sway(given | {name: value * factor}) for factor in (1 + 1e-5, 1 - 1e-5))
        assert norm.gradient[name] * value == pytest.approx((ahead - behind) / 2e-5, rel=1e-6)
