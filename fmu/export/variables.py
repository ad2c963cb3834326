"""Interface: the scalar variables of an FMU, in the order of their value references."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from ...base import rate_unit
from ...networks import DAE, Input, Start, is_corner
from .dependencies import Dependencies, dependencies


@dataclass(frozen=True)
class Scalar:
    """One variable as FMI tells of it; `choices` are the names of an enumeration's values."""

    name: str
    reference: int
    causality: str = "local"
    variability: str = "continuous"
    initial: str | None = "calculated"
    start: float | None = None
    unit: str = ""
    doc: str = ""
    nominal: float | None = None
    least: float | None = None
    most: float | None = None
    derivative_of: int | None = None
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Interface:
    """All variables: time, states, rates, inputs, parameters, other variables, modes, indicators.

    `aims` are the references of start values that are no states.
    """

    scalars: list[Scalar]
    states: range
    rates: range
    indicators: range
    aims: list[int]
    jumps: bool
    dependencies: Dependencies = field(repr=False)

    @property
    def outputs(self) -> list[Scalar]:
        """What is published, in the order of value references."""
        return [s for s in self.scalars if s.causality == "output"]

    @property
    def initial_unknowns(self) -> list[int]:
        """References of what is computed during initialization."""
        moving = {*self.states, *self.rates, *(s.reference for s in self.outputs)}
        return sorted(s.reference for s in self.scalars if s.initial != "exact" and s.reference in moving)

    def scalar(self, name: str) -> Scalar:
        """Return a variable by name."""
        return next(s for s in self.scalars if s.name == name)


def interface(
    dae: DAE,
    start: Start,
    free: Sequence[int],
    names: Sequence[str],
    variables: Sequence[str],
    outputs: Iterable[str],
) -> Interface:
    """Gather the variables of an FMU.

    Args:
        dae: the equations.
        start: where it starts from.
        free: which of `dae.inputs` are inputs of the FMU.
        names: names of the states.
        variables: what is published besides states and modes.
        outputs: what of all this is an output.
    """
    count, parameters = len(names), dae.p.numel()
    first = _firsts(count, count, len(free), parameters, len(variables), dae.modes.numel())
    shown = frozenset(outputs)
    scalars = [Scalar("time", 0, "independent", initial=None, unit="s", doc="simulation time")]
    scalars += [_state(dae, name, first[0] + k, start, k, shown) for k, name in enumerate(names)]
    scalars += [_rate(dae, name, first[1] + k, first[0] + k) for k, name in enumerate(names)]
    scalars += [_input(dae, dae.inputs[place], first[2] + k) for k, place in enumerate(free)]
    scalars += [
        _parameter(dae, name, value, first[3] + k)
        for k, (name, value) in enumerate(dae.parameter_values.items())
    ]
    scalars += [_other(dae, name, first[4] + k, shown) for k, name in enumerate(variables)]
    scalars += [
        _mode(dae, k, first[5] + k, shown)
        for k, name in enumerate(dae.switching.mode_names)
        if not is_corner(name)
    ]
    scalars += [_indicator(dae, k, first[6] + k) for k in range(len(dae.switching.changes))]
    aims = _aimed(scalars, start)
    return Interface(
        scalars,
        range(first[0], first[1]),
        range(first[1], first[2]),
        range(first[6], first[6] + len(dae.switching.changes)),
        aims,
        any(c.resets or c.impulse is not None for c in dae.switching.changes),
        dependencies(dae, start, free, variables, first, aims),
    )


def _aimed(scalars: list[Scalar], start: Start) -> list[int]:
    """Give start values to the variables that have one and are no states; return their references."""
    place = {scalar.name: k for k, scalar in enumerate(scalars)}
    for aim in start.aims:
        k = place[aim.name]
        scalars[k] = replace(scalars[k], initial="exact" if aim.fixed else "approx", start=aim.value)
    return [scalars[place[aim.name]].reference for aim in start.aims]


def _firsts(*counts: int) -> list[int]:
    """Return the first value reference of each kind; time has 0."""
    firsts = [1]
    for count in counts:
        firsts.append(firsts[-1] + count)
    return firsts


def _causality(name: str, shown: frozenset[str]) -> str:
    return "output" if name in shown else "local"


def _state(dae: DAE, name: str, reference: int, start: Start, k: int, shown: frozenset[str]) -> Scalar:
    initial = "calculated" if k in start.led else "approx" if k in start.free else "exact"
    value = None if k in start.led else float(start.x[k])
    return Scalar(
        name, reference, _causality(name, shown), "continuous", initial, value, dae.unit(name),
        described(dae, name), nominal=float(start.nominal[k]),
    )  # fmt: skip


def _rate(dae: DAE, name: str, reference: int, state: int) -> Scalar:
    unit = rate_unit(dae.unit(name))
    return Scalar(f"der({name})", reference, unit=unit, doc=f"rate of {name}", derivative_of=state)


def _input(dae: DAE, declared: Input, reference: int) -> Scalar:
    name, unit, told = declared.path, declared.unit, described(dae, declared.path)
    if declared.order:
        order = "" if declared.order == 1 else f",{declared.order}"
        name, told = f"der({name}{order})", f"time derivative {declared.order} of {name}"
        unit = rate_unit(unit, declared.order)
    number = declared.signal if isinstance(declared.signal, int | float) and not declared.order else 0.0
    return Scalar(name, reference, "input", initial=None, start=float(number), unit=unit, doc=told)


def _parameter(dae: DAE, name: str, value: float, reference: int) -> Scalar:
    declared = dae.field(name)
    return Scalar(
        name, reference, "parameter", "tunable", "exact", value, declared.unit, declared.doc,
        least=declared.min if declared.above is None else declared.above, most=declared.max,
    )  # fmt: skip


def _other(dae: DAE, name: str, reference: int, shown: frozenset[str]) -> Scalar:
    return Scalar(name, reference, _causality(name, shown), unit=dae.unit(name), doc=described(dae, name))


def _mode(dae: DAE, k: int, reference: int, shown: frozenset[str]) -> Scalar:
    name, choices = dae.switching.mode_names[k], dae.switching.mode_values[k]
    return Scalar(name, reference, _causality(name, shown), "discrete", doc="mode", choices=choices)


def _indicator(dae: DAE, k: int, reference: int) -> Scalar:
    change = dae.switching.changes[k]
    name, values = dae.switching.mode_names[change.mode], dae.switching.mode_values[change.mode]
    told = f"rises above 0 where {name} goes from {values[change.source]} to {values[change.target]}"
    return Scalar(f"indicator[{k + 1}]", reference, doc=told)


def described(dae: DAE, path: str) -> str:
    """Return what the declaration of a variable says of it."""
    inner = path.removeprefix("der(").removesuffix(")")
    told = dae.declared.facts[dae.flat.variable(inner)].doc
    return told if inner == path else f"rate of {inner}"
