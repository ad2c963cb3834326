"""What analysis and sweeps cannot do is told, with the value and what to give instead."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import StateSpace, Varied

D = "strut.rest.damper.d"
NAN = np.full((1, 1), np.nan)


def car() -> ia.Network:
    return ia.machines.quarter_car(ia.machines.suspension("S4", 60e3, 3e3, 300.0))


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
    return ia.analysis.linearise(dae, "push.f", "mass.s", parameters=parameters).h2()


def one(values: dict[str, Any]) -> float:
    return 1.0


def test_an_unstable_network_has_no_norms() -> None:
    system = ia.analysis.linearise(tipping(), "push.f", "mass.s")
    for norm in (system.h2(), system.hinf()):
        assert norm == np.inf
        assert norm.reason == "unstable: pole at 1+0j rad/s"
    with pytest.raises(ia.ModelError, match="no steady random response: unstable"):
        ia.analysis.response_rms(system, 1.0, 0.1, 10.0)
    with pytest.raises(ia.ModelError, match="finite measure"):
        ia.analysis.tune(tipping(), sway, {"spring.k": (1.0, 2.0)})


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
        ia.analysis.record(file)


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
        ia.analysis.record(file)


@pytest.mark.parametrize(
    ("go", "told"),
    [
        (lambda: ia.analysis.linearise(closed()).h2(), "has no inputs"),
        (lambda: ia.analysis.linearise(closed()).hinf(), "has no inputs"),
        (lambda: ia.analysis.linearise(closed()).plot_bode(), "no inputs to draw"),
        (lambda: ia.analysis.linearise(car(), "road.s_re"), r"did you mean 'road\.s_ref'"),
        (lambda: ia.analysis.ride_j1(car(), body="bdoy"), r"did you mean 'body\.v'"),
        (lambda: ia.analysis.ride_j1(car(), V=-25.0), "V must be above 0 m/s, got -25"),
        (lambda: ia.analysis.ride_j1(car(), parameters=Varied({}, by=[f"{D}d"])), f"did you mean '{D}'"),
        (
            lambda: ia.analysis.tune(car(), ia.analysis.ride_j1, {D: (1e3, 2e3)}, start={f"{D}d": 1.0}),
            f"did you mean '{D}'",
        ),
        (lambda: ia.analysis.tune(car(), ia.analysis.ride_j1, {D: (1.0, 2.0, 3.0)}), "lower to a higher"),  # type: ignore[dict-item]
        (lambda: ia.analysis.tune(car(), ia.analysis.ride_j1, {D: (1.0, np.inf)}), "lower to a higher"),
        (
            lambda: ia.analysis.tune(
                car(), ia.analysis.ride_j1, {D: (1e3, 2e3)}, limits=[(ia.analysis.tyre_j3, 0.0)]
            ),
            "limit must be",
        ),
        (
            lambda: ia.analysis.front(
                car(), ia.analysis.ride_j1, ia.analysis.tyre_j3, {D: (1e3, 2e3)}, points=1
            ),
            "two ends",
        ),
        (lambda: ia.analysis.scatter(car(), ia.analysis.ride_j1, {D: 0.1}, samples=0), "at least 2 samples"),
        (lambda: ia.analysis.road_profile("A", -10.0, 10.0), "speed must be above 0 m/s, got -10"),
        (
            lambda: ia.analysis.road_profile("A", 10.0, 100.0, low=3.0, high=1.0),
            "high must be above 3 cycle/m, got 1",
        ),
        (lambda: ia.analysis.road_spectrum("A", 0.0), "above 0 cycle/m"),
        (lambda: ia.analysis.bump(0.1, 0.0, 10.0), "length must be above 0 m, got 0"),
        (lambda: ia.analysis.weighted_rms([0.0], [1.0]), "at least 2"),
        (lambda: ia.analysis.weighted_rms([0.0, 1.0, 2.0], [1.0, np.nan, 2.0]), "1 not finite"),
        (
            lambda: ia.analysis.response_psd(ia.analysis.linearise(car(), "road.s_ref", "body.v"), [-1.0]),
            "from 0 Hz",
        ),
        (
            lambda: ia.analysis.harmonic_orbit(closed(), "push.f", 1.0, 0.0, ["mass.s"]),
            "frequency must be from 1e-06",
        ),
        (lambda: ia.analysis.describing_function(ia.Spring(k=1.0), 0.0), "amplitude must be above 0"),
        (lambda: ia.machines.shear_frame([], []), "at least one floor"),
        (lambda: ia.machines.shear_frame(1e3, 1e6), "lists of m and k"),  # type: ignore[arg-type]
        (
            lambda: ia.machines.shear_frame([1.0], [1.0], absorbers={0: ia.machines.tid(1, 1, 1)}),
            "two floors",
        ),  # type: ignore[dict-item]
        (
            lambda: ia.machines.shear_frame([1.0], [1.0], absorbers={(1, 1): ia.machines.tid(1, 1, 1)}),
            "two floors",
        ),
        (lambda: ia.machines.taut_cable(0.0, 1e3, 1.0), "length above 0 m, got 0"),
        (lambda: ia.analysis.quarter_car_damping(-1.0, 250.0, 35.0, 1e5), "k must be above 0, got -1"),
        (
            lambda: ia.analysis.quarter_car_j1(1e4, 250.0, 35.0, 1e5, V=np.nan),
            "V must be a finite number, got nan",
        ),
        (lambda: ia.analysis.road_profile("A", 10.0, 1e9), "over 1e.07 waves"),
        (lambda: ia.analysis.road_profile("A", 10.0, np.inf), "duration must be a finite number"),
        (
            lambda: ia.analysis.road_profile("A", 10.0, 100.0, seed=-1),
            "seed must be a whole number, at least 0",
        ),
        (lambda: ia.analysis.bump(np.nan, 1.0, 1.0), "height must be a finite number"),
        (lambda: ia.analysis.weighted_rms([2.0, 1.0, 0.0], [1.0, 2.0, 3.0]), "rising instants"),
        (lambda: ia.analysis.tune(car(), 3, {D: (1e3, 2e3)}), "a measure is a function"),  # type: ignore[arg-type]
        (lambda: ia.analysis.scatter(car(), ia.analysis.ride_j1, {D: -0.1}), "at least 0"),
        (lambda: ia.analysis.scatter(car(), ia.analysis.ride_j1, {}), "there are none"),
        (
            lambda: ia.analysis.stepped_sine(car(), "road.s_ref", 1e-3, [], ["body.s"]),
            "frequencies must be a number",
        ),
        (
            lambda: ia.analysis.harmonic_orbit(car(), "road.s_ref", 1.0, 1.0, ["body.s"], harmonics=0),
            "at least 1",
        ),
        (
            lambda: ia.analysis.harmonic_orbit(car(), "road.s_ref", np.nan, 1.0, ["body.s"]),
            "must be a finite",
        ),
        (lambda: ia.analysis.describing_function(ia.Mass(m=1.0), 1.0), "flange_a and flange_b"),
        (lambda: StateSpace(NAN, NAN, NAN, NAN), "finite numbers"),
        (lambda: ia.synthesis.synthesise(([1j], [1.0])), "finite real numbers"),
        (lambda: ia.machines.suspension("s4", 1.0, 1.0), "got 's4'"),
        (lambda: ia.sweeps.sweep(None, {"x": []}, one), "one parameter and one point"),
        (lambda: ia.sweeps.sweep(None, {}, one), "one parameter and one point"),
        (lambda: ia.sweeps.sweep(None, {"x": "abc"}, one), "takes a list of values"),
        (lambda: ia.sweeps.sweep(None, {"x": 3.0}, one), "takes a list of values"),  # type: ignore[dict-item]
        (lambda: ia.sweeps.sweep(None, {"x": [1.0]}, one, workers=-1), "at least 0"),
        (lambda: ia.sweeps.sweep(None, {"x": [1.0]}, None), "a measure is a function"),  # type: ignore[arg-type]
        (lambda: ia.sweeps.latin_hypercube({"x": (0.0, 1.0)}, 0), "at least one point"),
        (lambda: ia.sweeps.monte_carlo({"x": (0.0, 1.0)}, -1), "at least one point"),
        (lambda: ia.sweeps.saltelli({"x": (0.0, 1.0)}, 100), "take 128, not 100"),
    ],
)
def test_what_makes_no_sense_is_told(go: Callable[[], object], told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        go()
