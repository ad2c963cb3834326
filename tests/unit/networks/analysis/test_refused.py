"""What analysis and sweeps cannot do is told, with the value and what to give instead."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import (
    StateSpace,
    Varied,
    bump,
    describing_function,
    harmonic_orbit,
    linearise,
    load_signal,
    pareto_front,
    quarter_car_damping,
    quarter_car_j1,
    response_psd,
    response_rms,
    ride_j1,
    road_profile,
    road_spectrum,
    scatter,
    stepped_sine,
    tune,
    tyre_j3,
    weighted_rms,
)
from inertance.machines import quarter_car, shear_frame, suspension, taut_cable, tid
from inertance.sweeps import latin_hypercube, monte_carlo, saltelli, sweep
from inertance.synthesis import synthesise

D = "strut.rest.damper.d"
NAN = np.full((1, 1), np.nan)


def car() -> ia.Network:
    return quarter_car(suspension("S4", 60e3, 3e3, 300.0))


def closed() -> ia.Network:
    """A mass on a spring, without inputs."""
    net = ia.Network("closed", wall=ia.Fixed(), spring=ia.Spring(k=1.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


class Tipping(ia.Compliant):
    """A spring that pushes away."""

    k = ia.parameter("N/m", "stiffness")

    def equations(self) -> Any:
        yield self.f == -self.k * self.s_rel


def tipping() -> ia.Network:
    net = ia.Network("tipping", wall=ia.Fixed(), spring=Tipping(k=1.0), mass=ia.Mass(m=1.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def sway(dae: ia.DAE, /, *, parameters: Any) -> float:
    return linearise(dae, "push.f", "mass.s", parameters=parameters).h2()


def one(values: dict[str, Any]) -> float:
    return 1.0


def test_an_unstable_network_has_no_norms() -> None:
    system = linearise(tipping(), "push.f", "mass.s")
    for norm in (system.h2(), system.hinf()):
        assert norm == np.inf
        assert norm.reason == "unstable: pole at 1+0j rad/s"
    with pytest.raises(ia.ModelError, match="no steady random response: unstable"):
        response_rms(system, 1.0, 0.1, 10.0)
    with pytest.raises(ia.ModelError, match="finite measure"):
        tune(tipping(), sway, {"spring.k": (1.0, 2.0)})


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("time,z\n0,0\n0.1,nan\n0.2,0\n0.3,1\n", "line 3, column 'z': nan is no usable number"),
        ("time,z\n0,0\n0.1,1\n0.2,inf\n0.3,1\n", "line 4, column 'z': inf is no usable number"),
        ("time,z\n0,0\n0.1,1\n0.05,0\n0.3,1\n", "line 4, column 'time': 0.05 comes after 0.1; sort"),
        ("time,z\n0,0\n0.1\n", "line 3: 1 cells under 2 names"),
        ("time,z\n0,0\n\n0.1,1\n", "line 3: 0 cells under 2 names"),
        ("time [mm];z\n0;0\n", "line 1, column 'time': 'mm' measures m, the quantity of the model is in s"),
        ("when,z\n0,0\n", "no column 'time'"),
        ("", "the file is empty"),
        ("time,z\n", "at least 4 samples"),
    ],
)
def test_a_bad_road_file_is_refused_at_its_line(text: str, told: str, tmp_path: Path) -> None:
    file = tmp_path / "road.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ia.ModelError, match=told):
        load_signal(file)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ("NPTS= 3, DT= .01\n1 2 x", "line 5, column 'acceleration': 'x' is no number"),
        ("NPTS= 9, DT= .01\n1 2 3 4", "says 9 values, there are 4"),
    ],
)
def test_a_bad_ground_motion_is_refused(values: str, told: str, tmp_path: Path) -> None:
    file = tmp_path / "quake.at2"
    file.write_text(f"PEER\nsomewhere\nin g\n{values}\n", encoding="utf-8")
    with pytest.raises(ia.ModelError, match=told):
        load_signal(file)


@pytest.mark.parametrize(
    ("go", "told"),
    [
        (lambda: linearise(closed()).h2(), "has no inputs"),
        (lambda: linearise(closed()).hinf(), "has no inputs"),
        (lambda: linearise(closed()).plot_bode(), "no inputs to draw"),
        (lambda: linearise(car(), "road.s_re"), r"did you mean 'road\.s_ref'"),
        (lambda: ride_j1(car(), body="bdoy"), r"did you mean 'body\.v'"),
        (lambda: ride_j1(car(), V=-25.0), "V must be above 0 m/s, got -25"),
        (lambda: ride_j1(car(), parameters=Varied({}, by=[f"{D}d"])), f"did you mean '{D}'"),
        (lambda: tune(car(), ride_j1, {D: (1e3, 2e3)}, start={f"{D}d": 1.0}), f"did you mean '{D}'"),
        (lambda: tune(car(), ride_j1, {D: (1.0, 2.0, 3.0)}), "lower to a higher"),  # type: ignore[dict-item]
        (lambda: tune(car(), ride_j1, {D: (1.0, np.inf)}), "lower to a higher"),
        (lambda: tune(car(), ride_j1, {D: (1e3, 2e3)}, limits=[(tyre_j3, 0.0)]), "limit must be"),
        (lambda: pareto_front(car(), ride_j1, tyre_j3, {D: (1e3, 2e3)}, points=1), "two ends"),
        (lambda: scatter(car(), ride_j1, {D: 0.1}, samples=0), "at least 2 samples"),
        (lambda: road_profile("A", -10.0, 10.0), "speed must be above 0 m/s, got -10"),
        (lambda: road_profile("A", 10.0, 100.0, low=3.0, high=1.0), "high must be above 3 cycle/m, got 1"),
        (lambda: road_spectrum("A", 0.0), "above 0 cycle/m"),
        (lambda: bump(0.1, 0.0, 10.0), "length must be above 0 m, got 0"),
        (lambda: weighted_rms([0.0], [1.0]), "at least 2"),
        (lambda: weighted_rms([0.0, 1.0, 2.0], [1.0, np.nan, 2.0]), "1 not finite"),
        (lambda: response_psd(linearise(car(), "road.s_ref", "body.v"), [-1.0]), "from 0 Hz"),
        (lambda: harmonic_orbit(closed(), "push.f", 1.0, 0.0, ["mass.s"]), "frequency must be from 1e-06"),
        (lambda: describing_function(ia.Spring(k=1.0), 0.0), "amplitude must be above 0"),
        (lambda: shear_frame([], []), "at least one floor"),
        (lambda: shear_frame(1e3, 1e6), "lists of m and k"),  # type: ignore[arg-type]
        (lambda: shear_frame([1.0], [1.0], absorbers={0: tid(1, 1, 1)}), "two floors"),  # type: ignore[dict-item]
        (lambda: shear_frame([1.0], [1.0], absorbers={(1, 1): tid(1, 1, 1)}), "two floors"),
        (lambda: taut_cable(0.0, 1e3, 1.0), "length above 0 m, got 0"),
        (lambda: quarter_car_damping(-1.0, 250.0, 35.0, 1e5), "k must be above 0, got -1"),
        (lambda: quarter_car_j1(1e4, 250.0, 35.0, 1e5, V=np.nan), "V must be a finite number, got nan"),
        (lambda: road_profile("A", 10.0, 1e9), "over 1e.07 waves"),
        (lambda: road_profile("A", 10.0, np.inf), "duration must be a finite number"),
        (lambda: road_profile("A", 10.0, 100.0, seed=-1), "seed must be a whole number, at least 0"),
        (lambda: bump(np.nan, 1.0, 1.0), "height must be a finite number"),
        (lambda: weighted_rms([2.0, 1.0, 0.0], [1.0, 2.0, 3.0]), "rising instants"),
        (lambda: tune(car(), 3, {D: (1e3, 2e3)}), "a measure is a function"),  # type: ignore[arg-type]
        (lambda: scatter(car(), ride_j1, {D: -0.1}), "at least 0"),
        (lambda: scatter(car(), ride_j1, {}), "there are none"),
        (lambda: stepped_sine(car(), "road.s_ref", 1e-3, [], ["body.s"]), "frequencies must be a number"),
        (lambda: harmonic_orbit(car(), "road.s_ref", 1.0, 1.0, ["body.s"], harmonics=0), "at least 1"),
        (lambda: harmonic_orbit(car(), "road.s_ref", np.nan, 1.0, ["body.s"]), "must be a finite"),
        (lambda: describing_function(ia.Mass(m=1.0), 1.0), "flange_a and flange_b"),
        (lambda: StateSpace(NAN, NAN, NAN, NAN), "finite numbers"),
        (lambda: synthesise(([1j], [1.0])), "finite real numbers"),
        (lambda: suspension("s4", 1.0, 1.0), "got 's4'"),
        (lambda: sweep(None, {"x": []}, one), "one parameter and one point"),
        (lambda: sweep(None, {}, one), "one parameter and one point"),
        (lambda: sweep(None, {"x": "abc"}, one), "takes a list of values"),
        (lambda: sweep(None, {"x": 3.0}, one), "takes a list of values"),  # type: ignore[dict-item]
        (lambda: sweep(None, {"x": [1.0]}, one, workers=-1), "at least 0"),
        (lambda: sweep(None, {"x": [1.0]}, None), "a measure is a function"),  # type: ignore[arg-type]
        (lambda: latin_hypercube({"x": (0.0, 1.0)}, 0), "at least one point"),
        (lambda: monte_carlo({"x": (0.0, 1.0)}, -1), "at least one point"),
        (lambda: saltelli({"x": (0.0, 1.0)}, 100), "take 128, not 100"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_told(go: Callable[[], object], told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        go()
