"""Sources against their definitions at given instants, blocks against closed forms."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import signals


def run_source(source: ia.Component, stop: float = 1.0, **options: Any) -> ia.Result:
    """Run a source beside its integral."""
    net = ia.Network("source", source=source, integral=signals.Integrator())
    net.connect(net.source.y, net.integral.u)
    return net.simulate(stop, **options)


def times(run: ia.Result) -> list[float]:
    return [event.time for event in run.events]


@pytest.mark.parametrize(
    ("source", "at", "integral", "instants"),
    [
        (signals.Constant(k=3.0), {0.0: 3.0, 1.0: 3.0}, 3.0, []),
        (signals.Clock(), {0.0: 0.0, 0.25: 0.25}, 0.5, []),
        (
            signals.Step(height=2.0, offset=1.0, start_time=0.3),
            {0.2: 1.0, 0.3: 3.0, 0.9: 3.0}, 1.0 + 1.4, [0.3],
        ),
        (
            signals.Ramp(height=2.0, duration=0.5, offset=1.0, start_time=0.2),
            {0.2: 1.0, 0.45: 2.0, 0.7: 3.0, 1.0: 3.0}, 1.0 + 0.5 + 0.6, [0.2, 0.7],
        ),
        (
            signals.Ramp(height=2.0, duration=0.0, start_time=0.4),
            {0.3: 0.0, 0.4: 2.0, 1.0: 2.0}, 1.2, [0.4, 0.4],
        ),
        (
            signals.Sine(amplitude=2.0, f=1.0, phase=np.pi / 2, offset=1.0, start_time=0.5),
            {0.4: 1.0, 0.5: 3.0, 0.75: 1.0, 1.0: -1.0}, 1.0, [0.5],
        ),
        (
            signals.Pulse(amplitude=2.0, period=0.4, width=0.25, offset=1.0, start_time=0.1),
            {0.0: 1.0, 0.1: 3.0, 0.15: 3.0, 0.2: 1.0, 0.5: 3.0, 0.95: 3.0},
            1.0 + 2 * 0.3, [0.1, 0.2, 0.5, 0.6, 0.9],
        ),
        (
            signals.Trapezoid(
                amplitude=2.0, rising=0.1, width=0.2, falling=0.1, period=0.8, start_time=0.1
            ),
            {0.1: 0.0, 0.15: 1.0, 0.3: 2.0, 0.45: 1.0, 0.6: 0.0, 0.95: 1.0},
            0.6 + 0.1, [0.1, 0.2, 0.4, 0.5, 0.9],
        ),
        (
            signals.TimeTable(table=((0.1, 1.0), (0.3, 2.0), (0.3, 0.0), (0.5, 0.0), (0.6, -1.0))),
            {0.0: 1.0, 0.2: 1.5, 0.3: 0.0, 0.4: 0.0, 0.55: -0.5, 0.9: -1.0},
            0.1 + 0.3 - 0.05 - 0.4, [0.1, 0.3, 0.3, 0.3, 0.5, 0.6],
        ),
    ],
)  # fmt: skip
def test_source(source: ia.Component, at: dict[float, float], integral: float, instants: list[float]) -> None:
    run = run_source(source, rtol=1e-9, atol=1e-11)
    for t, value in at.items():
        assert run.at("source.y", t + 1e-9) == pytest.approx(value, abs=1e-6)
    assert run["integral.y"][-1] == pytest.approx(integral, abs=1e-7)
    assert times(run) == pytest.approx(instants, abs=1e-12)


def test_sine_that_always_ran_makes_no_event() -> None:
    run = run_source(signals.Sine(amplitude=2.0, f=3.0, phase=0.5, offset=1.0))
    assert run["source.y"] == pytest.approx(1 + 2 * np.sin(6 * np.pi * run.time + 0.5))
    assert not run.events


def test_no_pulse_is_lost_however_narrow() -> None:
    """A hundred pulses of 10 us, far below the output interval."""
    run = run_source(signals.Pulse(period=0.01, width=1e-3), step=0.1)
    assert run["integral.y"][-1] == pytest.approx(100 * 1e-5, rel=1e-6)
    assert len(run.events) == 200


@pytest.mark.parametrize("begin", [1000.03, 1000.07])
def test_periodic_source_catches_up_in_a_run_that_begins_late(begin: float) -> None:
    run = run_source(signals.Pulse(period=0.1, width=0.5), stop=1000.2, begin=begin)
    late = [t for t in times(run) if t > begin]
    assert late == pytest.approx([t for t in (1000.05, 1000.1, 1000.15) if t > begin], abs=1e-9)
    high = np.mod(run.time - 1000, 0.1) < 0.05
    inside = np.abs(np.mod(run.time - 1000 + 0.025, 0.05) - 0.025) > 1e-6
    assert run["source.y"][inside] == pytest.approx(high[inside].astype(float))


def test_falling_times_of_a_table_are_refused() -> None:
    with pytest.raises(ia.ModelError, match=r"'source': table takes rows .* times not decreasing"):
        run_source(signals.TimeTable(table=((0.0, 0.0), (1.0, 1.0), (0.5, 0.0))))


def respond(block: ia.Component, u: Any, stop: float = 1.0, **options: Any) -> ia.Result:
    options = {"rtol": 1e-9, "atol": 1e-11, **options}
    return ia.Network("block", block=block).simulate(stop, inputs={"block.u": u}, **options)


def test_memoryless_blocks() -> None:
    def sine(t: Any) -> Any:
        return 3 * np.sin(10 * t)

    run = respond(signals.Gain(k=-2.0), sine)
    assert run["block.y"] == pytest.approx(-2 * sine(run.time))
    run = respond(signals.Limiter(y_max=2.0), sine)
    assert run["block.y"] == pytest.approx(np.clip(sine(run.time), -2, 2))
    run = respond(signals.Limiter(y_max=2.0, y_min=1.0), sine)
    assert run["block.y"] == pytest.approx(np.clip(sine(run.time), 1, 2))


def test_blocks_of_two_inputs() -> None:
    net = ia.Network("blocks", sum=signals.Add(k1=2.0, k2=-1.0), product=signals.Product())
    net.connect(net.sum.y, net.product.u1)
    inputs = {"sum.u1": 3.0, "sum.u2": lambda t: t, "product.u2": lambda t: t**2}
    run = net.simulate(1.0, inputs=inputs)
    assert run["product.y"] == pytest.approx((6 - run.time) * run.time**2)


def test_first_order_answers_a_step() -> None:
    run = respond(signals.FirstOrder(k=2.0, T=0.3, x=0.5), 1.0)
    assert run["block.y"] == pytest.approx(2 - 1.5 * np.exp(-run.time / 0.3), abs=1e-7)


def test_integrator_answers_a_ramp() -> None:
    run = respond(signals.Integrator(k=2.0, x=0.5), lambda t: t)
    assert run["block.y"] == pytest.approx(0.5 + run.time**2, abs=1e-7)


def test_derivative_starts_from_zero_or_from_rest() -> None:
    k, T = 2.0, 0.1
    kick = respond(signals.Derivative(k=k, T=T), lambda t: 5 + 3 * t)
    calm = respond(signals.Derivative(k=k, T=T), lambda t: 5 + 3 * t, start={"block.y": 0.0})
    decay = np.exp(-kick.time / T)
    assert kick["block.y"] == pytest.approx(k * (3 * (1 - decay) + 5 / T * decay), abs=1e-5)
    assert calm["block.y"] == pytest.approx(k * 3 * (1 - decay), abs=1e-6)


@pytest.mark.parametrize("n", [1, 2, 5, 8])
def test_delay_has_the_pade_response(n: int) -> None:
    """A sine settles to the amplitude 1 exactly and to the phase of the Pade fraction."""
    T, w = 0.2, 10.0
    s, p, q = 1j * w * T, 0j, 0j
    weight = 1.0
    for k in range(n + 1):
        p, q = p + weight * (-s) ** k, q + weight * s**k
        weight *= (n - k) / ((2 * n - k) * (k + 1))
    run = respond(signals.Delay(T=T, n=n), lambda t: np.sin(w * t), stop=10.0)
    late = run.time > 8
    settled = np.imag(p / q * np.exp(1j * w * run.time))
    assert run["block.y"][late] == pytest.approx(settled[late], abs=1e-6)


def test_delay_delays_a_smooth_signal() -> None:
    def bell(t: Any) -> Any:
        return np.exp(-(((t - 0.5) / 0.1) ** 2))

    run = respond(signals.Delay(T=0.1, n=8), bell)
    assert run["block.y"] == pytest.approx(bell(run.time - 0.1), abs=1e-5)


@pytest.mark.parametrize("n", [4, 5])
def test_delay_starts_from_a_constant_and_jumps_with_the_sign_of_its_order(n: int) -> None:
    block = signals.Delay(T=0.1, n=n)
    calm = respond(block, 3.0, start={"block.stage1.x": 3.0})
    assert calm["block.y"] == pytest.approx(np.full(len(calm.time), 3.0))
    jump = respond(block, 3.0)
    assert jump["block.y"][0] == pytest.approx(3.0 * (-1) ** n)
    assert jump["block.y"][-1] == pytest.approx(3.0, abs=1e-6)
