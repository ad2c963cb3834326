"""Physics that holds for every network: balance of power, reaction, order of components."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

FEW = settings(max_examples=10, deadline=None, suppress_health_check=[HealthCheck.too_slow])
size = st.floats(0.1, 10.0)


@st.composite
def branches(draw: st.DrawFn) -> ia.Component:
    """Draw an element that stores or dissipates, but never creates."""
    a, b, c = draw(size), draw(size), draw(size)
    elements = [
        ia.Spring(k=10 * a),
        ia.Damper(d=a),
        ia.Inerter(b=a),
        ia.CoulombFriction(f_c=0.2 * a),
        ia.QuadraticDamper(c=a),
        ia.CubicSpring(k=10 * a, k3=5 * b),
        ia.series(ia.SpringDamper(k=10 * a, d=b), ia.Inerter(b=c)),
    ]
    return draw(st.sampled_from(elements))


def chain(parts: list[ia.Component], masses: list[float], order: list[int]) -> ia.Network:
    """Masses one behind the other, an element before each, added in the order given."""
    net = ia.Network("chain")
    named: dict[str, ia.Component] = {"wall": ia.Fixed()}
    named |= {f"m{i}": ia.Mass(m=m, v=(-1.0) ** i) for i, m in enumerate(masses)}
    named |= {f"e{i}": part.clone() for i, part in enumerate(parts)}
    names = list(named)
    net.add(**{names[k]: named[names[k]] for k in order})
    before = named["wall"]
    for i in range(len(masses)):
        net.connect(before.flange, named[f"e{i}"].flange_a)
        net.connect(named[f"e{i}"].flange_b, named[f"m{i}"].flange)
        before = named[f"m{i}"]
    return net


def speed(run: ia.Result, i: int) -> NDArray[np.float64]:
    return run[f"m{i}.v"] - (run[f"m{i - 1}.v"] if i else 0.0)


@FEW
@given(st.lists(st.tuples(branches(), size), min_size=1, max_size=4))
def test_elements_react_equally_and_no_energy_appears(drawn: list[tuple[ia.Component, float]]) -> None:
    parts, masses = [part for part, _ in drawn], [mass for _, mass in drawn]
    run = chain(parts, masses, list(range(1 + 2 * len(drawn)))).simulate(1.0, rtol=1e-8, atol=1e-10)
    kinetic = np.sum([0.5 * m * run[f"m{i}.v"] ** 2 for i, m in enumerate(masses)], axis=0)
    into_elements = np.zeros(len(run.time))
    for i in range(len(parts)):
        assert run[f"e{i}.flange_a.f"] == pytest.approx(-run[f"e{i}.flange_b.f"], abs=1e-9)
        into_elements += run[f"e{i}.f"] * speed(run, i)
    power = -np.sum([m * run[f"m{i}.v"] * run[f"m{i}.a"] for i, m in enumerate(masses)], axis=0)
    assert into_elements == pytest.approx(power, abs=1e-7 * max(1.0, abs(power).max()))
    inerters = np.zeros(len(run.time))
    for i, part in enumerate(parts):
        if isinstance(part, ia.Inerter):
            inerters += 0.5 * part.b * speed(run, i) ** 2
    stored = kinetic + inerters
    assert stored.max() <= stored[0] * (1 + 1e-5)


@FEW
@given(st.lists(st.tuples(branches(), size), min_size=2, max_size=4), st.randoms(use_true_random=False))
def test_the_order_of_components_changes_nothing(
    drawn: list[tuple[ia.Component, float]], random: Any
) -> None:
    parts, masses = [part for part, _ in drawn], [mass for _, mass in drawn]
    order = list(range(1 + 2 * len(drawn)))
    shuffled = order.copy()
    random.shuffle(shuffled)
    ends = []
    for chosen in (order, shuffled):
        run = chain(parts, masses, chosen).simulate(1.0, rtol=1e-9, atol=1e-11)
        ends.append([run[f"m{i}.s"][-1] for i in range(len(masses))])
    assert ends[0] == pytest.approx(ends[1], abs=1e-6)


@FEW
@given(size, size, size, st.floats(0.5, 20.0))
def test_series_and_parallel_against_their_impedance(k: float, d: float, b: float, omega: float) -> None:
    """Force of k || (d - b) driven at one frequency, against the complex admittance."""
    strut = ia.parallel(ia.Spring(k=k), ia.series(ia.Damper(d=d), ia.Inerter(b=b)))
    net = ia.Network("driven", drive=ia.Position(), strut=strut, wall=ia.Fixed())
    net.connect(net.wall.flange, net.strut.flange_a).connect(net.strut.flange_b, net.drive.flange)
    stop = 40 * b / d + 4 * np.pi / omega
    run = net.simulate(stop, inputs={"drive.s_ref": sine(omega)}, rtol=1e-9, atol=1e-11)
    s = 1j * omega
    admittance = k / s + 1 / (1 / d + 1 / (b * s))
    expected = (admittance * s * np.exp(s * run.time)).imag
    last = run.time > stop - 2 * np.pi / omega
    assert run["strut.f"][last] == pytest.approx(expected[last], abs=1e-5 * abs(expected).max())


def sine(omega: float) -> Any:
    return lambda t: np.sin(omega * t)
