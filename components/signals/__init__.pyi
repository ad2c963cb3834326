"""Signals: sources over time and the blocks that close a loop."""

# Made by docs/make_stubs.py from the classes; do not edit.

from typing import Any, Literal

import numpy as np

from ..language import Component, Number, ParameterValue, SignalValue

class Add(Component):
    """Sum of two signals: y = k1 u1 + k2 u2; k2 = -1 makes it a difference.

    Source: MSL Blocks.Math.Add.

    Args:
        u1: first input, a number, a function of time or Sampled data.
        u2: second input, a number, a function of time or Sampled data.
        k1: weight of the first input.
        k2: weight of the second input.
    """

    u1: Any
    """first input, a number, a function of time or Sampled data"""
    u2: Any
    """second input, a number, a function of time or Sampled data"""
    y: Any
    """sum"""
    k1: Any
    """weight of the first input"""
    k2: Any
    """weight of the second input"""
    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
        k1: ParameterValue = 1.0,
        k2: ParameterValue = 1.0,
    ) -> None: ...

class BooleanToReal(Component):
    """A number for on and one for off: y = realTrue while u is 1, realFalse while u is 0.

    Left to the run, u is a Boolean input of an FMU: what switches a clutch, a brake or a `Switch` behind it.

    Source: MSL Blocks.Math.BooleanToReal.

    Args:
        u: 0 or 1, a number, a function of time or Sampled data.
        realTrue: output while u is 1.
        realFalse: output while u is 0.
    """

    u: Any
    """0 or 1, a number, a function of time or Sampled data"""
    y: Any
    """output"""
    realTrue: Any
    """output while u is 1"""
    realFalse: Any
    """output while u is 0"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
        realTrue: ParameterValue = 1.0,
        realFalse: ParameterValue = 0.0,
    ) -> None: ...

class CombiTable2D(Component):
    """A lookup map over two inputs, bilinear between its points. Continuous, so it makes no event.

    Source: MSL Blocks.Tables.CombiTable2Ds with LinearSegments.

    Example:
        >>> from inertance import signals
        >>> engine = signals.CombiTable2D(table=((0, 0, 1), (100, 10, 80), (300, 5, 120)))

    Args:
        u1: input down the first column, a number, a function of time or Sampled data.
        u2: input along the first row, a number, a function of time or Sampled data.
        table: rows (0, u2, ...), (u1, y, ...), ....
        extrapolation: what it is beyond its ends: straight on, or the last value.
    """

    u1: Any
    """input down the first column, a number, a function of time or Sampled data"""
    u2: Any
    """input along the first row, a number, a function of time or Sampled data"""
    y: Any
    """output"""
    table: Any
    """rows (0, u2, ...), (u1, y, ...), ..."""
    extrapolation: Any
    """what it is beyond its ends: straight on, or the last value"""
    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
        table: Any = ...,
        extrapolation: Literal['linear', 'hold'] = 'linear',
    ) -> None: ...

class CombiTimeTable(Component):
    """Several signals of time from one table: part `column1` has the first in its `y`, and so on.

    Each is linear between rows; two rows of equal time make a jump. Before the first row they have their
    first values, after the last row the last ones.

    Source: MSL Blocks.Sources.CombiTimeTable with extrapolation HoldLastPoint; its y[1] is `column1.y`.

    Example:
        >>> from inertance import signals
        >>> weather = signals.CombiTimeTable(table=((0.0, 1.0, 5.0), (2.0, 3.0, 4.0)))
        >>> [name for name in ("column1", "column2", "column3") if hasattr(weather, name)]
        ['column1', 'column2']

    Args:
        table: rows (time [s], value, value, ...), times not decreasing.
    """

    table: Any
    """rows (time [s], value, value, ...), times not decreasing"""
    def __init__(
        self,
        *,
        table: Any = ...,
        **parts: Component,
    ) -> None: ...

class LimPI(Component):
    """PI controller with limited output, anti-windup and weight of the setpoint.

    y = min(max(v, y_min), y_max), v = k (wp u_s - u_m + x), Ti x' = u_s - u_m + (y - v)/(k Ni).

    Source: MSL Blocks.Continuous.LimPID, controllerType PI.

    Args:
        k: gain, above 0.
        Ti: integral time [s], above 0.
        y_max: upper limit of the output.
        u_s: setpoint, a number, a function of time or Sampled data.
        u_m: measurement, a number, a function of time or Sampled data.
        y_min: lower limit of the output.
        Ni: anti-windup time over integral time, above 0.
        wp: weight of the setpoint in the proportional part, at least 0.
        x: integral part, fixed start value.
        v: output before the limits, fixed start value.
    """

    u_s: Any
    """setpoint, a number, a function of time or Sampled data"""
    u_m: Any
    """measurement, a number, a function of time or Sampled data"""
    y: Any
    """limited output"""
    k: Any
    """gain, above 0"""
    Ti: Any
    """integral time [s], above 0"""
    y_max: Any
    """upper limit of the output"""
    y_min: Any
    """lower limit of the output"""
    Ni: Any
    """anti-windup time over integral time, above 0"""
    wp: Any
    """weight of the setpoint in the proportional part, at least 0"""
    x: Any
    """integral part, fixed start value"""
    v: Any
    """output before the limits, fixed start value"""
    @property
    def rate(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        Ti: ParameterValue,
        y_max: ParameterValue,
        u_s: SignalValue = ...,
        u_m: SignalValue = ...,
        y_min: ParameterValue = ...,
        Ni: ParameterValue = 0.9,
        wp: ParameterValue = 1.0,
        x: Number = ...,
        v: Number = ...,
    ) -> None: ...

class Product(Component):
    """Product of two signals: y = u1 u2.

    Source: MSL Blocks.Math.Product.

    Args:
        u1: first input, a number, a function of time or Sampled data.
        u2: second input, a number, a function of time or Sampled data.
    """

    u1: Any
    """first input, a number, a function of time or Sampled data"""
    u2: Any
    """second input, a number, a function of time or Sampled data"""
    y: Any
    """product"""
    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
    ) -> None: ...

class SISO(Component):
    """What a block with a single input and a single output has: u in, y out."""

    u: Any
    """input, a number, a function of time or Sampled data"""
    y: Any
    """output"""
    def __init__(self, **values: Any) -> None: ...

class Source(Component):
    """What all signals of time have: an output y [unit of what it drives]."""

    y: Any
    """signal"""
    def __init__(self, **values: Any) -> None: ...

class Switch(Component):
    """One signal or another: y = u1 while u2 > threshold, else u3.

    Source: MSL Blocks.Logical.Switch, whose u2 is Boolean: here it is on above `threshold`.

    Args:
        u1: passed on while u2 is on, a number, a function of time or Sampled data.
        u2: what switches, a number, a function of time or Sampled data.
        u3: passed on while u2 is off, a number, a function of time or Sampled data.
        threshold: value of u2 above which it is on.
    """

    u1: Any
    """passed on while u2 is on, a number, a function of time or Sampled data"""
    u2: Any
    """what switches, a number, a function of time or Sampled data"""
    u3: Any
    """passed on while u2 is off, a number, a function of time or Sampled data"""
    y: Any
    """output"""
    threshold: Any
    """value of u2 above which it is on"""
    mode: Any
    """u3 or u1"""
    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
        u3: SignalValue = ...,
        threshold: ParameterValue = 0.5,
    ) -> None: ...

class _OfTwo(Component):
    u1: Any
    """first input, a number, a function of time or Sampled data"""
    u2: Any
    """second input, a number, a function of time or Sampled data"""
    y: Any
    """output"""
    def __init__(self, **values: Any) -> None: ...

class Abs(SISO):
    """Size: y = |u|. Continuous, so it makes no event.

    Source: MSL Blocks.Math.Abs.

    Args:
        u: input, a number, a function of time or Sampled data.
    """

    def __init__(
        self,
        *,
        u: SignalValue = ...,
    ) -> None: ...

class Chirp(Source):
    """A sine whose frequency changes evenly from f_min to f_max, a linear chirp.

    y = offset + amplitude sin(2 pi (f_min t + (f_max - f_min) t^2/(2 T))), where t counts from start_time,
    T is `duration`; before it begins y = offset, after T it goes on at f_max. A frequency that falls has
    f_max below f_min.

    Args:
        f_min: frequency at its beginning [Hz], at least 0.
        f_max: frequency after its duration [Hz], at least 0.
        duration: how long the frequency changes [s], above 0.
        amplitude: amplitude.
        offset: mean.
        start_time: when it begins [s].
    """

    amplitude: Any
    """amplitude"""
    f_min: Any
    """frequency at its beginning [Hz], at least 0"""
    f_max: Any
    """frequency after its duration [Hz], at least 0"""
    duration: Any
    """how long the frequency changes [s], above 0"""
    offset: Any
    """mean"""
    start_time: Any
    """when it begins [s]"""
    mode: Any
    """before, while or after the frequency changes"""
    def __init__(
        self,
        *,
        f_min: ParameterValue,
        f_max: ParameterValue,
        duration: ParameterValue,
        amplitude: ParameterValue = 1.0,
        offset: ParameterValue = 0.0,
        start_time: ParameterValue = 0.0,
    ) -> None: ...

class Clock(Source):
    """Time as a signal: y = offset + time [s].

    Source: MSL Blocks.Sources.ContinuousClock.

    Args:
        offset: what it shows at time = 0 [s].
    """

    y: Any
    """time [s]"""
    offset: Any
    """what it shows at time = 0 [s]"""
    def __init__(
        self,
        *,
        offset: ParameterValue = 0.0,
    ) -> None: ...

class CombiTable1D(SISO):
    """A lookup table over one input, straight lines between its rows. Continuous, so it makes no event.

    Source: MSL Blocks.Tables.CombiTable1Ds with one column and LinearSegments.

    Example:
        >>> from inertance import signals
        >>> valve = signals.CombiTable1D(table=((0.0, 0.0), (1.0, 2.0), (3.0, 2.5)))

    Args:
        u: input, a number, a function of time or Sampled data.
        table: rows (u, y), u increasing.
        extrapolation: what it is beyond its ends: straight on, or the last value.
    """

    table: Any
    """rows (u, y), u increasing"""
    extrapolation: Any
    """what it is beyond its ends: straight on, or the last value"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
        table: Any = ...,
        extrapolation: Literal['linear', 'hold'] = 'linear',
    ) -> None: ...

class Constant(Source):
    """A constant signal: y = k.

    Source: MSL Blocks.Sources.Constant.

    Args:
        k: value.
    """

    k: Any
    """value"""
    def __init__(
        self,
        *,
        k: ParameterValue,
    ) -> None: ...

class DeadZone(SISO):
    """Dead zone: y = u - u_max above u_max, u - u_min below u_min, 0 between: continuous, without events.

    Source: MSL Blocks.Nonlinear.DeadZone.

    Args:
        u_max: upper end of the zone, at least 0.
        u: input, a number, a function of time or Sampled data.
        u_min: lower end of the zone, at most 0.
    """

    u_max: Any
    """upper end of the zone, at least 0"""
    u_min: Any
    """lower end of the zone, at most 0"""
    def __init__(
        self,
        *,
        u_max: ParameterValue,
        u: SignalValue = ...,
        u_min: ParameterValue = ...,
    ) -> None: ...

class Delay(SISO):
    """Transport delay by the Pade approximation of order n: y(t) ~ u(t - T).

    exp(-T s) ~ (1 - h)/(1 + h), where h is Lambert's continued fraction of tanh(T s/2) cut after n
    terms, q/(1 + q^2/(3 + q^2/(5 + ...))) with q = T s/2: a ladder of n stages with one state each.

    Limits: the amplitude is exact at every frequency. The phase, for n = 5, lags too little by 2e-6 rad
    at omega T = n/2, 3e-3 rad at n and 0.6 rad at 2n: smooth signals are delayed well. A jump is not:
    y jumps at once by (-1)^n of it, then rings. The stages start at 0, as if u had been 0 before; to
    start with a constant u0 behind, fix `stage1.x` at u0.

    Source: J. H. Lambert, Memoires sur quelques proprietes remarquables des quantites
    transcendentes (1768); MSL Blocks.Nonlinear.PadeDelay for the order and its limits.

    Args:
        T: delay [s], above 0.
        u: input, a number, a function of time or Sampled data.
        n: order: number of stages.
    """

    T: Any
    """delay [s], above 0"""
    n: Any
    """order: number of stages"""
    def __init__(
        self,
        *,
        T: ParameterValue,
        u: SignalValue = ...,
        n: int | np.integer[Any] = 5,
        **parts: Component,
    ) -> None: ...

class Derivative(SISO):
    """Derivative of a filtered input: y = k (u - x)/T with T x' = u - x, which is k s/(T s + 1).

    The state x starts at 0 unless something fixes it: a run from u = u0 begins with y = k u0/T.
    Fix the output, `start={"name.y": 0.0}`, and it begins with a filter at rest.

    Source: MSL Blocks.Continuous.Derivative.

    Args:
        T: time constant of the filter [s], above 0.
        u: input, a number, a function of time or Sampled data.
        k: gain.
        x: filtered input, fixed start value.
    """

    k: Any
    """gain"""
    T: Any
    """time constant of the filter [s], above 0"""
    x: Any
    """filtered input, fixed start value"""
    def __init__(
        self,
        *,
        T: ParameterValue,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
        x: Number = ...,
    ) -> None: ...

class Feedback(_OfTwo):
    """What is wanted less what is measured: y = u1 - u2.

    Source: MSL Blocks.Math.Feedback.

    Args:
        u1: first input, a number, a function of time or Sampled data.
        u2: second input, a number, a function of time or Sampled data.
    """

    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
    ) -> None: ...

class FirstOrder(SISO):
    """First-order lag: T y' + y = k u, with the state x = y.

    Source: MSL Blocks.Continuous.FirstOrder.

    Args:
        T: time constant [s], above 0.
        u: input, a number, a function of time or Sampled data.
        k: gain.
        x: state, fixed start value.
    """

    k: Any
    """gain"""
    T: Any
    """time constant [s], above 0"""
    x: Any
    """state, fixed start value"""
    def __init__(
        self,
        *,
        T: ParameterValue,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
        x: Number = ...,
    ) -> None: ...

class Gain(SISO):
    """Gain: y = k u.

    Source: MSL Blocks.Math.Gain.

    Args:
        u: input, a number, a function of time or Sampled data.
        k: gain.
    """

    k: Any
    """gain"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
    ) -> None: ...

class Hysteresis(SISO):
    """Two-point switch: y goes from 0 to 1 as u rises above uHigh, and back as u falls below uLow.

    It starts at 0, or at 1 if u is above uHigh there.

    Source: MSL Blocks.Logical.Hysteresis, whose y is Boolean.

    Args:
        u: input, a number, a function of time or Sampled data.
        uLow: input below which it switches off.
        uHigh: input above which it switches on, above uLow.
    """

    y: Any
    """whether it is on"""
    uLow: Any
    """input below which it switches off"""
    uHigh: Any
    """input above which it switches on, above uLow"""
    mode: Any
    """y = 0 or 1"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
        uLow: ParameterValue = 0.0,
        uHigh: ParameterValue = 1.0,
    ) -> None: ...

class Integrator(SISO):
    """Integral: y' = k u, with the state x = y.

    Source: MSL Blocks.Continuous.Integrator.

    Args:
        u: input, a number, a function of time or Sampled data.
        k: gain.
        x: state, fixed start value.
    """

    k: Any
    """gain"""
    x: Any
    """state, fixed start value"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
        x: Number = ...,
    ) -> None: ...

class LimPID(LimPI):
    """PID controller with limited output, anti-windup and weights of the setpoint.

    As `LimPI`, with Nd (e - x_d) added inside v, Td x_d' = Nd (e - x_d) and e = wd u_s - u_m.

    Source: MSL Blocks.Continuous.LimPID, controllerType PID.

    Args:
        k: gain, above 0.
        Ti: integral time [s], above 0.
        y_max: upper limit of the output.
        Td: derivative time [s], above 0.
        u_s: setpoint, a number, a function of time or Sampled data.
        u_m: measurement, a number, a function of time or Sampled data.
        y_min: lower limit of the output.
        Ni: anti-windup time over integral time, above 0.
        wp: weight of the setpoint in the proportional part, at least 0.
        Nd: derivative time over its filter's time constant, above 0.
        wd: weight of the setpoint in the derivative part, at least 0.
        x: integral part, fixed start value.
        v: output before the limits, fixed start value.
        x_d: input of the derivative part, filtered, fixed start value.
    """

    Td: Any
    """derivative time [s], above 0"""
    Nd: Any
    """derivative time over its filter's time constant, above 0"""
    wd: Any
    """weight of the setpoint in the derivative part, at least 0"""
    x_d: Any
    """input of the derivative part, filtered, fixed start value"""
    @property
    def rate(self) -> Any: ...
    def __init__(
        self,
        *,
        k: ParameterValue,
        Ti: ParameterValue,
        y_max: ParameterValue,
        Td: ParameterValue,
        u_s: SignalValue = ...,
        u_m: SignalValue = ...,
        y_min: ParameterValue = ...,
        Ni: ParameterValue = 0.9,
        wp: ParameterValue = 1.0,
        Nd: ParameterValue = 10.0,
        wd: ParameterValue = 0.0,
        x: Number = ...,
        v: Number = ...,
        x_d: Number = ...,
    ) -> None: ...

class Limiter(SISO):
    """Limits: y = min(max(u, y_min), y_max). Continuous, so it makes no event.

    Source: MSL Blocks.Nonlinear.Limiter.

    Args:
        y_max: upper limit.
        u: input, a number, a function of time or Sampled data.
        y_min: lower limit.
    """

    y_max: Any
    """upper limit"""
    y_min: Any
    """lower limit"""
    def __init__(
        self,
        *,
        y_max: ParameterValue,
        u: SignalValue = ...,
        y_min: ParameterValue = ...,
    ) -> None: ...

class Max(_OfTwo):
    """The larger of two signals: y = max(u1, u2). Continuous, so it makes no event.

    Source: MSL Blocks.Math.Max.

    Args:
        u1: first input, a number, a function of time or Sampled data.
        u2: second input, a number, a function of time or Sampled data.
    """

    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
    ) -> None: ...

class Min(_OfTwo):
    """The smaller of two signals: y = min(u1, u2). Continuous, so it makes no event.

    Source: MSL Blocks.Math.Min.

    Args:
        u1: first input, a number, a function of time or Sampled data.
        u2: second input, a number, a function of time or Sampled data.
    """

    def __init__(
        self,
        *,
        u1: SignalValue = ...,
        u2: SignalValue = ...,
    ) -> None: ...

class PI(SISO):
    """Proportional and integral: y = k (u + x) with T x' = u, which is k (1 + 1/(T s)).

    Source: MSL Blocks.Continuous.PI.

    Args:
        T: integral time [s], above 0.
        u: input, a number, a function of time or Sampled data.
        k: gain.
        x: integral part, fixed start value.
    """

    k: Any
    """gain"""
    T: Any
    """integral time [s], above 0"""
    x: Any
    """integral part, fixed start value"""
    def __init__(
        self,
        *,
        T: ParameterValue,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
        x: Number = ...,
    ) -> None: ...

class PID(SISO):
    """Proportional, integral and filtered derivative: k (1 + 1/(Ti s) + Td s/(1 + Td s/Nd)).

    Source: MSL Blocks.Continuous.PID.

    Args:
        Ti: integral time [s], above 0.
        Td: derivative time [s], above 0.
        u: input, a number, a function of time or Sampled data.
        k: gain.
        Nd: derivative time over its filter's time constant, above 0.
        x: integral part, fixed start value.
        filtered: input of the derivative part, filtered, fixed start value.
    """

    k: Any
    """gain"""
    Ti: Any
    """integral time [s], above 0"""
    Td: Any
    """derivative time [s], above 0"""
    Nd: Any
    """derivative time over its filter's time constant, above 0"""
    x: Any
    """integral part, fixed start value"""
    filtered: Any
    """input of the derivative part, filtered, fixed start value"""
    def __init__(
        self,
        *,
        Ti: ParameterValue,
        Td: ParameterValue,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
        Nd: ParameterValue = 10.0,
        x: Number = ...,
        filtered: Number = ...,
    ) -> None: ...

class Periodic(Source):
    """What signals with a period have: the number of periods begun, constant between events."""

    amplitude: Any
    """height above the offset"""
    period: Any
    """period [s], above 0"""
    offset: Any
    """value between the pulses"""
    start_time: Any
    """when the first period begins [s]"""
    count: Any
    """periods begun, fixed start value"""
    @property
    def next_period(self) -> Any: ...
    @property
    def elapsed(self) -> Any: ...
    @property
    def begun(self) -> Any: ...
    def __init__(self, **values: Any) -> None: ...

class Ramp(Source):
    """A ramp: y = offset, then rising by height within duration, then offset + height.

    A duration of 0 makes it a step.

    Source: MSL Blocks.Sources.Ramp.

    Args:
        duration: how long it rises [s], at least 0.
        height: height of the ramp.
        offset: value before the ramp.
        start_time: when it begins to rise [s].
    """

    height: Any
    """height of the ramp"""
    duration: Any
    """how long it rises [s], at least 0"""
    offset: Any
    """value before the ramp"""
    start_time: Any
    """when it begins to rise [s]"""
    mode: Any
    """before, on or after the slope"""
    def __init__(
        self,
        *,
        duration: ParameterValue,
        height: ParameterValue = 1.0,
        offset: ParameterValue = 0.0,
        start_time: ParameterValue = 0.0,
    ) -> None: ...

class SampleHold(SISO):
    """Sampler: u is read at start_time + k period, and put out after a delay, to be held until the next is.

    Before the first sample y is y_0. Each sample, and each delayed output, is an event.

    Limits: the delay must be shorter than the period; longer ones are several blocks one after the other.

    Source: MSL Blocks.Discrete.Sampler, and with a delay UnitDelay.

    Args:
        period: time between samples [s], above 0.
        u: input, a number, a function of time or Sampled data.
        delay: from sample to output, shorter than the period [s], at least 0.
        start_time: time of the first sample [s].
        y_0: output before the first sample.
        count: samples taken, fixed start value.
        sample: sample taken last, fixed start value.
        held: what is put out, less y_0, fixed start value.
    """

    period: Any
    """time between samples [s], above 0"""
    delay: Any
    """from sample to output, shorter than the period [s], at least 0"""
    start_time: Any
    """time of the first sample [s]"""
    y_0: Any
    """output before the first sample"""
    state: Any
    """before the next sample, or before its output"""
    count: Any
    """samples taken, fixed start value"""
    sample: Any
    """sample taken last, fixed start value"""
    held: Any
    """what is put out, less y_0, fixed start value"""
    def __init__(
        self,
        *,
        period: ParameterValue,
        u: SignalValue = ...,
        delay: ParameterValue = 0.0,
        start_time: ParameterValue = 0.0,
        y_0: ParameterValue = 0.0,
        count: Number = ...,
        sample: Number = ...,
        held: Number = ...,
    ) -> None: ...

class SecondOrder(SISO):
    """Second-order lag: y'' + 2 D w y' + w^2 y = k w^2 u.

    Source: MSL Blocks.Continuous.SecondOrder.

    Args:
        w: angular frequency [rad/s], above 0.
        D: damping ratio, at least 0.
        u: input, a number, a function of time or Sampled data.
        k: gain.
        x: output, fixed start value.
        yd: rate of the output, fixed start value.
    """

    k: Any
    """gain"""
    w: Any
    """angular frequency [rad/s], above 0"""
    D: Any
    """damping ratio, at least 0"""
    x: Any
    """output, fixed start value"""
    yd: Any
    """rate of the output, fixed start value"""
    def __init__(
        self,
        *,
        w: ParameterValue,
        D: ParameterValue,
        u: SignalValue = ...,
        k: ParameterValue = 1.0,
        x: Number = ...,
        yd: Number = ...,
    ) -> None: ...

class Sign(SISO):
    """Sign: y = 1 for u > 0, -1 for u < 0; 0 where it begins at u = 0.

    Source: MSL Blocks.Math.Sign with generateEvent.

    Args:
        u: input, a number, a function of time or Sampled data.
    """

    y: Any
    """-1, 0 or 1"""
    mode: Any
    """sign of the input"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
    ) -> None: ...

class Sine(Source):
    """A sine: y = offset + amplitude sin(2 pi f (time - start_time) + phase).

    With `start_time` given, y = offset before it; without, the sine has always run and time counts
    from 0.

    Source: MSL Blocks.Sources.Sine.

    Args:
        f: frequency [Hz].
        amplitude: amplitude.
        phase: phase at start_time [rad].
        offset: mean.
        start_time: time [s] before which y = offset.
    """

    amplitude: Any
    """amplitude"""
    f: Any
    """frequency [Hz]"""
    phase: Any
    """phase at start_time [rad]"""
    offset: Any
    """mean"""
    start_time: Any
    """time [s] before which y = offset"""
    mode: Any
    """before or after start_time"""
    def __init__(
        self,
        *,
        f: ParameterValue,
        amplitude: ParameterValue = 1.0,
        phase: ParameterValue = 0.0,
        offset: ParameterValue = 0.0,
        start_time: Any = None,
    ) -> None: ...

class Step(Source):
    """A step: y = offset before start_time, offset + height from it on.

    Source: MSL Blocks.Sources.Step.

    Args:
        height: height of the step.
        offset: value before the step.
        start_time: time of the step [s].
    """

    height: Any
    """height of the step"""
    offset: Any
    """value before the step"""
    start_time: Any
    """time of the step [s]"""
    mode: Any
    """before or after the step"""
    def __init__(
        self,
        *,
        height: ParameterValue = 1.0,
        offset: ParameterValue = 0.0,
        start_time: ParameterValue = 0.0,
    ) -> None: ...

class TimeTable(Source):
    """A signal linear between the rows of a table; two rows of equal time make a jump.

    Before the first row y is the first value, after the last row the last one.

    Source: MSL Blocks.Sources.CombiTimeTable with extrapolation HoldLastPoint. For measured data,
    which wants no event at every sample, take `Sampled`.

    Args:
        table: rows (time [s], value), times not decreasing.
    """

    table: Any
    """rows (time [s], value), times not decreasing"""
    def slopes(self) -> Any: ...
    def __init__(
        self,
        *,
        table: Any = ...,
        **parts: Component,
    ) -> None: ...

class TransferFunction(SISO):
    """Transfer function: y = (b[0] s^m + ... + b[m])/(a[0] s^n + ... + a[n]) u, with m <= n.

    States in controller canonical form: a[0] x1' = u - a[1] x1 - ... - a[n] xn, xk' = x(k-1).

    Source: MSL Blocks.Continuous.TransferFunction, whose states are scaled.

    Example:
        >>> from inertance import signals
        >>> plant = signals.TransferFunction(b=(2.0, 3.0), a=(4.0, 5.0, 6.0))  # (2 s + 3)/(4 s^2 + 5 s + 6)

    Args:
        u: input, a number, a function of time or Sampled data.
        b: coefficients of the numerator, highest power first.
        a: coefficients of the denominator, highest power first.
    """

    b: Any
    """coefficients of the numerator, highest power first"""
    a: Any
    """coefficients of the denominator, highest power first"""
    def __init__(
        self,
        *,
        u: SignalValue = ...,
        b: Any = ...,
        a: Any = ...,
        **parts: Component,
    ) -> None: ...

class Pulse(Periodic):
    """Rectangular pulses: y = offset + amplitude for a share `width` of each period, else offset.

    Source: MSL Blocks.Sources.Pulse, where width is in percent.

    Args:
        period: period [s], above 0.
        amplitude: height above the offset.
        offset: value between the pulses.
        start_time: when the first period begins [s].
        width: share of the period at offset + amplitude, above 0, at most 1.
        count: periods begun, fixed start value.
    """

    width: Any
    """share of the period at offset + amplitude, above 0, at most 1"""
    mode: Any
    """between or in pulses"""
    def __init__(
        self,
        *,
        period: ParameterValue,
        amplitude: ParameterValue = 1.0,
        offset: ParameterValue = 0.0,
        start_time: ParameterValue = 0.0,
        width: ParameterValue = 0.5,
        count: Number = ...,
    ) -> None: ...

class Trapezoid(Periodic):
    """Trapezoidal pulses: y rises to offset + amplitude, stays, falls back and rests.

    rising, width and falling must fit into the period; a rise or fall of 0 s is a jump.

    Source: MSL Blocks.Sources.Trapezoid.

    Args:
        period: period [s], above 0.
        rising: how long it rises [s], at least 0.
        width: how long it stays at offset + amplitude [s], at least 0.
        falling: how long it falls [s], at least 0.
        amplitude: height above the offset.
        offset: value between the pulses.
        start_time: when the first period begins [s].
        count: periods begun, fixed start value.
    """

    rising: Any
    """how long it rises [s], at least 0"""
    width: Any
    """how long it stays at offset + amplitude [s], at least 0"""
    falling: Any
    """how long it falls [s], at least 0"""
    mode: Any
    """where in the period"""
    def __init__(
        self,
        *,
        period: ParameterValue,
        rising: ParameterValue,
        width: ParameterValue,
        falling: ParameterValue,
        amplitude: ParameterValue = 1.0,
        offset: ParameterValue = 0.0,
        start_time: ParameterValue = 0.0,
        count: Number = ...,
    ) -> None: ...
