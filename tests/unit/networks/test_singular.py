"""Networks that cannot be solved: every place is told by component and node, with the remedy."""

from typing import Any

import inertance as ia
import pytest
from inertance import rotational


def problems(net: ia.Network) -> list[str]:
    with pytest.raises(ia.ModelError) as caught:
        net.dae()
    assert str(caught.value).startswith(f"'{net.name}'")
    return caught.value.problems


def hung(*flanged: ia.Component) -> ia.Network:
    """Components that all hold the right end of one spring, whose left end is a mass."""
    net = ia.Network("hung", mass=ia.Mass(m=1.0), spring=ia.Spring(k=1.0))
    net.add(**{f"h{i}": component for i, component in enumerate(flanged)})
    net.connect(net.mass.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, *(component.flange for component in flanged))


def test_two_grounds_at_different_positions() -> None:
    (told,) = problems(hung(ia.Fixed(), ia.Fixed(s0=1.5)))
    assert "Fixed 'h0' (s0 = 0 m), Fixed 'h1' (s0 = 1.5 m)" in told
    assert "spring.flange_b, h0.flange, h1.flange at different positions" in told
    assert "put a Spring between" in told


def test_two_grounds_at_one_position() -> None:
    (told,) = problems(hung(ia.Fixed(s0=1.0), ia.Fixed(s0=1.0)))
    assert "h0.flange, h1.flange twice; remove one" in told


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (ia.Position(s_ref=0.0), ia.Position(s_ref=0.0)),
        (ia.Speed(v_ref=0.0), ia.Speed(v_ref=0.0)),
        (ia.Position(), ia.Accelerate()),
        (ia.Fixed(), ia.Position()),
    ],
)
def test_two_rigid_sources_on_one_node(first: ia.Component, second: ia.Component) -> None:
    (told,) = problems(hung(first.clone(), second.clone()))
    assert f"{type(first).__name__} 'h0'" in told
    assert f"{type(second).__name__} 'h1'" in told
    assert "each prescribe the motion of the node of spring.flange_b, h0.flange, h1.flange" in told
    assert "keep one, or put a Spring between" in told


def test_grounds_joined_by_rods() -> None:
    net = ia.Network("held", a=ia.Fixed(), b=ia.Fixed(s0=1.0), rod=ia.Rod(L=1.0))
    net.connect(net.a.flange, net.rod.flange_a).connect(net.rod.flange_b, net.b.flange)
    (told,) = problems(net)
    assert told.endswith("are joined rigidly by Rod 'rod'; remove one, or put a Spring between")


@pytest.mark.parametrize("massive", [False, True])
def test_a_closed_rigid_loop(massive: bool) -> None:
    net = ia.Network("loop", mass=ia.Mass(m=1.0), a=ia.Rod(L=1.0), b=ia.Rod(L=1.0), other=ia.Rod())
    net.connect(net.mass.flange, net.a.flange_a, net.b.flange_a)
    net.connect(net.a.flange_b, net.b.flange_b, net.other.flange_a).connect(net.other.flange_b)
    if massive:
        net.add(far=ia.Mass(m=1.0)).connect(net.far.flange, net.a.flange_b)
    (told,) = problems(net)
    assert told.startswith("Rod 'a', Rod 'b' close a rigid loop")
    assert "let one yield" in told


def test_no_ground_where_one_is_needed() -> None:
    net = ia.Network("adrift", a=ia.Spring(k=1.0), b=ia.Damper(d=1.0))
    net.connect(net.a.flange_a, net.b.flange_a).connect(net.a.flange_b, net.b.flange_b)
    (told,) = problems(net)
    assert "a.flange_a, b.flange_a and of a.flange_b, b.flange_b" in told
    assert "join a Mass or a Fixed" in told


def test_two_forces_against_each_other_without_a_mass() -> None:
    net = ia.Network("pulled", left=ia.Force(f=1.0), spring=ia.Spring(k=1.0), right=ia.Force(f=1.0))
    net.connect(net.left.flange, net.spring.flange_a).connect(net.spring.flange_b, net.right.flange)
    (told,) = problems(net)
    assert "'left.f'" in told
    assert "'right.f'" in told
    assert "put a Mass between forces" in told


def test_all_places_are_told_at_once() -> None:
    net = hung(ia.Fixed(), ia.Fixed(s0=1.0))
    net.add(p=ia.Position(), q=ia.Position(), x=ia.Spring(k=1.0), y=ia.Spring(k=2.0))
    net.connect(net.mass.flange, net.p.flange, net.q.flange)
    net.connect(net.x.flange_a, net.y.flange_a).connect(net.x.flange_b, net.y.flange_b)
    assert len(problems(net)) == 3


def test_turning_networks_are_told_in_their_own_words() -> None:
    net = ia.Network(
        "shaft", a=rotational.Fixed(), b=rotational.Fixed(phi0=1.0), spring=rotational.Spring(c=1.0)
    )
    net.connect(net.a.flange, net.b.flange, net.spring.flange_a).connect(net.spring.flange_b)
    (told,) = problems(net)
    assert "(phi0 = 1 rad)" in told
    assert "rotational.Spring" in told


class Mute(ia.Compliant):
    """States no law."""


class Wordy(ia.Spring):
    """States two laws."""

    def equations(self) -> Any:
        yield self.f == 2 * self.s_rel


@pytest.mark.parametrize(
    ("element", "told"),
    [
        (Mute(), "states 3 equations for its 4 unknowns"),
        (Wordy(k=1.0), "states 5 equations for its 4 unknowns"),
    ],
)
def test_a_component_with_a_wrong_number_of_equations(element: ia.Component, told: str) -> None:
    net = ia.Network("own", wall=ia.Fixed(), element=element, mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)
    (line,) = problems(net)
    assert line.startswith(f"{type(element).__name__} 'element': {told} (s_rel, f, flange_a.f, flange_b.f)")


def test_friction_that_slides_without_mass_is_told() -> None:
    net = ia.Network(
        "Jenkins",
        drive=ia.Position(s_ref=lambda t: 0.1 * t),
        spring=ia.Spring(k=100.0),
        rub=ia.CoulombFriction(f_c=5.0),
        wall=ia.Fixed(),
    )
    net.connect(net.drive.flange, net.spring.flange_b).connect(net.spring.flange_a, net.rub.flange_b)
    net.connect(net.rub.flange_a, net.wall.flange)
    with pytest.raises(ia.SimulationError, match=r"t = 0\.5.*CoulombFriction 'rub'.*join a Mass") as caught:
        net.simulate(1.0)
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert kept["rub.f"][-1] == pytest.approx(5.0)
