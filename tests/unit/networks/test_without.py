"""Components taken out of a network, and exchanged at any depth."""

import inertance as ia
import numpy as np
import pytest


def rig() -> ia.Network:
    strut = ia.Network("strut", spring=ia.Spring(k=90.0), damper=ia.Damper(d=1.5))
    strut.connect(strut.spring.flange_a, strut.damper.flange_a)
    net = ia.Network("rig", wall=ia.Fixed(), mass=ia.Mass(m=2.0), strut=strut)
    net.connect(net.wall.flange, net.strut.spring.flange_a)
    net.connect(net.strut.damper.flange_b, net.mass.flange)
    return net.connect(net.strut.spring.flange_b, net.strut.damper.flange_b)


def motion(net: ia.Network) -> np.ndarray:
    return np.asarray(net.simulate(2.0, start={"mass.s": 0.1}, step=0.1, rtol=1e-10, atol=1e-12)["mass.s"])


def expected(k: float, d: float) -> np.ndarray:
    """Return the free motion from 0.1 m by its closed form."""
    decay = d / 4.0
    t, omega = np.linspace(0.0, 2.0, 21), np.sqrt(k / 2.0 - decay**2)
    return np.asarray(0.1 * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t)))


def test_what_was_joined_by_way_of_a_removed_component_stays_joined() -> None:
    net = rig()
    # The spring reaches the mass only over ports of the damper, and the wall over ports of its own network.
    assert motion(net.without("strut.damper")) == pytest.approx(expected(90.0, 0.0), abs=1e-6)
    assert motion(net) == pytest.approx(expected(90.0, 1.5), abs=1e-6)


def test_a_network_inside_is_removed_whole() -> None:
    net = rig().add(extra=ia.Spring(k=50.0))
    net.connect(net.wall.flange, net.extra.flange_a).connect(net.extra.flange_b, net.mass.flange)
    assert motion(net.without("strut")) == pytest.approx(expected(50.0, 0.0), abs=1e-6)


def test_components_at_any_depth_are_exchanged() -> None:
    changed = rig().with_values(**{"strut.spring": ia.Spring(k=200.0)})
    assert motion(changed) == pytest.approx(expected(200.0, 1.5), abs=1e-6)


def test_an_inserted_element_that_is_removed_joins_what_it_stood_between() -> None:
    net = rig()
    net.insert(net.strut.spring.flange_b, play=ia.Backlash(k=1e5, d=10.0, eps=2e-2))
    assert "play" not in repr(net.without("play"))
    assert motion(net.without("play")) == pytest.approx(expected(90.0, 1.5), abs=1e-6)
    with pytest.raises(
        ia.ModelError, match=r"'play' is inserted at 'strut\.spring', at its flange_b; remove"
    ):
        net.without("strut.spring")
    with pytest.raises(ia.ModelError, match=r"no component 'dampr' in 'strut'; did you mean 'damper'"):
        net.without("strut.dampr")


def test_parts_of_composites_stay_and_exchanged_ones_must_fit() -> None:
    net = ia.Network("rig", wall=ia.Fixed(), strut=ia.SpringDamper(k=1.0, d=1.0), spring=ia.Spring(k=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    with pytest.raises(ia.ModelError, match="Mass has no flange_a, at which 'spring' is joined"):
        net.with_values(spring=ia.Mass(m=1.0))
