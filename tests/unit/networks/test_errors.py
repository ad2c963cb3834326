"""What is wrong with values, equations and connections: by component path, all at once, with a remedy."""

import re
from collections.abc import Callable
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import rotational


def oscillator(**changed: ia.Component) -> ia.Network:
    parts: dict[str, ia.Component] = {
        "wall": ia.Fixed(),
        "spring": ia.Spring(k=100.0),
        "mass": ia.Mass(m=1.0),
    }
    net = ia.Network("oscillator", **(parts | changed))
    return net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)


def planets(**options: Any) -> ia.PlanetaryFlywheel:
    return ia.PlanetaryFlywheel(R=0.05, r=0.017, J_s=3e-4, J_p=1.7e-5, J_r=1e-4, k_r=1e8, c_r=4e3, **options)


def refused(net: ia.Network, **run: Any) -> list[str]:
    with pytest.raises(ia.ModelError) as caught:
        net.simulate(1.0, **run)
    return caught.value.problems


def test_every_bad_value_is_told_with_its_path_and_unit() -> None:
    told = refused(
        oscillator(
            wall=ia.Fixed(s0=float("nan")),
            spring=ia.Spring(k=-1.0, s_rel0="long"),  # type: ignore[arg-type]
            mass=ia.Mass(m=0.0, s=float("inf"), q=3),  # type: ignore[call-arg]
        )
    )
    assert told == [
        "Fixed 'wall': s0 must be a finite number [m], got nan",
        "Spring 'spring': k must be at least 0 N/m, got -1.0",
        "Spring 'spring': s_rel0 must be a number [m], got 'long'",
        "Mass 'mass': m must be above 0 kg, got 0.0",
        "Mass 'mass': start value of s must be a number, got inf",
        "Mass 'mass': has no parameter 'q'",
    ]


@pytest.mark.parametrize(
    ("component", "told"),
    [
        (ia.Spring(kk=1.0, k=1.0), "Spring 'spring': has no parameter 'kk'; did you mean 'k'?"),  # type: ignore[call-arg]
        (ia.Spring(), "Spring 'spring': k [N/m] (stiffness) must be given"),  # type: ignore[call-arg]
        (ia.Spring(k=None), "Spring 'spring': k must be a number [N/m], got None"),  # type: ignore[arg-type]
        (ia.Spring(k=np.array([1.0, 2.0])), "Spring 'spring': k must be a number [N/m], got array([1., 2.])"),  # type: ignore[arg-type]
        (ia.HardStop(e=1.5), "HardStop 'spring': e must be at most 1, got 1.5"),
        (ia.series(ia.Spring(k=-2.0)), "Spring 'spring.spring': k must be at least 0 N/m, got -2.0"),
    ],
)
def test_a_bad_value(component: ia.Component, told: str) -> None:
    assert refused(oscillator(spring=component)) == [told]


def test_a_bad_signal_is_told_before_the_run() -> None:
    told = refused(oscillator(push=ia.Force(f="sine")))  # type: ignore[arg-type]
    assert told[0].startswith(
        "Force 'push': f takes a number, a function of time or Sampled data, got 'sine'"
    )


def test_unconnected_flanges_are_all_told() -> None:
    told = refused(oscillator(damper=ia.Damper(d=1.0), more=ia.Fixed(), free=ia.Mass(m=1.0)))
    assert told == [
        "Damper 'damper': flange_a is not connected; connect it (to a Fixed if it is held, alone if its end "
        "is free)",
        "Damper 'damper': flange_b is not connected; connect it (to a Fixed if it is held, alone if its end "
        "is free)",
        "Fixed 'more': flange is not connected; connect it, or leave it out",
    ]


def test_a_sliding_flange_on_a_turning_one() -> None:
    net = oscillator(wheel=rotational.Inertia(J=1.0))
    (told,) = refused(net.connect(net.mass.flange, net.wheel.flange))
    assert "translational: spring.flange_b, mass.flange; rotational: wheel.flange" in told
    assert "connect like with like" in told


def law(*equations: Callable[[Any], Any]) -> ia.Component:
    class Odd(ia.Compliant):
        k = ia.parameter("N/m", "stiffness", default=1.0)

        def equations(self) -> Any:
            for equation in equations:
                yield equation(self)

    return Odd()


@pytest.mark.parametrize(
    ("equation", "told"),
    [
        (lambda self: self.f == self.stiffness * self.s_rel, "it declares no 'stiffness'; declare it"),
        (lambda self: self.f == self.s_re, "it declares no 's_re'; did you mean 's_rel'?"),
        (
            lambda self: self.f == self.flange_a.x,
            "TranslationalFlange 'flange_a' has no 'x', only 's' and 'f'",
        ),
        (
            lambda self: self.f == ca.SX.sym("q") * self.s_rel,
            "uses 'q', which the component does not declare",
        ),
        (lambda self: self.f == self.f, "`1` is not an equation; yield `left == right`"),
        (lambda self: True, "`True` is not an equation"),
        (lambda self: self.f - self.k * self.s_rel, "`(f-(k*s_rel))` is not an equation"),
        (lambda self: self.f >= 0, "is not an equation"),
        (lambda self: self.f == ia.der(2 * self.s_rel), "der() takes one variable of the component"),
    ],
)
def test_a_bad_equation(equation: Callable[[Any], Any], told: str) -> None:
    (line,) = refused(oscillator(spring=law(equation)))
    assert line.startswith("Odd 'spring': ")
    assert told in line


class Returned(ia.Compliant):
    """Returns its law instead of yielding it."""

    def equations(self) -> Any:
        return self.f == self.s_rel


class Silent(ia.Compliant):
    """Compares and yields nothing."""

    def equations(self) -> Any:
        _ = self.f == self.s_rel


@pytest.mark.parametrize("kind", [Returned, Silent])
def test_equations_must_yield(kind: type[ia.Component]) -> None:
    (told,) = refused(oscillator(spring=kind()))
    assert told.startswith(f"{kind.__name__} 'spring': equations() of {kind.__name__} must yield")


def test_bad_equations_and_bad_values_are_told_together() -> None:
    told = refused(
        oscillator(spring=law(lambda self: self.f == self.g), mass=ia.Mass(m=-1.0), more=ia.Fixed())
    )
    assert len(told) == 3


def test_inputs_that_are_unknown_missing_or_no_signal() -> None:
    net = oscillator(push=ia.Force())
    net.connect(net.push.flange, net.mass.flange)
    assert refused(net) == [
        "input 'push.f' [N] has no signal; connect it, bind it, or give inputs={'push.f': ...}"
    ]
    assert refused(net, inputs={"push.F": 1.0})[0] == "there is no input 'push.F'; did you mean 'push.f'?"
    signals: list[tuple[Any, str]] = [
        ("sin", "got 'sin'"),
        (float("nan"), "got nan"),
        (lambda t: 1 if t > 0.5 else 0, "truth value"),
        (lambda t: ca.vertcat(t, t), r"must return one number, got \(2, 1\)"),
        (([0, 1, 2, 3], [0, 1, 2]), "4 instants but 3 values"),
    ]
    for signal, told in signals:
        with pytest.raises(ia.ModelError, match=told):
            net.simulate(1.0, inputs={"push.f": signal})


def test_changed_parameters_are_checked_all_at_once() -> None:
    changed = {"spring.kk": 1.0, "spring.k": -3.0, "mass.m": float("nan"), "wall.s0": "left"}
    assert refused(oscillator(), parameters=changed) == [
        "there is no parameter 'spring.kk'; did you mean 'spring.k'?",
        "'spring.k': k must be at least 0 N/m, got -3.0",
        "'mass.m': m must be a finite number [kg], got nan",
        "'wall.s0': s0 must be a number [m], got 'left'",
    ]


@pytest.mark.parametrize(
    ("start", "told"),
    [
        ({"mass.x": 1.0}, "'oscillator' has no variable 'mass.x'; did you mean 'mass.v'?"),
        ({"mass.s": float("nan")}, "start value of 'mass.s' must be a finite number, got nan"),
        ({"mass.s": "left"}, "start value of 'mass.s' must be a finite number, got 'left'"),
    ],
)
def test_bad_start_values(start: dict[str, Any], told: str) -> None:
    both: list[dict[str, Any]] = [{"start": start}, {"guess": start}]
    for given in both:
        with pytest.raises(ia.ModelError) as caught:
            oscillator().simulate(1.0, **given)
        assert told in str(caught.value)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"stop": 0.0}, "stop must be after begin (0 s), got 0 s"),
        ({"stop": float("nan")}, "stop must be a finite number"),
        ({"stop": 1.0, "step": -1.0}, "step must be above 0 s"),
        ({"stop": 1.0, "rtol": 0.0}, "rtol must be from 1e-14 to 0.1, got 0"),
        (
            {"stop": 1.0, "solver": "lsoda"},
            "solver must be one of 'auto', 'cvodes', 'idas', 'rosenbrock', 'compiled', got 'lsoda'",
        ),
    ],
)
def test_bad_settings_of_a_run(options: dict[str, Any], told: str) -> None:
    with pytest.raises(ia.ModelError) as caught:
        oscillator().simulate(**options)
    assert told in str(caught.value)


def test_one_object_in_two_places() -> None:
    spring = ia.Spring(k=1.0)
    (told, *_) = refused(oscillator(spring=spring, other=spring))
    assert told == "Spring 'other' is the same object as 'spring'; give each place its own (`.clone()`)"


def test_a_network_within_itself() -> None:
    net = oscillator()
    assert "same object" in refused(net.add(again=net))[0]


def test_an_empty_network() -> None:
    assert refused(ia.Network("void")) == ["it has no components; give some to Network(...) or add()"]


def test_a_port_of_another_network() -> None:
    net, other = oscillator(), oscillator()
    told = refused(net.connect(net.mass.flange, other.mass.flange))
    assert told[0].startswith(
        "<flange of Mass> is connected in the network but belongs to no component of it"
    )


def test_what_is_refused_on_the_spot() -> None:
    net = oscillator()
    for thing in (net.mass, net.mass.m, net.mass.s, "mass.flange"):
        with pytest.raises(ia.ModelError, match=r"connect\(\) joins ports such as `net.mass.flange`"):
            net.connect(thing)  # type: ignore[arg-type]
    with pytest.raises(ia.ModelError, match="already has a component 'mass'"):
        net.add(mass=ia.Mass(m=1.0))
    for name in ("a.b", "simulate", "_hidden", "name", "", "der(x)"):
        with pytest.raises(ia.ModelError, match="cannot name a component"):
            net.add(**{name: ia.Mass(m=1.0)})
    with pytest.raises(ia.ModelError, match="'mass' is not a component"):
        ia.Network("classes", mass=ia.Mass)  # type: ignore[arg-type]
    with pytest.raises(AttributeError, match=r"no 'mas'; did you mean 'mass'\?"):
        _ = net.mas
    with pytest.raises(AttributeError, match=r"Mass has no 'flang'; did you mean 'flange'\?"):
        _ = net.mass.flang


@pytest.mark.parametrize(
    "table",
    [
        (),
        ((0.0,),),
        ((0.0, 1.0), (0.0, 2.0)),
        ((1.0, 1.0),),
        ((0.0, np.nan),),
        ((0.0, -1.0),),
        "abc",
        3.0,
        None,
    ],
)
def test_bad_tables_are_told_by_path_with_all_other_problems(table: Any) -> None:
    told = refused(
        oscillator(
            spring=ia.TabulatedFriction(table=table, peak=0.5),
            wall=ia.Fixed(s0="here"),  # type: ignore[arg-type]
        )
    )
    assert told[1].startswith("TabulatedFriction 'spring': table takes rows (speed, force) of finite numbers")
    assert len(told) == 3


@pytest.mark.parametrize(
    ("component", "message"),
    [
        (
            ia.CoulombFriction(f_c=1.0, regularised=0.0),
            "regularised must be None or a number above 0, got 0.0",
        ),
        (
            ia.CoulombFriction(f_c=1.0, regularised="on"),
            "regularised must be None or a number above 0, got 'on'",
        ),
        (planets(N=0), "N must be a whole number, at least 1, got 0"),
        (planets(N=2.5, lumped=False), "N must be a whole number, at least 1, got 2.5"),
        (ia.signals.Delay(T=1.0, n="5"), "n must be a whole number, at least 1, got '5'"),  # type: ignore[arg-type]
        (ia.signals.Sine(f=1.0, start_time=np.inf), "start_time must be None or a finite number, got inf"),
        (
            ia.signals.TimeTable(table=((1.0, 0.0), (0.0, 1.0))),
            "table takes rows (time, value) of finite numbers",
        ),
        (ia.signals.TimeTable(table=3), "table takes rows (time, value) of finite numbers"),
        (
            rotational.LossyGear(ratio=1.0, lossTable=((0, 1.1, 1, 0, 0),)),
            "lossTable takes rows (speed, eta1, eta2",
        ),
        (rotational.Clutch(fn_max=1.0, mu_pos=((0.0, -1.0),)), "mu_pos takes rows (speed, coefficient)"),
    ],
)
def test_a_bad_option(component: ia.Component, message: str) -> None:
    assert any(message in told for told in refused(oscillator(more=component)))


def test_an_equation_that_raises_is_told_by_path_and_line() -> None:
    told = refused(oscillator(spring=law(lambda self: self.f == [self.k][1]), mass=ia.Mass(m=-1.0)))
    assert told[0].startswith("Odd 'spring': its equations cannot be read: ")
    assert "line " in told[0]
    assert "test_errors.py" in told[0]
    assert len(told) == 2


def test_an_equation_that_decides_by_a_symbol_is_told_what_to_write() -> None:
    (told,) = refused(oscillator(spring=law(lambda self: self.f == max(self.k, self.s_rel))))
    assert "write ca.if_else" in told
    assert told.endswith("of test_errors.py)")


def test_bad_values_loose_flanges_and_bad_structure_are_told_together() -> None:
    net = oscillator(mass=ia.Mass(m=-1.0))
    net.add(
        other=ia.Fixed(s0=1.0), push=ia.Force(), drive=ia.Position(), turn=ia.Speed(), lump=ia.Mass(m=1.0)
    )
    net.connect(net.wall.flange, net.other.flange)
    net.connect(net.drive.flange, net.turn.flange, net.lump.flange)
    net.add(idle=ia.Spring(k=1.0), lazy=ia.Damper(d=1.0)).connect(net.idle.flange_a, net.lazy.flange_a)
    told = refused(net.connect(net.idle.flange_b, net.lazy.flange_b))
    expected = (
        r"Mass 'mass': m must be above 0 kg",
        r"Force 'push': flange is not connected",
        r"Fixed 'other' .*, Fixed 'wall' .* at different positions",
        r"Position 'drive', Speed 'turn' each prescribe the motion",
        r"nothing determines where the node of idle.flange_a",
    )
    assert len(told) == len(expected)
    for pattern, problem in zip(expected, told, strict=True):
        assert re.search(pattern, problem), problem


def test_bad_start_values_are_told_all_at_once() -> None:
    told = refused(oscillator(), start={"mass.x": 1.0, "mass.s": np.inf}, guess={"wal.s": 0.0})
    assert told == [
        "'oscillator' has no variable 'mass.x'; did you mean 'mass.v'?",
        "start value of 'mass.s' must be a finite number, got inf",
        "'oscillator' has no variable 'wal.s'; did you mean 'wall.s0'?",
    ]


def test_bad_inputs_are_told_by_their_names() -> None:
    net = oscillator(push=ia.Force())
    net.connect(net.push.flange, net.mass.flange)
    t = np.linspace(0, 1, 5)
    for signal, message in [
        ((t,), "input 'push.f': a sampled signal is a pair (time, values), got 1 items"),
        ((t, t[:3]), "input 'push.f': Sampled signal: 5 instants but 3 values"),
        ((t, np.r_[t[:4], np.nan]), "input 'push.f': Sampled signal: value nan at sample 4"),
        ((t, ["x"] * 5), "input 'push.f': Sampled signal: time and values must be numbers"),
    ]:
        assert refused(net, inputs={"push.f": signal})[0].startswith(message)
    assert refused(net, inputs={"wind": 1.0})[0] == "there is no input 'wind'; the inputs are push.f"
    net.add(source=ia.signals.Constant(k=2.0)).connect(net.source.y, net.push.f)
    told = refused(net, inputs={"push.f": 1.0})
    assert told == ["there is no input 'push.f'; it is connected to a signal of the network"]


def test_a_signal_of_its_own_and_a_connection_are_one_too_many() -> None:
    net = oscillator(push=ia.Force(f=3.0), source=ia.signals.Constant(k=2.0))
    net.connect(net.push.flange, net.mass.flange).connect(net.source.y, net.push.f)
    assert refused(net) == ["Force 'push': f has a signal of its own and that of source.y; keep one"]


def test_a_signal_that_is_no_number_is_told_as_such() -> None:
    net = oscillator(push=ia.Force(f=lambda t: np.sqrt(0.5 - t)))
    net.connect(net.push.flange, net.mass.flange)
    with pytest.raises(ia.SimulationError, match=r"the rate of mass\.v is not a finite number") as caught:
        net.simulate(1.0, inputs={"push.f": lambda t: ca.sqrt(-1 - t)})
    assert isinstance(caught.value.result, ia.Result)
    with pytest.raises(ia.SimulationError, match=r"'oscillator': .* t = 0\.[45]\d*"):
        net.simulate(1.0)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (
            {"rtol": "tight", "step": "fine"},
            ["step must be a number [s], got 'fine'", "rtol must be a number, got 'tight'"],
        ),
        ({"start": [0.1]}, ["start maps names to values, such as start={'mass.s': 0.1}; got [0.1]"]),
        ({"inputs": ["push"]}, ["inputs maps names to values, such as inputs={'mass.s': 0.1}; got ['push']"]),
    ],
)
def test_settings_of_another_kind(wrong: Any, told: list[str]) -> None:
    assert refused(oscillator(), **wrong) == told


def test_a_stop_that_is_no_number() -> None:
    stop: Any = "3 s"
    with pytest.raises(ia.ModelError, match=r"stop must be a number \[s\], got '3 s'"):
        oscillator().simulate(stop)


@pytest.mark.parametrize("gear", [rotational.IdealGear(ratio=0.0), rotational.LossyGear(ratio=0.0)])
def test_a_ratio_of_zero(gear: Any) -> None:
    net = ia.Network("train", a=rotational.Inertia(J=1.0), gear=gear, b=rotational.Inertia(J=1.0))
    net.connect(net.a.flange, net.gear.flange_a).connect(net.gear.flange_b, net.b.flange)
    assert refused(net) == [f"{type(gear).__name__} 'gear': ratio must not be 0"]
