"""What holds for every signal of time: bounds hold it, pulses are seen, a later input acts later."""

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn
from inertance import DAE, Damper, Fixed, Force, Mass, Network, Sampled, Spring, simulate
from inertance.networks.simulation.intervals import Enclosure
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
Operation = Callable[..., Any]

UNARY: tuple[Operation, ...] = (
    ca.sin, ca.cos, ca.tan, ca.exp, ca.fabs, ca.floor, ca.ceil, ca.sign, ca.sqrt, ca.atan, ca.tanh, ca.log,
    ca.cosh, ca.asinh, ca.erf, lambda x: 1 / x, lambda x: x**2, lambda x: x**3, lambda x: -x,
    lambda x: ca.logic_not(x > 1),
)  # fmt: skip
BINARY: tuple[Operation, ...] = (
    lambda a, b: a + b, lambda a, b: a - b, lambda a, b: a * b, lambda a, b: a / b, ca.fmin, ca.fmax, ca.fmod,
    lambda a, b: ca.if_else(a < b, a, 2 * b), lambda a, b: ca.if_else(a <= b, b, a),
    lambda a, b: ca.fabs(a) ** b, lambda a, b: ca.if_else(ca.logic_and(a > 0, b > 0), a, b),
    lambda a, b: ca.if_else(ca.logic_or(a > 1, b < 0), a, b),
    ca.copysign, ca.atan2, ca.remainder, lambda a, b: a != b,
)  # fmt: skip


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers of nine decimals: squares of smaller ones have no digits left."""
    return st.floats(low, high).map(lambda x: round(x, 9))


@st.composite
def expressions(draw: DrawFn, depth: int = 3) -> Operation:
    """A random expression of t, as a function of an SX."""
    if depth == 0:
        number = draw(numbers(-3, 3))
        leaves: list[Operation] = [lambda t: t, lambda t: ca.SX(number), lambda t: t - number]
        return draw(st.sampled_from(leaves))
    if draw(st.booleans()):
        operation, of = draw(st.sampled_from(UNARY)), draw(expressions(depth - 1))
        return lambda t: operation(of(t))
    operation, a, b = (
        draw(st.sampled_from(BINARY)),
        draw(expressions(depth - 1)),
        draw(expressions(depth - 1)),
    )
    return lambda t: operation(a(t), b(t))


def along(function: ca.Function, times: Array) -> Array:
    """Values at instants."""
    return np.array(function(times[None, :])).ravel()


def parts(expression: ca.SX) -> list[ca.SX]:
    """Return an expression and all that it is made of."""
    return [expression, *(part for i in range(expression.n_dep()) for part in parts(expression.dep(i)))]


def steps_on_the_way(function: ca.Function, low: float, high: float) -> tuple[float, float]:
    """Largest step between instants, and what is left of it between neighbouring numbers there."""
    times = np.linspace(low, high, 20_001)
    coarse = None
    while True:
        steps = np.abs(np.diff(along(function, times)))
        widest = steps.argmax()
        coarse = steps[widest] if coarse is None else coarse
        if len(times) == 2:
            return float(coarse), float(steps[widest])
        times = np.unique(np.linspace(times[widest], times[widest + 1], 11))


def rounding(function: ca.Function, times: Array) -> Array:
    """How far values at neighbouring numbers are apart."""
    with np.errstate(all="ignore"):
        return np.abs(along(function, np.nextafter(times, np.inf)) - along(function, times))


def is_noise(function: ca.Function, low: float, high: float) -> bool:
    """Whether a function is so steep that values at neighbouring numbers have nothing in common."""
    times = np.linspace(low, high, 1001)
    return bool(rounding(function, times).mean() > 1e-2 * np.ptp(along(function, times)))


@settings(max_examples=300, deadline=None, derandomize=True)
@given(expressions(), numbers(-5, 5), numbers(0, 2))
def test_bounds_hold_every_value(expression: Operation, low: float, width: float) -> None:
    t = ca.SX.sym("t")
    value = ca.densify(ca.SX(expression(t)))
    function = ca.Function("f", [t], [value])
    sizes = ca.Function("sizes", [t], [ca.sum1(ca.fabs(ca.vertcat(*parts(value))))])
    high = low + width
    below, above, undecided = Enclosure(function)([(np.array([low]), np.array([high]))])
    times = np.linspace(low, high, 101)
    values = along(function, times)
    slack = 1e-9 * (1 + np.abs(values)) + 100 * rounding(function, times)
    sound = np.isfinite(slack) & (along(sizes, times) < 1e5)  # beyond, sines lose their digits
    assert (below[0, 0] <= values[sound] + slack[sound]).all()
    assert (values[sound] - slack[sound] <= above[0, 0]).all()
    whole = np.isfinite([below, above]).all() and sound.all() and width > 1e-9
    if not undecided[0] and whole and not is_noise(function, low, high):
        coarse, closest = steps_on_the_way(function, low, high)
        assert closest <= 0.5 * coarse + 1e-6, "what is decided has no jump"


@pytest.mark.parametrize(
    "jumping",
    [
        lambda t: ca.atan2(ca.sin(5 * t), ca.cos(5 * t)),
        lambda t: ca.atan(1 / (t - 0.7)),
        lambda t: ca.tanh(ca.tan(2 * t)),
        lambda t: ca.copysign(t, t * (t - 0.7)),
    ],
    ids=["sawtooth", "inverse", "tangent", "sign"],
)
def test_what_jumps_is_not_decided(jumping: Operation) -> None:
    t = ca.SX.sym("t")
    box = (np.array([0.5]), np.array([1.0]))
    assert Enclosure(ca.Function("f", [t], [jumping(t)]))([box])[2].all()


def wagon() -> DAE:
    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    return net.dae()


WAGON = wagon()


@pytest.mark.parametrize(("middle", "half"), [(2.0, 0.25), (3.5, 0.125), (10.25, 1 / 32), (2.1, 0.25)])
@pytest.mark.parametrize("solver", ["cvodes", "rosenbrock"])
def test_no_pulse_of_round_numbers_is_missed(middle: float, half: float, solver: str) -> None:
    """Its bends are floating-point numbers, at which what is looked at ends."""

    def force(t: Any) -> Any:
        return ca.fmax(0, 1 - ca.fabs(t - middle) / half) / half

    run = simulate(WAGON, 100.0, inputs={"push.f": force}, solver=solver, rtol=1e-9, atol=1e-11)
    assert run["mass.v"][-1] == pytest.approx(1.0, abs=1e-6)


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.02, 0.98), st.floats(-4, -2), st.booleans()), min_size=1, max_size=5),
    st.sampled_from(["cvodes", "idas", "rosenbrock"]),
    st.floats(-1, 3),
    st.sampled_from([-7.0, 0.0, 1e3]),
    st.booleans(),
)
def test_no_pulse_of_a_random_train_is_missed(
    pulses: list[tuple[float, float, bool]], solver: str, scale: float, begin: float, as_data: bool
) -> None:
    span = 10**scale
    areas = [(-1.0 if negative else 1.0) for *_, negative in pulses]
    drawn = [(begin + place * span, span * 10**width) for place, width, _ in pulses]

    def force(t: Any) -> Any:
        return sum(a / w * ca.fmax(0, 1 - ca.fabs(t - c) / w) for a, (c, w) in zip(areas, drawn, strict=True))

    signal: Operation | Sampled = force
    expected = sum(areas)
    if as_data:
        times = np.unique(
            np.concatenate(
                [
                    [begin, begin + span / 3, begin + span],
                    *(c + np.linspace(-1.5, 1.5, 97) * w for c, w in drawn),
                ]
            )
        )
        times = times[(times >= begin) & (times <= begin + span)]
        times = times[np.append(True, np.diff(times) > 1e-9 * span)]
        assume(len(times) > 3)
        t = ca.SX.sym("t")
        values = np.array(ca.Function("f", [t], [force(t)])(times[None, :])).ravel()
        signal = Sampled(times, values)
        expected = CubicSpline(times, values).integrate(begin, begin + span)
    run = simulate(
        WAGON, begin + span, begin=begin, inputs={"push.f": signal}, solver=solver, rtol=1e-10, atol=1e-12
    )
    assert run["mass.v"][-1] == pytest.approx(expected, abs=1e-4)


@settings(max_examples=8, deadline=None)
@given(st.floats(0.0, 200.0), st.floats(1e-3, 2.0), st.sampled_from(["auto", "rosenbrock"]))
def test_an_input_that_comes_later_gives_the_same_response_later(
    delay: float, width: float, solver: str
) -> None:
    net = Network(
        "oscillator",
        wall=Fixed(),
        spring=Spring(k=400.0),
        damper=Damper(d=2.0),
        mass=Mass(m=1.0),
        push=Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    dae = net.dae()

    def shape(s: Any) -> Any:
        return ca.if_else(ca.logic_and(s > 0, s < width), ca.sin(ca.pi * s / width), 0.0)

    for since in (0.5 * width, width, 2.0 * width + 0.1):
        later = simulate(
            dae,
            delay + since,
            begin=0.0,
            inputs={"push.f": lambda t: shape(t - delay)},
            solver=solver,
            rtol=1e-8,
        )
        at_once = simulate(dae, since, inputs={"push.f": shape}, solver=solver, rtol=1e-8)
        assert later["mass.v"][-1] == pytest.approx(at_once["mass.v"][-1], rel=1e-4, abs=2e-6)
