"""Interface: the scalar variables of an FMU, in the order of their value references."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate

from ...base import rate_unit
from ...networks import DAE, Input, Start, is_corner
from .dependencies import Dependencies, dependencies
from .signal_types import type_of_input, type_of_variables


@dataclass(frozen=True)
class Scalar:
    """One variable as FMI tells of it.

    Attributes:
        type: "Real", "Boolean", "Integer" or "Enumeration", the values of which have the names `choices`.
    """

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
    type: str = "Real"
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


def interface(
    dae: DAE,
    start: Start,
    free: Sequence[int],
    names: Sequence[str],
    variables: Sequence[str],
    outputs: Iterable[str],
) -> Interface:
    """Gather the variables of an FMU: states by `names`, the inputs `free` among those of the network."""
    modes, changes, shown = dae.switching.mode_names, dae.switching.changes, frozenset(outputs)
    values = dae.parameter_values
    counts = (len(names), len(names), len(free), len(values), len(variables), len(modes), len(changes))
    first = list(accumulate(counts, initial=1))  # value reference of each kind; time has 0
    scalars = [Scalar("time", 0, "independent", initial=None, unit="s", doc="simulation time")]
    scalars += [_state(dae, name, first[0] + k, start, k) for k, name in enumerate(names)]
    scalars += [_rate(dae, name, first[1] + k, first[0] + k, names) for k, name in enumerate(names)]
    scalars += [_input(dae, dae.inputs[place], first[2] + k) for k, place in enumerate(free)]
    scalars += [_parameter(dae, name, value, first[3] + k) for k, (name, value) in enumerate(values.items())]
    told = type_of_variables(dae)
    scalars += [_other(dae, name, first[4] + k, told(name)) for k, name in enumerate(variables)]
    scalars += [_mode(dae, k, first[5] + k) for k, name in enumerate(modes) if not is_corner(name)]
    scalars += [_indicator(dae, k, first[6] + k) for k in range(len(changes))]
    scalars = [
        replace(s, causality="output") if s.name in shown and s.causality == "local" else s for s in scalars
    ]
    aims = _aimed(scalars, start)
    return Interface(
        scalars,
        range(first[0], first[1]),
        range(first[1], first[2]),
        range(first[6], first[7]),
        aims,
        any(c.resets or c.impulse is not None for c in changes),
        dependencies(dae, start, free, variables, first, aims),
    )


def _aimed(scalars: list[Scalar], start: Start) -> list[int]:
    """Give start values to the variables that have one and are no states; return their references."""
    place = {scalar.name: k for k, scalar in enumerate(scalars)}
    for aim in start.aims:
        k = place[aim.name]
        scalars[k] = replace(scalars[k], initial="exact" if aim.fixed else "approx", start=aim.value)
    return [scalars[place[aim.name]].reference for aim in start.aims]


def _state(dae: DAE, name: str, reference: int, start: Start, k: int) -> Scalar:
    initial = "calculated" if k in start.led else "approx" if k in start.free else "exact"
    value = None if k in start.led else float(start.x[k])
    return Scalar(
        name, reference, initial=initial, start=value, unit=dae.unit(name), doc=_described(dae, name),
        nominal=float(start.nominal[k]),
    )  # fmt: skip


def _rate(dae: DAE, name: str, reference: int, state: int, states: Sequence[str]) -> Scalar:
    unit, told = rate_unit(dae.unit(name)), f"der({name})"
    told = f"der({name},1)" if told in states else told  # which is a state itself, and another variable
    return Scalar(told, reference, unit=unit, doc=f"rate of {name}", derivative_of=state)


def _input(dae: DAE, declared: Input, reference: int) -> Scalar:
    name, unit, told = declared.path, declared.unit, _described(dae, declared.path)
    if declared.order:
        order = "" if declared.order == 1 else f",{declared.order}"
        name, told = f"der({name}{order})", f"time derivative {declared.order} of {name}"
        unit = rate_unit(unit, declared.order)
    if (kind := type_of_input(dae, declared)) != "Real":
        number = float(resting(declared) > 0.5)
        return Scalar(name, reference, "input", "discrete", None, number, doc=told, type=kind)
    number = 0.0 if declared.order else resting(declared)
    return Scalar(name, reference, "input", initial=None, start=number, unit=unit, doc=told)


def resting(declared: Input) -> float:
    """Return the value that a free input starts from."""
    return float(declared.signal) if isinstance(declared.signal, int | float) else 0.0


def _parameter(dae: DAE, name: str, value: float, reference: int) -> Scalar:
    declared = dae.field(name)
    return Scalar(
        name, reference, "parameter", "tunable", "exact", value, declared.unit, declared.doc,
        least=declared.min if declared.above is None else declared.above, most=declared.max,
    )  # fmt: skip


def _other(dae: DAE, name: str, reference: int, kind: str) -> Scalar:
    if kind != "Real":
        return Scalar(name, reference, variability="discrete", doc=_described(dae, name), type=kind)
    return Scalar(name, reference, unit=dae.unit(name), doc=_described(dae, name))


def _mode(dae: DAE, k: int, reference: int) -> Scalar:
    name, choices = dae.switching.mode_names[k], dae.switching.mode_values[k]
    return Scalar(name, reference, variability="discrete", doc="mode", type="Enumeration", choices=choices)


def _indicator(dae: DAE, k: int, reference: int) -> Scalar:
    change = dae.switching.changes[k]
    name, values = dae.switching.mode_names[change.mode], dae.switching.mode_values[change.mode]
    told = f"rises above 0 where {name} goes from {values[change.source]} to {values[change.target]}"
    return Scalar(f"indicator[{k + 1}]", reference, doc=told)


def _described(dae: DAE, path: str) -> str:
    """Return what the declaration of a variable says of it."""
    if dae.derived.unit(path) is not None:
        return dae.derived.doc(path)
    inner = path.removeprefix("der(").removesuffix(")")
    told = dae.declared.facts[dae.flat.variable(inner)].doc
    return told if inner == path else f"rate of {inner}"
