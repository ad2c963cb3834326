"""Bodies with length, bodies that coast, shafts that end free."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertance import rotational


def test_a_mass_that_nothing_holds_coasts() -> None:
    run = ia.Network("coasting", mass=ia.Mass(m=2.0, s=0.3, v=-1.5)).simulate(2.0)
    assert run["mass.s"] == pytest.approx(0.3 - 1.5 * run.time)
    turning = ia.Network("coasting", rotor=rotational.Inertia(J=2.0, phi=0.3, w=-1.5)).simulate(2.0)
    assert turning["rotor.phi"] == pytest.approx(0.3 - 1.5 * turning.time)
    lone = ia.Network("coasting", car=ia.MassWithLength(m=2.0, L=0.4, s=0.3, v=-1.5)).simulate(2.0)
    assert lone["car.flange_b.s"] == pytest.approx(0.5 - 1.5 * lone.time)


@settings(max_examples=10, deadline=None)
@given(L=st.floats(0.0, 3.0), m=st.floats(0.1, 9.0), s=st.floats(-2.0, 2.0), pull=st.floats(-20.0, 20.0))
def test_both_ends_act_on_one_mass(L: float, m: float, s: float, pull: float) -> None:
    """A spring at one end, a force at the other, the axis not at rest and the run not from 0 s."""
    net: Any = ia.Network(
        "sled",
        wall=ia.Fixed(s0=0.4),
        spring=ia.Spring(k=30.0, s_rel0=0.1),
        sled=ia.MassWithLength(m=m, L=L, s=s, v=0.7),
        pull=ia.Force(f=pull),
    )
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.sled.flange_a)
    net.connect(net.sled.flange_b, net.pull.flange)
    run = net.simulate(1.5, begin=0.5, rtol=1e-10, atol=1e-12)
    w, rest = np.sqrt(30.0 / m), 0.4 + 0.1 + L / 2 + pull / 30.0
    t = run.time - 0.5
    exact = rest + (s - rest) * np.cos(w * t) + 0.7 / w * np.sin(w * t)
    assert run["sled.s"] == pytest.approx(exact, abs=1e-7)
    assert run["sled.flange_b.s"] - run["sled.flange_a.s"] == pytest.approx(L, abs=1e-12)
    acting = run["sled.flange_a.f"] + run["sled.flange_b.f"]
    assert acting == pytest.approx(m * run["sled.a"], abs=1e-8 * (1 + abs(acting).max()))
    kinetic, elastic = m * run["sled.v"] ** 2 / 2, 15.0 * (run["spring.s_rel"] - 0.1) ** 2
    given_by_pull = pull * (run["sled.s"] - s)
    energy = kinetic + elastic - given_by_pull
    assert energy == pytest.approx(energy[0], abs=1e-7 * (1 + (kinetic + elastic).max()))


def test_a_train_of_cars_with_lengths() -> None:
    """Three cars, end to end in a row by rods between them, are one body that is as long as all."""
    cars = {f"car{n}": ia.MassWithLength(m=float(n), L=0.5 * n) for n in (1, 2, 3)}
    net: Any = ia.Network("train", **cars, gap=ia.Rod(L=0.1), push=ia.Force(f=12.0))
    net.connect(net.push.flange, net.car1.flange_a).connect(net.car1.flange_b, net.gap.flange_a)
    net.connect(net.gap.flange_b, net.car2.flange_a).connect(net.car2.flange_b, net.car3.flange_a)
    run = net.simulate(1.0, start={"car1.s": 0.25})
    assert run["car3.flange_b.s"] == pytest.approx(0.5 + 0.1 + 1.0 + 1.5 + run.time**2)


def test_a_length_must_not_be_negative() -> None:
    with pytest.raises(ia.ModelError, match="L must be at least 0 m, got -1"):
        ia.Network("bad", car=ia.MassWithLength(m=1.0, L=-1.0)).dae()


def test_a_shaft_may_end_free() -> None:
    """Free-free torsion of two rotors, and a shaft without anything at its end, which carries nothing."""
    net: Any = ia.Network(
        "shaft",
        left=rotational.Inertia(J=0.2, w=3.0),
        shaft=rotational.SpringDamper(c=40.0, d=0.0),
        right=rotational.Inertia(J=0.3),
        stub=rotational.Spring(c=7.0),
    )
    net.connect(net.left.flange, net.shaft.flange_a).connect(
        net.shaft.flange_b, net.right.flange, net.stub.flange_a
    )
    net.connect(net.stub.flange_b)
    run = net.simulate(1.0, rtol=1e-10, atol=1e-12)
    w = np.sqrt(40.0 * (1 / 0.2 + 1 / 0.3))
    exact = 3.0 * (0.2 + 0.3 * np.cos(w * run.time)) / 0.5
    assert run["left.w"] == pytest.approx(exact, abs=1e-7)
    assert run["stub.tau"] == pytest.approx(0.0, abs=1e-12)
