"""Outputs: what an FMU shows of a network, and under which names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ...base import ModelError
from ...components.language import Field, Port, RealInput, RealOutput, fields_of
from ...networks import DAE, matching_signals


def state_names(dae: DAE, given: Iterable[str] = ()) -> list[str]:
    """Return a name for each state that has its sign; the one by which its start was given goes first."""
    names = dae.state_names
    place = {(variable, 1): k for k, variable in enumerate(dae.states)}
    for name in given:
        if (k := place.get(dae.root(name))) is not None:
            names[k] = name
    wrong = {
        v: k for k, (v, name) in enumerate(zip(dae.states, names, strict=True)) if dae.root(name) != (v, 1)
    }
    for name in dae.names() if wrong else ():
        root, sign = dae.root(name)
        if root in wrong and sign == 1:
            names[wrong.pop(root)] = name
    return names


def chosen_outputs(dae: DAE, outputs: Iterable[str] | None, states: Sequence[str]) -> list[str]:
    """Return the outputs asked for, else signals that go nowhere and what sensors measure, else the states.

    Raises:
        ModelError: for unknown names, with the nearest one.
    """
    if outputs is None:
        return _signals(dae) or list(states)
    try:
        chosen = matching_signals(dae, outputs)
    except KeyError as error:
        raise ModelError(f"outputs of the FMU: {error.args[0]}") from None
    numbers = [name for name in chosen if dae.parameters.at(name) is not None or name == "time"]
    if numbers:
        raise ModelError(f"'{numbers[0]}' is no variable that moves: it cannot be an output of the FMU")
    return chosen


def _signals(dae: DAE) -> list[str]:
    """Return signal outputs that are connected to nothing or come from a sensor, each once."""
    taken: set[int] = set()
    offered: dict[int, str] = {}
    measured: dict[int, str] = {}
    instances = dae.flat.instances.items()
    for path, instance in sorted(instances, key=lambda item: item[0].count(".")):
        fields = fields_of(instance.component, Field)
        sensor = any(isinstance(f, Port) for f in fields) and not any(
            isinstance(f, RealInput) for f in fields
        )
        for declared in fields:
            name = f"{path}.{declared.name}" if path else declared.name
            if isinstance(declared, RealInput):
                taken.add(dae.root(name)[0])
            elif isinstance(declared, RealOutput):
                (measured if sensor else offered).setdefault(dae.root(name)[0], name)
    loose = {root: name for root, name in offered.items() if root not in taken and root not in measured}
    return [*measured.values(), *loose.values()]


def locals_of(dae: DAE, shown: Iterable[str]) -> list[str]:
    """Return the declared variables that are not shown yet, each joined variable once."""
    names = dae.declared
    moving = [name for name in shown if name not in dae.switching.mode_names and not dae.derived.unit(name)]
    seen = {dae.root(name)[0] for name in moving}
    seen |= {declared.variable for declared in dae.inputs}
    best = [number for root, number in names.best.items() if root not in seen]
    found = (names.full_name(number) for number in best if names.facts[number].rank >= 2)
    return [name for name in found if not name.startswith("der(")]
