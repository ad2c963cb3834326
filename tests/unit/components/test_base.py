"""Declarations: what a component class says, and how its equations are read."""

import gc
import weakref
from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest


def hung(element: ia.Component, **start: float) -> ia.Network:
    net = ia.Network("hung", wall=ia.Fixed(), element=element, mass=ia.Mass(m=1.0, **start))
    return net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)


def told(element: ia.Component) -> list[str]:
    with pytest.raises(ia.ModelError) as caught:
        hung(element).dae()
    return caught.value.problems


class Stiffening(ia.Compliant):
    """An element outside the package: f = k s_rel (1 + (s_rel / s_0)^2)."""

    k = ia.parameter("N/m", "stiffness at rest", min=0)
    s_0 = ia.parameter("m", "distance at which stiffness doubles", above=0)

    def equations(self) -> Any:
        yield self.f == self.k * self.s_rel * (1 + (self.s_rel / self.s_0) ** 2)


def test_an_element_of_ones_own() -> None:
    run = hung(Stiffening(k=10.0, s_0=0.5), s=0.2).simulate(2.0, rtol=1e-9, atol=1e-11)
    s = run["mass.s"]
    energy = run["mass.v"] ** 2 / 2 + 10 * (s**2 / 2 + s**4 / (4 * 0.25))
    assert energy == pytest.approx(energy[0], rel=1e-7)


def test_a_subclass_adds_equations_and_overrides_what_they_use() -> None:
    class Law(ia.Compliant):
        @property
        def stretch(self) -> Any:
            return self.s_rel

        def force(self, stretch: Any) -> Any:
            return 2 * stretch

        def equations(self) -> Any:
            yield self.f == self.force(self.stretch)

    class Stronger(Law):
        power = ia.variable("W", "power")

        def force(self, stretch: Any) -> Any:
            return 3 * stretch

        def equations(self) -> Any:
            yield self.power == self.f * ia.der(self.s_rel)

    assert hung(Law(), s=1.0).simulate(0.1)["element.f"][0] == pytest.approx(2.0)
    run = hung(Stronger(), s=1.0, v=2.0).simulate(0.1)
    assert run["element.f"][0] == pytest.approx(3.0)
    assert run["element.power"][0] == pytest.approx(6.0)


def test_options_shape_equations_instance_by_instance() -> None:
    class Chosen(ia.Compliant):
        law = ia.option("which law", default="linear", choices=("linear", "cubic"))
        gains = ia.option("any hashable value", default=(1.0, 2.0))

        def equations(self) -> Any:
            stretch = self.s_rel if self.law == "linear" else self.s_rel**3
            yield self.f == sum(self.gains) * stretch

    for law, gains, force in [
        ("linear", (1.0, 2.0), 6.0),
        ("cubic", (1.0, 2.0), 24.0),
        ("cubic", (4.0,), 32.0),
    ]:
        run = hung(Chosen(law=law, gains=gains), s=2.0).simulate(0.01)
        assert run["element.f"][0] == pytest.approx(force)
    assert told(Chosen(law="square")) == [
        "Chosen 'element': law must be one of ('linear', 'cubic'), got 'square'"
    ]


def test_numpy_functions_work_on_symbols_without_warnings() -> None:
    class Sine(ia.Compliant):
        def equations(self) -> Any:
            yield self.f == np.sin(self.s_rel) + np.exp(-self.time) * 0

    assert hung(Sine(), s=1.0).simulate(0.01)["element.f"][0] == pytest.approx(np.sin(1.0))


def test_derivatives_of_variables_ports_and_derivatives() -> None:
    class Jerky(ia.Compliant):
        v = ia.variable("m/s", "speed of the right flange")
        a_rel = ia.variable("m/s2", "relative acceleration")

        def equations(self) -> Any:
            yield self.v == ia.der(self.flange_b.s)
            yield self.a_rel == ia.der(ia.der(self.s_rel))
            yield self.f == 2 * self.s_rel

    run = hung(Jerky(), s=1.0, v=3.0).simulate(1.0)
    assert run["element.v"] == pytest.approx(run["mass.v"])
    assert run["element.a_rel"] == pytest.approx(run["mass.a"])


def test_a_computed_default_and_a_given_value() -> None:
    class Tuned(ia.Compliant):
        m = ia.parameter("kg", "mass", default=2.0)
        w = ia.parameter("rad/s", "frequency", default=3.0)
        k = ia.parameter("N/m", "stiffness", default=lambda self: self.m * self.w**2)

        def equations(self) -> Any:
            yield self.f == self.k * self.s_rel

    assert Tuned().k == 18.0
    assert Tuned(w=1.0).k == 2.0
    assert hung(Tuned(m=1.0), s=1.0).simulate(0.01)["element.f"][0] == pytest.approx(9.0)
    assert hung(Tuned(k=4.0), s=1.0).simulate(0.01)["element.f"][0] == pytest.approx(4.0)


def test_unset_fields_read_as_what_they_declare() -> None:
    spring = ia.Spring(k=3.0)
    assert (spring.k, spring.s_rel0) == (3.0, 0.0)
    assert repr(spring) == "Spring(k=3.0)"
    assert repr(spring.flange_a) == "<flange_a of Spring>"
    assert set(ia.Spring.fields) == {"flange_a", "flange_b", "s_rel", "f", "k", "s_rel0", "potential"}
    with pytest.raises(AttributeError, match=r"Spring has no 'kk'; did you mean 'k'\?"):
        _ = spring.kk


class Three(ia.Compliant):
    """A spring that is stiff outside a middle range and soft in it."""

    mode = ia.mode("low", "middle", "high", doc="range")

    def equations(self) -> Any:
        outside = self.mode.is_("low", "high")
        yield self.f == self.s_rel * (1 + 9 * outside) + 0 * self.mode.is_("low", "middle", "high")

    def transitions(self) -> Any:
        yield self.mode.goes("low", "middle", when=self.s_rel > -1)
        yield self.mode.goes("middle", "low", when=self.s_rel < -1)
        yield self.mode.goes("middle", "high", when=self.s_rel > 1)
        yield self.mode.goes("high", "middle", when=self.s_rel < 1)


def test_a_mode_of_ones_own() -> None:
    run = hung(Three(), v=3.0).simulate(4.0, rtol=1e-9, atol=1e-11)
    assert [event.target for event in run.events[:3]] == ["middle", "high", "middle"]
    rise = np.arcsin(1 / 3)
    assert run.events[1].time == pytest.approx(rise, abs=1e-8)
    inside = abs(run["element.s_rel"]) < 1 - 1e-9
    assert run["element.f"][inside] == pytest.approx(run["element.s_rel"][inside])


@pytest.mark.parametrize(
    ("transition", "message"),
    [
        (lambda self: self.mode.goes("low", "top", when=self.s_rel > 1), "mode 'mode' has no 'top'"),
        (lambda self: self.mode.goes("low", "high", when=self.s_rel), "when= takes a relation such as"),
        (lambda self: self.mode.choose(low=0, high=1), "choose() of 'mode' needs exactly"),
    ],
)
def test_what_is_wrong_with_a_mode(transition: Callable[[Any], Any], message: str) -> None:
    class Wrong(Three):
        def transitions(self) -> Any:
            yield transition(self)

    (line,) = told(Wrong())
    assert line.startswith("Wrong 'element': ")
    assert message in line


def test_equations_of_a_composite_may_use_its_parts_variables_only() -> None:
    class Measured(ia.TwoFlanges):
        power = ia.variable("W", "power lost")
        damper = ia.Damper(d=2.0)

        def equations(self) -> Any:
            yield self.power == self.damper.f * self.damper.v_rel

        def connections(self) -> Any:
            yield self.flange_a, self.damper.flange_a
            yield self.flange_b, self.damper.flange_b

    class Reaching(Measured):
        def equations(self) -> Any:
            yield self.power == self.damper.d

    class Missing(Measured):
        loss = ia.variable("W", "power lost")

        def equations(self) -> Any:
            yield self.loss == self.damper.w

    assert hung(Measured(), v=3.0).simulate(0.1)["element.power"][0] == pytest.approx(18.0)
    assert "equations cannot use parameter 'd' of a part" in told(Reaching())[0]
    assert "part 'damper' declares no 'w'" in told(Missing())[0]


@pytest.mark.parametrize(
    ("time", "values", "message"),
    [
        ([0, 1, 2], [0, 1, 2], "at least 4 samples are needed for a smooth signal, got 3"),
        ([0, 1, 2, 3], [0, 1, 2], "4 instants but 3 values"),
        ([0, 1, 1, 3], [0, 1, 2, 3], r"time does not increase after sample 1 \(t = 1 s\); sort it"),
        ([0, 1, 2, 3], [0, np.nan, 2, 3], "value nan at sample 1; remove or fill it"),
        ([0, np.inf, 2, 3], [0, 1, 2, 3], "time inf at sample 1"),
    ],
)
def test_bad_samples(time: list[float], values: list[float], message: str) -> None:
    with pytest.raises(ia.ModelError, match=message):
        ia.Sampled(time, values)


def test_samples_are_met_and_smooth_in_between() -> None:
    t = np.linspace(0.0, 2.0, 41)
    net = ia.Network("driven", drive=ia.Position(s_ref=ia.Sampled(t, np.sin(4 * t))), mass=ia.Mass(m=1.0))
    run = net.connect(net.drive.flange, net.mass.flange).simulate(2.0, step=0.01)
    assert run["mass.s"][::5] == pytest.approx(np.sin(4 * t), abs=1e-9)
    assert abs(np.diff(run["mass.a"])).max() < 16 * 0.01 * 4 * 3


def test_what_all_elements_of_a_kind_share_is_not_set_through_one() -> None:
    """A start value set so would have been that of every mass from then on, without a word."""
    mass = ia.Mass(m=2.0)
    with pytest.raises(ia.ModelError, match=r"variable 's' is declared once .* element\.s = \.\.\."):
        mass.s.start = 0.3
    assert ia.Mass.s.start == 0.0
    mass.s = 0.3
    assert ia.Network("one", mass=mass).simulate(0.1)["mass.s"][0] == 0.3


def test_a_value_set_later_acts_as_one_given_at_once() -> None:
    """It changed what was shown, and nothing of the run."""
    net: Any = hung(ia.Spring(k=100.0), s=0.1)
    net.element.k = 400.0
    net.mass.s = 0.2
    assert net.element.k == 400.0
    assert net.simulate(1.0, rtol=1e-9)["mass.s"][-1] == pytest.approx(0.2 * np.cos(20.0), abs=1e-6)


@pytest.mark.parametrize(
    ("owner", "name", "value", "told"),
    [
        ("element", "k", -5.0, r"Spring\.k: k must be at least 0 N/m, got -5\.0"),
        ("element", "k", "x", r"k must be a number \[N/m\], got 'x'"),
        ("element", "kk", 3.0, r"Spring has no parameter 'kk'; did you mean 'k'\?"),
        ("element", "flange_a", 3.0, "cannot be assigned"),
        ("", "element", ia.Spring(k=1.0), r"Network\.element cannot be assigned: .* with_values\(\)"),
        ("", "damper", ia.Damper(d=1.0), r"Network\.damper cannot be assigned: .* add\(\)"),
    ],
)
def test_what_cannot_be_set_is_refused_and_the_value_before_is_kept(
    owner: str, name: str, value: Any, told: str
) -> None:
    net: Any = hung(ia.Spring(k=100.0))
    with pytest.raises(ia.ModelError, match=told):
        setattr(getattr(net, owner) if owner else net, name, value)
    assert net.element.k == 100.0
    assert "damper" not in net._parts


def test_components_may_keep_things_of_their_own() -> None:
    spring: Any = ia.Spring(k=1.0)
    spring.supplier = "A. Smith"
    spring.delivered = 3
    assert (spring.supplier, spring.delivered) == ("A. Smith", 3)


def test_a_class_that_nobody_uses_any_more_is_collected() -> None:
    class Passing(ia.Spring):
        """A class made for one model, as FMUBlock makes them."""

    net = ia.Network("passing", wall=ia.Fixed(), spring=Passing(k=1.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)
    net.simulate(0.1)
    kept = weakref.ref(Passing)
    del Passing, net
    gc.collect()
    assert kept() is None
