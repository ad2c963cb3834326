"""Composites, two-terminal algebra and networks within networks."""

from collections.abc import Iterable
from typing import Any

import inertance as ia
import numpy as np
import pytest


class Strut(ia.TwoFlanges):
    """Spring and damper side by side; the damper follows from a damping ratio."""

    k = ia.parameter("N/m", "stiffness", above=0)
    zeta = ia.parameter("1", "damping ratio", default=0.1, min=0)
    m = ia.parameter("kg", "mass it is tuned to", default=2.0, above=0)
    d = ia.parameter("N.s/m", "damping", default=lambda self: 2 * self.zeta * np.sqrt(self.k * self.m), min=0)

    spring = ia.Spring(k=k)
    damper = ia.Damper(d=lambda self: self.d)

    def connections(self) -> Iterable[Any]:
        yield self.flange_a, self.spring.flange_a, self.damper.flange_a
        yield self.flange_b, self.spring.flange_b, self.damper.flange_b


def oscillator(element: ia.Component) -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), element=element, mass=ia.Mass(m=1.0, s=0.1))
    return net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.mass.flange)


def end(net: ia.Network, **options: Any) -> float:
    return float(net.simulate(1.0, rtol=1e-9, atol=1e-11, **options)["mass.s"][-1])


def test_bound_and_computed_parameters_can_be_read() -> None:
    run = oscillator(Strut(k=50.0)).simulate(1.0)
    assert run["element.spring.k"][0] == 50.0
    assert run["element.damper.d"][0] == pytest.approx(0.2 * np.sqrt(100.0))
    assert run.unit("element.damper.d") == "N.s/m"
    assert Strut(k=50.0).d == pytest.approx(2.0)
    assert oscillator(Strut(k=50.0, d=7.0)).simulate(1.0)["element.damper.d"][0] == 7.0


def test_changing_a_parameter_changes_what_follows_from_it() -> None:
    dae = oscillator(Strut(k=50.0)).dae()
    changed = ia.simulate(dae, 1.0, parameters={"element.k": 80.0, "element.zeta": 0.3})
    rebuilt = oscillator(Strut(k=80.0, zeta=0.3)).simulate(1.0)
    assert changed["mass.s"] == pytest.approx(rebuilt["mass.s"], abs=1e-12)
    with pytest.raises(ia.ModelError, match=r"'element.spring.k' follows from others; change those"):
        ia.simulate(dae, 1.0, parameters={"element.spring.k": 80.0})
    assert set(dae.parameter_values) >= {"element.k", "element.zeta", "mass.m"}


class Off(ia.TwoFlanges):
    """A part whose parameter can leave its range."""

    k = ia.parameter("N/m", "stiffness")
    spring = ia.Spring(k=lambda self: 10 - self.k)

    def connections(self) -> Iterable[Any]:
        yield self.flange_a, self.spring.flange_a
        yield self.flange_b, self.spring.flange_b


class Circular(ia.Compliant):
    """Two parameters that follow from each other."""

    a = ia.parameter("1", "one", default=lambda self: self.b)
    b = ia.parameter("1", "other", default=lambda self: self.a)

    def equations(self) -> Any:
        yield self.f == self.a * self.s_rel


def test_what_is_wrong_with_computed_parameters() -> None:
    assert oscillator(Off(k=4.0)).simulate(1.0)["element.spring.k"][0] == 6.0
    for wrong, told in [
        (oscillator(Off(k=11.0)), "Spring 'element.spring': k must be at least 0 N/m, got -1.0"),
        (oscillator(Circular()), "Circular 'element': a depends on itself"),
        (
            oscillator(ia.Spring(k=Strut.k)),
            "Spring 'element': k refers to a parameter of no enclosing component",
        ),
        (oscillator(ia.Spring(k=lambda self: self.spam)), "has no parameter 'spam'"),
    ]:
        with pytest.raises(ia.ModelError) as caught:
            wrong.dae()
        assert told in str(caught.value)
    with pytest.raises(ia.ModelError, match=r"k must be at least 0 N/m, got -20\.0"):
        oscillator(Off(k=4.0)).simulate(1.0, parameters={"element.k": 30.0})


def test_a_function_may_look_at_the_network() -> None:
    net = oscillator(ia.Spring(k=lambda self: 100 * self.mass.m))
    assert net.simulate(1.0)["element.k"][0] == 100.0


def test_parts_can_be_replaced() -> None:
    run = oscillator(Strut(k=50.0, damper=ia.QuadraticDamper(c=3.0))).simulate(1.0)
    assert run["element.damper.c"][0] == 3.0
    assert "element.damper.d" not in run
    for wrong, told in [
        (
            Strut(k=50.0, dampr=ia.Damper(d=1.0)),
            "Strut 'element': has no parameter 'dampr'; did you mean 'damper'?",
        ),
        (
            Strut(k=50.0, damper=ia.Mass(m=1.0)),
            "Strut 'element': its connections cannot be made: Mass has no 'flange_a'",
        ),
    ]:
        with pytest.raises(ia.ModelError) as caught:
            oscillator(wrong).dae()
        assert caught.value.problems[0].startswith(told)


def test_instances_do_not_share_parts() -> None:
    a, b = Strut(k=1.0), Strut(k=2.0)
    assert a.spring is not b.spring
    assert a.clone().spring is not a.spring


def test_one_component_declared_twice_is_two_parts() -> None:
    spring = ia.Spring(k=4.0)

    class Twice(ia.TwoFlanges):
        one = spring
        two = spring

        def connections(self) -> Iterable[Any]:
            yield self.flange_a, self.one.flange_a
            yield self.one.flange_b, self.two.flange_a
            yield self.two.flange_b, self.flange_b

    assert end(oscillator(Twice())) == pytest.approx(0.1 * np.cos(np.sqrt(2.0)), abs=1e-8)


def test_changed_copies() -> None:
    bad = ia.Spring(k=-1.0)
    good = bad.with_values(k=2.0)
    assert end(oscillator(good)) == pytest.approx(0.1 * np.cos(np.sqrt(2.0)), abs=1e-8)
    with pytest.raises(ia.ModelError, match=r"got -1\.0"):
        oscillator(bad).dae()
    planets = 5
    shaped = ia.PlanetaryFlywheel().with_values(N=planets)  # type: ignore[call-arg]
    assert any("N shapes its parts; create another one with it" in told for told in shaped.problems())


def test_series_and_parallel_name_their_elements() -> None:
    element = ia.series(
        ia.Spring(k=1.0),
        ia.parallel(ia.Inerter(b=2.0), ia.Damper(d=3.0)),
        ia.parallel(ia.Inerter(b=2.0), loss=ia.Damper(d=4.0)),
        ia.Spring(k=5.0),
        end=ia.Spring(k=6.0),
    )
    run = oscillator(element).simulate(1.0)
    names = ("spring.k", "branch.damper.d", "branch_2.loss.d", "spring_2.k", "end.k")
    assert [run[f"element.{name}"][0] for name in names] == [1.0, 3.0, 4.0, 5.0, 6.0]
    forces = [run[f"element.{name}.f"] for name in ("spring", "branch", "branch_2", "spring_2", "end")]
    for force in forces:
        assert force == pytest.approx(run["element.f"], abs=1e-9)
    parts = ("spring", "branch", "branch_2", "spring_2", "end")
    assert sum(run[f"element.{name}.s_rel"] for name in parts) == pytest.approx(run["element.s_rel"])


def test_series_and_parallel_of_springs() -> None:
    def pulled(element: ia.Component) -> float:
        return float(oscillator(element).simulate(0.1)["element.f"][0])

    k = [1.0, 2.0, 3.0]
    assert pulled(ia.series(*(ia.Spring(k=x) for x in k))) == pytest.approx(0.1 / sum(1 / x for x in k))
    assert pulled(ia.parallel(*(ia.Spring(k=x) for x in k))) == pytest.approx(0.1 * sum(k))
    assert pulled(ia.series(ia.Spring(k=3.0))) == pytest.approx(0.3)
    assert pulled(ia.series(ia.Rod(L=1.0), ia.Spring(k=3.0, s_rel0=-1.0))) == pytest.approx(0.3)


def test_what_cannot_be_joined() -> None:
    spring = ia.Spring(k=1.0)
    for join in (ia.series, ia.parallel):
        for wrong in (ia.Mass(m=1.0), ia.Spring, 3.0):
            with pytest.raises(ia.ModelError, match="has no flange_a and flange_b"):
                join(spring, wrong)  # type: ignore[arg-type]
        with pytest.raises(ia.ModelError, match="at least one element"):
            join()
        with pytest.raises(ia.ModelError, match="'spring' cannot name an element here"):
            join(spring, spring=ia.Spring(k=2.0))
        with pytest.raises(ia.ModelError, match="'f' cannot name an element here"):
            join(f=spring)
    with pytest.raises(ia.ModelError, match=r"'element.spring_2' is the same object as 'element.spring'"):
        oscillator(ia.series(spring, spring)).dae()


def test_networks_within_networks() -> None:
    inner = ia.Network("inner", mass=ia.Mass(m=1.0), spring=ia.Spring(k=3.0))
    inner.connect(inner.mass.flange, inner.spring.flange_a)
    outer = ia.Network("outer", left=inner, right=inner.clone(), wall=ia.Fixed(), mid=ia.Spring(k=1.0))
    outer.connect(outer.wall.flange, outer.left.spring.flange_b, outer.right.spring.flange_b)
    outer.connect(outer.left.mass.flange, outer.mid.flange_a).connect(
        outer.mid.flange_b, outer.right.mass.flange
    )
    run = outer.simulate(1.0, start={"left.mass.s": 1.0, "right.mass.s": -1.0}, rtol=1e-9, atol=1e-11)
    assert run["left.mass.s"] == pytest.approx(np.cos(np.sqrt(5.0) * run.time), abs=1e-7)
    assert run["right.mass.s"] == pytest.approx(-run["left.mass.s"], abs=1e-9)


def test_a_clone_of_a_network_is_independent() -> None:
    net = oscillator(ia.Spring(k=100.0))
    twin = net.clone()
    twin.add(more=ia.Mass(m=5.0)).connect(twin.more.flange, twin.mass.flange)
    assert end(net) == pytest.approx(0.1 * np.cos(10.0), abs=1e-7)
    assert end(twin) == pytest.approx(0.1 * np.cos(10.0 / np.sqrt(6.0)), abs=1e-7)
    changed = net.with_values(element=ia.Spring(k=25.0))
    assert end(changed) == pytest.approx(0.1 * np.cos(5.0), abs=1e-7)


def test_an_input_of_a_composite_that_a_part_takes_is_one_of_the_network() -> None:
    class Pusher(ia.Component):
        flange = ia.TranslationalFlange("what is pushed")
        u = ia.RealInput("N", "force")
        push = ia.Force()

        def connections(self) -> Any:
            yield self.u, self.push.f
            yield self.flange, self.push.flange

    def pushed(**values: float) -> ia.Network:
        net = ia.Network("pushed", pusher=Pusher(**values), mass=ia.Mass(m=2.0))
        return net.connect(net.pusher.flange, net.mass.flange)

    given = pushed().simulate(1.0, inputs={"pusher.u": lambda t: 4 + 0 * t})
    assert given["mass.a"][-1] == pytest.approx(2.0)
    assert pushed(u=6.0).simulate(1.0)["mass.a"][-1] == pytest.approx(3.0)
    joined = pushed().add(gain=ia.signals.Gain(k=8.0))
    joined.connect(joined.gain.y, joined.pusher.u)
    assert [signal.path for signal in joined.dae().inputs] == ["gain.u"]
