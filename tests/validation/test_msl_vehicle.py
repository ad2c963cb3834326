"""MSL's Translational example Vehicle, built from parts: wheel, mass, drag, rolling resistance, slope.

Source: Modelica Standard Library 4.1.0, Mechanics.Translational.Examples.Vehicle and Components.Vehicle.
"""

from collections.abc import Iterable
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational, signals
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRAVITY = 9.80665
TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}
# from when, until when, drive as a multiple of what holds 25/3.5 m/s on flat ground, tangent of the slope
LEGS = [
    (0.0, 5.0, 0.0, 0.0),
    (5.0, 10.8, 5.6, 0.0),
    (10.8, 20.0, 1.0, 0.0),
    (20.0, 25.0, 2.8, 0.05),
    (25.0, 50.0, 1.0, 0.0),
    (50.0, 55.0, -5.0, 0.0),
    (55.0, 60.0, 0.0, 0.0),
]
HOLDING = 0.5 * 1.18 * 0.5 * (25 / 3.5) ** 2 + 0.01 * 100 * GRAVITY


class RollingResistance(ia.CoulombFriction):
    """Friction of what rolls on a slope: f_c cos(atan(inclination))."""

    inclination = ia.RealInput("1", "tangent of the slope")

    def sliding(self, speed: Any) -> Any:
        return self.f_c * ca.cos(ca.atan(self.inclination)) + 0 * speed


class CreepingResistance(ia.CompliantWithSpeed):
    """As MSL has it: the same, growing linearly with speed up to v0 instead of sticking."""

    inclination = ia.RealInput("1", "tangent of the slope")
    f_c = ia.parameter("N", "friction force on flat ground", min=0)
    v0 = ia.parameter("m/s", "speed from which the friction is f_c", above=0, default=1e-3)

    def equations(self) -> Iterable[Any]:
        share = ca.fmin(ca.fmax(self.v_rel / self.v0, -1), 1)
        yield self.f == self.f_c * ca.cos(ca.atan(self.inclination)) * share


class Slope(ia.Component):
    """Weight along a slope, backward where it rises: f = weight sin(atan(inclination))."""

    flange = ia.TranslationalFlange("what is on the slope")
    inclination = ia.RealInput("1", "tangent of the slope")
    weight = ia.parameter("N", "weight")

    def equations(self) -> Iterable[Any]:
        yield self.flange.f == self.weight * ca.sin(ca.atan(self.inclination))


class Vehicle(ia.Component):
    """A vehicle driven through its wheel."""

    flange_r = ia.RotationalFlange("axle of the driven wheel")
    flange_t = ia.TranslationalFlange("coupling")
    inclination = ia.RealInput("1", "tangent of the slope")
    m = ia.parameter("kg", "mass", above=0)

    wheel = ia.RollingWheel(R=0.25)
    mass = ia.Mass(m=m)
    drag = ia.QuadraticDamper(c=0.5 * 0.5 * 1.2)
    rolling: ia.Component = RollingResistance(f_c=lambda self: 0.01 * GRAVITY * self.m)
    slope = Slope(weight=lambda self: GRAVITY * self.m)
    road = ia.Fixed()

    def connections(self) -> Iterable[Any]:
        yield self.flange_r, self.wheel.flange_r
        yield self.flange_t, self.wheel.flange_t, self.mass.flange, self.slope.flange
        yield self.mass.flange, self.drag.flange_b, self.rolling.flange_b
        yield self.road.flange, self.drag.flange_a, self.rolling.flange_a
        yield self.inclination, self.slope.inclination, self.rolling.inclination


def jumps(column: int) -> tuple[tuple[float, float], ...]:
    """Return a time table of a column of LEGS."""
    return tuple((t, leg[column]) for leg in LEGS for t in leg[:2])


def journey(**parts: Any) -> ia.Result:
    """Run a vehicle alone, and one with twice the drive before a trailer like itself."""
    vehicles = {
        name: Vehicle(m=100, **{part: build() for part, build in parts.items()})
        for name in ("vehicle", "vehicle1", "trailer")
    }
    net = Network(
        "Vehicle",
        factor=signals.TimeTable(table=jumps(2)),
        inclination=signals.TimeTable(table=jumps(3)),
        gain=signals.Gain(k=HOLDING * 0.25),
        gain1=signals.Gain(k=2),
        torque=rotational.Torque(),
        torque1=rotational.Torque(),
        coupling=ia.ForceSensor(),
        no_load=ia.ConstantForce(f_constant=0),
        no_drive=rotational.ConstantTorque(tau_constant=0),
        **vehicles,
    )
    net.connect(net.factor.y, net.gain.u).connect(net.gain.y, net.torque.tau, net.gain1.u)
    net.connect(net.gain1.y, net.torque1.tau)
    net.connect(net.inclination.y, *(vehicle.inclination for vehicle in vehicles.values()))
    net.connect(net.torque.flange, net.vehicle.flange_r).connect(net.vehicle.flange_t, net.no_load.flange)
    net.connect(net.torque1.flange, net.vehicle1.flange_r).connect(net.trailer.flange_r, net.no_drive.flange)
    net.connect(net.vehicle1.flange_t, net.coupling.flange_a)
    net.connect(net.coupling.flange_b, net.trailer.flange_t)
    at_rest = {f"{name}.mass.{x}": 0.0 for name in ("vehicle", "vehicle1") for x in "sv"}
    return net.simulate(60.0, step=0.02, start=at_rest, **TIGHT)


def rolled(elapsed: Array, v: float, force: float) -> tuple[Array, Array]:
    """Return distance and speed under m v' = force - c v^2; complex numbers where force brakes."""
    m, c = 100.0, 0.3
    top = np.sqrt(complex(force / c))
    phase = np.arctanh(v / top)
    phases = phase + elapsed * c * top / m
    return (m / c * np.log(np.cosh(phases) / np.cosh(phase))).real, (top * np.tanh(phases)).real


def test_it_drives_climbs_brakes_and_stops() -> None:
    run = journey()
    t, alone = run["time"], {x: run[f"vehicle.mass.{x}"] for x in "sv"}
    s, v = 0.0, 0.0
    for begin, end, drive, slope in LEGS[1:]:
        angle = np.arctan(slope)
        force = drive * HOLDING - 100 * GRAVITY * (np.sin(angle) + 0.01 * np.cos(angle))
        leg = (t > begin) & (t < end)
        far, fast = rolled(t[leg] - begin, v, force)
        on = fast > 0
        assert alone["s"][leg][on] == pytest.approx(s + far[on], rel=2e-8, abs=1e-7)
        assert alone["v"][leg][on] == pytest.approx(fast[on], abs=1e-7)
        onward = rolled(np.array([end - begin]), v, force)
        s, v = s + onward[0].item(), onward[1].item()
    stuck = [event for event in run.events if event.target == "stuck"]
    assert [event.mode for event in stuck] == [
        f"{n}.rolling.mode" for n in ("vehicle", "vehicle1", "trailer")
    ]
    for name in ("vehicle", "vehicle1", "trailer"):
        assert run[f"{name}.mass.s"] == pytest.approx(alone["s"], abs=1e-9)
        resting = (t < 5) | (t > stuck[0].time)
        assert (np.abs(run[f"{name}.mass.v"][resting]) < 1e-12).all()
    assert any("trailer.rolling" in note and "vehicle1.rolling" in note for note in run.notes)
    rolling = (t > 5) & (t < stuck[0].time)
    assert run["coupling.f"][rolling] == pytest.approx(run["torque.tau"][rolling] / 0.25)


def test_it_creeps_as_in_msl() -> None:
    """With MSL's regularised resistance: figures of an integration made apart from this library."""
    run = journey(rolling=lambda: CreepingResistance(f_c=0.01 * GRAVITY * 100))
    figures = {
        10.8: (21.306835, 7.194541),
        20.0: (87.318833, 7.158281),
        25.0: (122.581312, 6.953913),
        50.0: (297.663452, 7.038173),
        55.0: (315.177282, 0.089455),
        60.0: (315.218082, 0.0),
    }
    for t, (s, v) in figures.items():
        assert (run.at("trailer.mass.s", t), run.at("trailer.mass.v", t)) == pytest.approx((s, v), abs=5e-6)
    assert run.notes == []
