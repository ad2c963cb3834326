"""Elements put between a port and all it is connected to."""

import inertance as ia
import numpy as np
import pytest
from inertance.machines import Sinusoid, ge_wang


def oscillator() -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


def test_two_springs_in_series_are_half_as_stiff() -> None:
    net = oscillator()
    net.insert(net.spring.flange_b, more=ia.Spring(k=100.0))
    run = net.simulate(1.0, start={"mass.s": 0.1}, rtol=1e-9, atol=1e-12)
    assert run["mass.s"] == pytest.approx(0.1 * np.cos(np.sqrt(50.0) * run.time), abs=1e-7)
    assert run["more.f"] == pytest.approx(run["spring.f"], abs=1e-9)


def test_what_is_inserted_again_goes_in_series() -> None:
    net = oscillator()
    net.insert(net.spring.flange_b, more=ia.Spring(k=100.0))
    net.insert(net.spring.flange_b, most=ia.Spring(k=50.0))
    run = net.simulate(1.0, start={"mass.s": 0.1}, rtol=1e-9, atol=1e-12)
    assert run["mass.s"] == pytest.approx(0.1 * np.cos(np.sqrt(25.0) * run.time), abs=1e-7)
    assert run["more.flange_b.f"] == pytest.approx(-run["most.flange_a.f"], abs=1e-9)


def test_a_copy_carries_what_was_inserted_and_the_original_does_not_change() -> None:
    net = oscillator()
    changed = net.clone().clone()
    changed.insert(changed.mass.flange, soft=ia.Spring(k=100.0))
    again = changed.clone().with_values(spring=ia.Spring(k=50.0))
    for kind, k in ((net, 100.0), (changed, 50.0), (again, 100 / 3)):
        run = kind.simulate(1.0, start={"mass.s": 0.1}, rtol=1e-9, atol=1e-12)
        assert run["mass.s"][-1] == pytest.approx(0.1 * np.cos(np.sqrt(k)), abs=1e-7)


def test_at_a_port_deep_inside() -> None:
    rig = ia.machines.inerter_rig(ge_wang.disk_inerter(regularised=0.1), Sinusoid(0.01, 3.0))
    loose = rig.clone()
    loose.insert(loose.inerter.screw.flange_t, play=ia.Backlash(k=1e8, d=1e4, eps=1e-4))
    run = loose.simulate(0.5)
    assert np.abs(run["play.s_rel"]).max() == pytest.approx(1e-4, rel=2)
    assert run["inerter.flange_a.f"] == pytest.approx(run["play.flange_b.f"])


def test_what_cannot_be_inserted() -> None:
    net = oscillator()
    with pytest.raises(ia.ModelError, match=r"at a port such as `net.mass.flange`, got Mass"):
        net.insert(net.mass, soft=ia.Spring(k=1.0))
    for wrong in ({}, {"a": ia.Spring(k=1.0), "b": ia.Spring(k=1.0)}, {"a": ia.Mass(m=1.0)}):
        with pytest.raises(ia.ModelError, match="an element with flange_a and flange_b"):
            net.insert(net.mass.flange, **wrong)
