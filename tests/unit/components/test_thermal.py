"""Heat as a third domain: conduction, losses that heat, laws that feel it; and domains of one's own."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational, thermal
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


def test_two_bodies_share_their_heat() -> None:
    net = ia.Network(
        "shared",
        hot=thermal.HeatCapacitor(C=10.0, T=400.0),
        cold=thermal.HeatCapacitor(C=30.0, T=280.0),
        bridge=thermal.ThermalConductor(G=2.0),
        meter=thermal.TemperatureSensor(),
    )
    net.connect(net.hot.port, net.bridge.port_a, net.meter.port).connect(net.bridge.port_b, net.cold.port)
    run = net.simulate(20.0, rtol=1e-9)
    rate = 2.0 * (1 / 10.0 + 1 / 30.0)
    assert run["hot.T"] == pytest.approx(310.0 + 90.0 * np.exp(-rate * run.time), abs=1e-5)
    assert run["meter.T"] == pytest.approx(run["hot.T"])
    assert run["bridge.Q_flow"] == pytest.approx(2.0 * 120.0 * np.exp(-rate * run.time), abs=1e-5)
    assert (run.unit("hot.T"), run.unit("hot.port.Q_flow")) == ("K", "W")


def test_a_heat_flow_and_a_fixed_temperature() -> None:
    net = ia.Network(
        "heated",
        heater=thermal.FixedHeatFlow(Q_flow=50.0),
        wall=thermal.ThermalConductor(G=2.0),
        air=thermal.FixedTemperature(T=290.0),
        room=thermal.HeatCapacitor(C=8.0),
    )
    net.connect(net.heater.port, net.room.port, net.wall.port_a).connect(net.wall.port_b, net.air.port)
    run = net.simulate(10.0, rtol=1e-9)
    assert run["room.T"] == pytest.approx(315.0 - 21.85 * np.exp(-run.time / 4), abs=1e-5)


def brake_and_disc(turning: bool) -> ia.Network:
    """An eddy-current brake slows a body and heats its own disc, which the air cools."""
    laws: dict[str, Any] = {"alpha20": 0.00393, "TRef": 320.0, "useHeatPort": True}
    if turning:
        net = ia.Network(
            "stopped", brake=rotational.EddyCurrentBrake(tau_nominal=100.0, w_nominal=10.0, **laws)
        )
        net.add(body=rotational.Inertia(J=2.0, w=-40.0))
    else:
        net = ia.Network("stopped", brake=ia.EddyCurrentBrake(f_nominal=100.0, v_nominal=10.0, **laws))
        net.add(body=ia.Mass(m=2.0, v=-40.0))
    net.add(disc=thermal.HeatCapacitor(C=6.0, T=300.0), cooling=thermal.ThermalConductor(G=1.5))
    net.add(air=thermal.FixedTemperature(T=290.0))
    net.connect(net.brake.flange, net.body.flange)
    net.connect(net.brake.heatPort, net.disc.port, net.cooling.port_a)
    return net.connect(net.cooling.port_b, net.air.port)


@pytest.mark.parametrize("turning", [False, True])
def test_a_brake_heats_its_disc_and_feels_it(turning: bool) -> None:
    run = brake_and_disc(turning).simulate(3.0, rtol=1e-9)
    alpha = 0.00393 / (1 + 0.00393 * (320.0 - 293.15))

    def rates(t: float, y: Array) -> list[float]:
        v, temperature = y
        x = v / 10.0 / (1 + alpha * (temperature - 320.0))
        f = 200.0 * x / (1 + x**2)
        return [-f / 2.0, (f * v - 1.5 * (temperature - 290.0)) / 6.0]

    known = solve_ivp(rates, (0, 3), [-40.0, 300.0], t_eval=run.time, rtol=1e-10, atol=1e-10)
    assert run["body.w" if turning else "body.v"] == pytest.approx(known.y[0], abs=1e-5)
    assert run["disc.T"] == pytest.approx(known.y[1], abs=1e-4)
    assert run.energy().dissipated["brake"][-1] == pytest.approx(1600.0 - known.y[0][-1] ** 2, abs=1e-3)


def test_friction_that_heats_itself_lets_go() -> None:
    net = ia.Network(
        "rubbed",
        belt=ia.ConstantSpeed(v_fixed=2.0),
        rub=ia.TemperatureDependentFriction(f_c=50.0, alpha=-0.004, useHeatPort=True),
        block=ia.Mass(m=4.0),
        hold=ia.SpringDamper(k=900.0, d=60.0),
        wall=ia.Fixed(),
        surface=thermal.HeatCapacitor(C=12.0),
    )
    net.connect(net.belt.flange, net.rub.flange_a).connect(
        net.rub.flange_b, net.block.flange, net.hold.flange_b
    )
    net.connect(net.wall.flange, net.hold.flange_a).connect(net.rub.heatPort, net.surface.port)
    run = net.simulate(6.0, rtol=1e-9, start={"block.v": 0.0, "block.s": 0.0})

    def rates(t: float, y: Array) -> list[float]:
        s, v, temperature = y
        f = 50.0 * (1 - 0.004 * (temperature - 293.15))
        return [v, (f - 900.0 * s - 60.0 * v) / 4.0, f * (2.0 - v) / 12.0]

    known = solve_ivp(rates, (0, 6), [0.0, 0.0, 293.15], t_eval=run.time, rtol=1e-10, atol=1e-12)
    assert run["block.s"] == pytest.approx(known.y[0], abs=1e-6)
    assert run["surface.T"] == pytest.approx(known.y[2], abs=1e-4)


def test_what_sticks_makes_no_heat() -> None:
    net = ia.Network(
        "held",
        rub=rotational.TemperatureDependentFriction(tau_c=5.0, alpha=0.01, useHeatPort=True),
        wall=rotational.Fixed(),
        shaft=rotational.Inertia(J=1.0),
        push=rotational.Torque(tau=lambda t: 4 * np.sin(t)),
        surface=thermal.HeatCapacitor(C=1.0),
    )
    net.connect(net.wall.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.shaft.flange, net.push.flange).connect(
        net.rub.heatPort, net.surface.port
    )
    run = net.simulate(5.0, start={"shaft.w": 0.0})
    assert (run["surface.T"] == 293.15).all()


def test_bad_joints_of_heat_are_told() -> None:
    cold = ia.Network("cold", damper=ia.Damper(d=1.0), air=thermal.FixedTemperature())
    cold.connect(cold.damper.heatPort, cold.air.port)
    with pytest.raises(ia.ModelError, match="heatPort is there with useHeatPort=True only"):
        cold.dae()
    mixed = ia.Network("mixed", mass=ia.Mass(m=1.0), air=thermal.FixedTemperature())
    mixed.connect(mixed.mass.flange, mixed.air.port)
    with pytest.raises(ia.ModelError, match=r"different kinds .*thermal: air\.port"):
        mixed.dae()
    open_port = ia.Network(
        "open", wall=ia.Fixed(), damper=ia.Damper(d=1.0, useHeatPort=True), mass=ia.Mass(m=1.0)
    )
    open_port.connect(open_port.wall.flange, open_port.damper.flange_a)
    open_port.connect(open_port.damper.flange_b, open_port.mass.flange)
    with pytest.raises(ia.ModelError, match="heatPort is not connected"):
        open_port.dae()
    twice = ia.Network("twice", a=thermal.FixedTemperature(), b=thermal.FixedTemperature(T=300.0))
    twice.connect(twice.a.port, twice.b.port)
    with pytest.raises(ia.ModelError, match="ThermalConductor"):
        twice.dae()


class Pin(ia.Port):
    """A pin: potential `v` [V] across, current `i` [A] through."""

    domain = ia.OtherDomain("electrical", across=("v", "V"), through=("i", "A"))


class Ground(ia.Component):
    """v = 0."""

    pin = Pin("what is grounded")

    def equations(self) -> Any:
        yield self.pin.v == 0


class Capacitor(ia.Component):
    """C der(u) = i."""

    p, n = Pin("one pin"), Pin("the other pin")
    C = ia.parameter("F", "capacitance", above=0)
    u = ia.variable("V", "voltage")

    def equations(self) -> Any:
        yield self.u == self.p.v - self.n.v
        yield self.C * ia.der(self.u) == self.p.i
        yield self.p.i == -self.n.i


class Coil(ia.Component):
    """A coil that pushes: f = K i, u = R i + K der(s)."""

    p, n = Pin("one pin"), Pin("the other pin")
    flange = ia.TranslationalFlange("what it pushes")
    R = ia.parameter("V/A", "resistance", above=0)
    K = ia.parameter("N/A", "force over current")
    v = ia.variable("m/s", "speed", state="avoid")

    def equations(self) -> Any:
        yield self.v == ia.der(self.flange.s)
        yield self.p.v - self.n.v == self.R * self.p.i + self.K * self.v
        yield self.p.i == -self.n.i
        yield self.flange.f == -self.K * self.p.i


def test_a_domain_of_ones_own_joins_mechanics() -> None:
    net = ia.Network(
        "shot", store=Capacitor(C=0.01, u=50.0), coil=Coil(R=2.0, K=5.0), earth=Ground(), ram=ia.Mass(m=3.0)
    )
    net.connect(net.store.p, net.coil.p).connect(net.store.n, net.coil.n, net.earth.pin)
    net.connect(net.coil.flange, net.ram.flange)
    run = net.simulate(0.5, rtol=1e-9)

    def rates(t: float, y: Array) -> list[float]:
        u, v = y
        i = (u - 5.0 * v) / 2.0
        return [-i / 0.01, 5.0 * i / 3.0]

    known = solve_ivp(rates, (0, 0.5), [50.0, 0.0], t_eval=run.time, rtol=1e-10, atol=1e-12)
    assert run["store.u"] == pytest.approx(known.y[0], abs=1e-5)
    assert run["ram.v"] == pytest.approx(known.y[1], abs=1e-6)
    assert list(run.energy().undeclared) == ["coil"]
