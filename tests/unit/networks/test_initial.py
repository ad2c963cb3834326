"""Start values: what was fixed holds, what was not gives way, and every decision can be read."""

import inertance as ia
import numpy as np
import pytest


def oscillator(**start: float) -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=2.0, **start))
    return net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)


def joined() -> ia.Network:
    """Two masses on a rod, held by a spring."""
    net = ia.Network(
        "joined",
        wall=ia.Fixed(),
        spring=ia.Spring(k=100.0),
        near=ia.Mass(m=1.0),
        rod=ia.Rod(L=0.4),
        far=ia.Mass(m=1.0),
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.near.flange, net.rod.flange_a)
    return net.connect(net.rod.flange_b, net.far.flange)


def told(run: ia.Result) -> list[str]:
    return [str(decision) for decision in run.initial]


def test_fixed_values_of_states() -> None:
    run = oscillator(s=0.1).simulate(0.1, start={"mass.v": -1.0})
    assert told(run) == ["mass.s = 0.1 m: fixed", "mass.v = -1 m/s: fixed"]


def test_the_run_goes_before_the_component() -> None:
    assert oscillator(s=0.1).simulate(0.1, start={"mass.s": 0.2})["mass.s"][0] == 0.2


def test_a_run_that_fixes_every_state_leaves_components_nothing_to_fix() -> None:
    run = oscillator(a=3.0, s=0.1).simulate(0.1, start={"mass.s": 0.2, "mass.v": 0.5})
    assert run["mass.s"][0] == 0.2
    assert run["mass.a"][0] == pytest.approx(-10.0)
    assert told(run) == ["mass.s = 0.2 m: fixed", "mass.v = 0.5 m/s: fixed"]


def test_where_there_is_no_state_what_a_component_fixes_still_has_to_hold() -> None:
    net = ia.Network("pushed", table=ia.Position(), mass=ia.Mass(m=2.0, s=0.05))
    net.connect(net.table.flange, net.mass.flange)
    with pytest.raises(ia.InitialConditionError, match=r"'mass.s' = 0.05 m cannot be reached"):
        net.simulate(0.1, inputs={"table.s_ref": lambda t: 0.01 * t})


def test_an_alias_fixes_the_state_behind_it() -> None:
    run = oscillator().simulate(0.1, start={"spring.flange_b.s": 0.3})
    assert told(run)[0] == "mass.s = 0.3 m: fixed through spring.flange_b.s"


@pytest.mark.parametrize(
    ("name", "value", "s"),
    [
        ("mass.a", 3.0, -0.06),
        ("spring.f", 5.0, 0.05),
        ("spring.s_rel", 0.7, 0.7),
        ("wall.flange.f", -4.0, -0.04),
    ],
)
def test_fixing_what_is_no_state_solves_for_the_state(name: str, value: float, s: float) -> None:
    run = oscillator().simulate(0.1, start={name: value})
    assert run[name][0] == pytest.approx(value)
    assert run["mass.s"][0] == pytest.approx(s)
    assert told(run)[0].endswith("solved from fixed values of other variables")
    assert told(run)[1].endswith("guess kept")


def test_guesses_give_way_to_fixed_values_and_lead_otherwise() -> None:
    run = oscillator().simulate(0.1, start={"mass.a": 3.0}, guess={"mass.s": 1.0, "mass.v": 2.0})
    assert run["mass.s"][0] == pytest.approx(-0.06)
    assert run["mass.v"][0] == 2.0
    for name in ("near.s", "far.s"):
        assert joined().simulate(0.1, guess={name: 0.7})[name][0] == pytest.approx(0.7)


def test_a_default_start_never_becomes_a_condition() -> None:
    """Both masses guess 0; the rod makes that impossible, and only the state's guess is kept."""
    run = joined().simulate(0.1)
    assert run["far.s"][0] - run["near.s"][0] == pytest.approx(0.4)
    assert 0.0 in (run["far.s"][0], run["near.s"][0])
    fixed = joined().simulate(0.1, start={"far.s": 1.0})
    assert fixed["near.s"][0] == pytest.approx(0.6)


def test_friction_between_masses_does_not_move_them_at_the_start() -> None:
    """With or without an element that prefers relative states, motions start where they are declared."""
    for element in (ia.Spring(k=1.0), ia.CoulombFriction(f_c=1.0), ia.HardStop()):
        net = ia.Network("pair", a=ia.Mass(m=1.0, v=2.0), b=ia.Mass(m=3.0, s=1.0), between=element)
        net.connect(net.a.flange, net.between.flange_a).connect(net.between.flange_b, net.b.flange)
        run = net.simulate(0.01)
        start = [run[name][0] for name in ("a.s", "a.v", "b.s", "b.v")]
        assert start == pytest.approx([0.0, 2.0, 1.0, 0.0], abs=1e-12)
    assert any("from the start values of the motions it relates" in line for line in told(run))


def test_a_fixed_relative_state_moves_the_mass_nobody_fixed() -> None:
    net = ia.Network("pair", a=ia.Mass(m=1.0), b=ia.Mass(m=3.0, s=1.0), rub=ia.CoulombFriction(f_c=1.0))
    net.connect(net.a.flange, net.rub.flange_a).connect(net.rub.flange_b, net.b.flange)
    run = net.simulate(0.01, start={"rub.s_rel": 0.25})
    assert (run["a.s"][0], run["b.s"][0]) == pytest.approx((0.75, 1.0))


def test_a_prescribed_motion_against_a_free_one() -> None:
    net = ia.Network(
        "pair", drive=ia.Position(s_ref=lambda t: 2.0 + np.sin(t)), b=ia.Mass(m=3.0), stop=ia.HardStop()
    )
    net.connect(net.b.flange, net.stop.flange_a).connect(net.stop.flange_b, net.drive.flange)
    run = net.simulate(0.1)
    assert (run["b.s"][0], run["b.v"][0]) == pytest.approx((0.0, 0.0))
    assert run["stop.v_rel"][0] == pytest.approx(1.0)


def test_fixed_values_that_contradict_each_other_are_told_with_their_values() -> None:
    cases = [
        (
            oscillator(),
            {"mass.s": 1.0, "spring.f": 2.0},
            r"'spring.f' = 2 N cannot be reached with 'mass.s' = 1 m",
        ),
        (oscillator(), {"mass.s": 0.1, "mass.a": 7.0}, r"'mass.a' = 7 m/s2 cannot be reached"),
        (oscillator(), {"wall.flange.s": 1.0}, r"'wall.flange.s' = 1 m cannot be reached by any choice"),
        (joined(), {"near.s": 0.0, "far.s": 0.0}, r"cannot be reached with '(near|far).s' = 0 m"),
        (
            oscillator(),
            {"mass.s": 1.0, "spring.flange_b.s": 2.0},
            "'mass.s' and 'spring.flange_b.s' are one variable, fixed at two values, 1 and 2 m",
        ),
    ]
    for net, start, message in cases:
        with pytest.raises(ia.InitialConditionError, match=message):
            net.simulate(0.1, start=start)


def test_fixed_values_under_friction_meet_the_modes_they_imply() -> None:
    """Stuck, no acceleration but zero could be reached; at this speed friction slides."""
    net = ia.Network(
        "sled",
        wall=ia.Fixed(),
        mass=ia.Mass(m=2.0),
        rub=ia.CoulombFriction(f_c=3.0),
        spring=ia.Spring(k=100.0),
    )
    net.connect(net.wall.flange, net.rub.flange_a, net.spring.flange_a)
    net.connect(net.mass.flange, net.rub.flange_b, net.spring.flange_b)
    run = net.simulate(0.1, start={"mass.a": 4.0, "mass.v": 0.5})
    assert run.at("mass.a", 0.0) == pytest.approx(4.0)
    assert run["mass.s"][0] == pytest.approx(-(2.0 * 4.0 + 3.0) / 100.0)


@pytest.mark.parametrize(("a", "mode"), [(1.0, 1), (-3.0, 2)])
def test_a_fixed_acceleration_of_what_sticks_at_rest_breaks_it_away(a: float, mode: int) -> None:
    """k s = -(m a + f_c sgn a): the spring is as taut as it takes to slide with this acceleration."""
    net = ia.Network(
        "block",
        wall=ia.Fixed(),
        spring=ia.Spring(k=100.0),
        mass=ia.Mass(m=2.0),
        rub=ia.SupportFriction(friction=ia.CoulombFriction(f_c=5.0)),
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    run = net.connect(net.spring.flange_b, net.mass.flange, net.rub.flange).simulate(0.1, start={"mass.a": a})
    assert run["mass.a"][0] == pytest.approx(a, abs=1e-12)
    assert run["mass.s"][0] == pytest.approx(-(2 * a + np.copysign(5.0, a)) / 100, abs=1e-12)
    assert run["rub.friction.mode"][0] == mode
    assert run["mass.v"][0] == 0.0


def test_algebraic_unknowns_are_solved_for_at_the_start() -> None:
    strut = ia.series(ia.CubicSpring(k=10.0, k3=5.0), ia.CubicSpring(k=3.0, k3=50.0))
    net = ia.Network("implicit", wall=ia.Fixed(), strut=strut, mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.strut.flange_a).connect(net.strut.flange_b, net.mass.flange)
    run = net.simulate(0.1, start={"strut.f": 4.0})
    first, second = (run[f"strut.{name}.f"][0] for name in ("cubicspring", "cubicspring_2"))
    assert first == pytest.approx(4.0)
    assert second == pytest.approx(4.0)


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"mass.s": 0.1, "spring.flange_a.f": 5.0}, "'spring.flange_a.f' = 5 N cannot be reached"),
        (
            {"wall.flange.f": 3.0, "spring.flange_a.f": 3.0},
            "'wall.flange.f' and 'spring.flange_a.f' are opposite, fixed at two values, 3 and 3 N",
        ),
    ],
)
def test_a_force_is_told_with_the_sign_it_was_given(start: dict[str, float], message: str) -> None:
    with pytest.raises(ia.InitialConditionError, match=message):
        oscillator().simulate(0.1, start=start)
    assert (
        oscillator().simulate(0.1, start={"wall.flange.f": 3.0, "spring.flange_a.f": -3.0})["mass.s"][0] > 0
    )


def test_a_default_start_does_not_give_way_to_an_algebraic_loop() -> None:
    """The mass moved by 6 mm, as if something were fixed, so that the loop of the two springs closed."""
    net = ia.Network(
        "loop",
        wall=ia.Fixed(),
        inner=ia.CubicSpring(k=100.0, k3=1e4, s_rel0=0.1),
        outer=ia.CubicSpring(k=50.0, k3=3e4),
        mass=ia.Mass(m=1.0),
    )
    net.connect(net.wall.flange, net.inner.flange_a)
    net.connect(net.inner.flange_b, net.outer.flange_a)
    run = net.connect(net.outer.flange_b, net.mass.flange).simulate(0.01)
    assert run["mass.s"][0] == 0.0
    assert [decision.reason for decision in run.initial] == ["guess kept"] * 2
    assert run["inner.f"][0] == pytest.approx(run["outer.f"][0])
    held = net.simulate(0.01, start={"mass.a": 1.0})
    assert held["mass.a"][0] == pytest.approx(1.0)
