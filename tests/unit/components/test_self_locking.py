"""Worms and screws that lock themselves: held from rest whatever the load's inertia, told where they jam."""

from math import pi
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational

LEAD = 0.08


def hoist(
    mu: float, tau: float, drum: float, w: float = 0.0, ratio: float = 30.0, **shaft: Any
) -> ia.Network:
    net = ia.Network("hoist", rotor=rotational.Inertia(J=1e-4, w=w), drum=rotational.Inertia(J=drum))
    net.add(worm=rotational.WormGear(ratio=ratio, lead_angle=LEAD, mu=mu))
    net.add(weight=rotational.ConstantTorque(tau_constant=tau))
    net.connect(net.rotor.flange, net.worm.flange_a)
    net.connect(net.drum.flange, net.weight.flange)
    if not shaft:
        return net.connect(net.worm.flange_b, net.drum.flange)
    net.add(shaft=rotational.SpringDamper(**shaft))
    net.connect(net.worm.flange_b, net.shaft.flange_a)
    return net.connect(net.shaft.flange_b, net.drum.flange)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("ratio", [30.0, -30.0])
@pytest.mark.parametrize("tau", [40.0, -40.0])
@pytest.mark.parametrize("drum", [1e-3, 5.0, 500.0])
def test_a_load_at_rest_is_held_however_heavy(solver: Any, tau: float, drum: float, ratio: float) -> None:
    run = hoist(0.12, tau, drum, ratio=ratio).simulate(0.2, solver=solver)
    assert np.ptp(run["worm.phi"]) == 0.0
    assert run.at("worm.tau_loss", 0.2) == pytest.approx(tau / ratio)  # all of the load's torque


@pytest.mark.parametrize("load", [200.0, -200.0])
def test_a_screw_holds_a_heavy_load(load: float) -> None:
    net = ia.Network("jack", screw=ia.LeadScrew(lead=0.004, d_m=0.018, mu=0.12), load=ia.Mass(m=5e4))
    net.add(hand=rotational.Inertia(J=1e-5), weight=ia.ConstantForce(f_constant=load))
    net.connect(net.hand.flange, net.screw.flange_r)
    net.connect(net.screw.flange_t, net.load.flange, net.weight.flange)
    run = net.simulate(0.2)
    assert np.ptp(run["load.s"]) == 0.0
    assert run.at("screw.tau_loss", 0.2) == pytest.approx(load * 0.004 / (2 * pi))


@pytest.mark.parametrize("tau", [40.0, -40.0])
def test_one_that_does_not_lock_runs_away_as_its_efficiency_says(tau: float) -> None:
    run = hoist(0.05, tau, 5.0).simulate(0.2)
    back = np.tan(LEAD - np.arctan(0.05)) / np.tan(LEAD)  # wheel driving
    wheel = back * tau / (30.0**2 * 1e-4 + back * 5.0)
    assert run["drum.a"][-1] == pytest.approx(wheel, rel=1e-6)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_a_jam_in_motion_is_told_with_what_helps(solver: Any) -> None:
    with pytest.raises(ia.SimulationError, match=r"WormGear 'worm'; 'worm': its flanks lock .* SpringDamper"):
        hoist(0.12, 40.0, 5.0, w=5.0).simulate(0.5, solver=solver)
    net = hoist(0.12, 40.0, 5.0, w=5.0, c=2e4, d=5.0)
    run = net.simulate(0.5, solver=solver, start={"drum.w": 5.0 / 30.0})
    assert abs(run["worm.w"][-1]) < 1e-9
    assert run.energy().closes < 1e-4
