"""`Change`: how the machine of a record had been changed, against the model of its campaign."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...base import is_number, shown, unit_for
from ...components import Component, ModelError, nearest
from ...networks import DAE, Network, load_component
from ..records.record import Channel
from .machine import Machine
from .problems import TABLE, TEXTS, Problems

KINDS = {"set": TABLE, "scale": TABLE, "remove": TEXTS, "exchange": TABLE}


@dataclass(frozen=True, eq=False)
class Change:
    """How the machine of a record had been changed: parameters and components of the model.

    Attributes:
        values: parameters that were set, in SI units.
        factors: parameters that were scaled, and by what.
        unscaled: what those are in the model.
        removed: paths of components that were taken out; what was joined at their ports stays joined.
        exchanged: components in the place of others, by path.
    """

    values: Mapping[str, float] = field(default_factory=dict)
    factors: Mapping[str, float] = field(default_factory=dict)
    unscaled: Mapping[str, float] = field(default_factory=dict)
    removed: tuple[str, ...] = ()
    exchanged: Mapping[str, Component] = field(default_factory=dict)

    @property
    def rebuilds(self) -> bool:
        """Whether it changes more than parameters."""
        return bool(self.removed or self.exchanged)

    def applied(self, network: Network) -> Network:
        """Return a copy of a network with its components changed; parameters are those of `given`.

        Raises:
            ModelError: for a component that is not there, or that others cannot be without.
        """
        copies = {path: component.clone() for path, component in self.exchanged.items()}
        return network.with_values(**copies).without(*self.removed)

    def replaces(self, path: str) -> str:
        """Return which component it removes or exchanges that a path lies in, "" if none."""
        whole = (part for part in (*self.removed, *self.exchanged) if f"{path}.".startswith(f"{part}."))
        return next(whole, "")

    def given(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """Return parameters of the model as they were after the change."""
        left = {path: value for path, value in parameters.items() if not self.replaces(path)}
        scaled = {path: left.get(path, self.unscaled[path]) * by for path, by in self.factors.items()}
        return left | scaled | dict(self.values)

    def told(self, machine: Machine) -> str:
        """Return it in words: `mass.m = 12 kg; spring.k times 2; without damper; another spring`."""
        parts = [f"{path} = {value:.6g} {machine.unit(path)}".rstrip() for path, value in self.values.items()]
        parts += [f"{path} times {factor:.6g}" for path, factor in self.factors.items()]
        parts += [f"without {path}" for path in self.removed]
        parts += [f"another {path}: {component!r}" for path, component in self.exchanged.items()]
        return "; ".join(parts)


def read_change(
    where: str,
    entry: Mapping[str, Any],
    network: Network,
    machine: Machine,
    channels: Mapping[str, Channel],
    unknown: Mapping[str, Any],
    base: Path,
    problems: Problems,
) -> Change | None:
    """Return what an entry of [[counterfactual]] says to change; None if anything is wrong with it.

    Args:
        where: what the entry is called.
        entry: its keys `set`, `scale`, `remove` and `exchange`.
        network: that of the campaign.
        machine: its equations, or an FMU.
        channels: what is measured.
        unknown: parameters of which each record has a value of its own.
        base: folder that paths start from.
        problems: where what is wrong is noted.
    """
    if not set(entry) & set(KINDS):
        problems.add(f"{where}: say what was changed: {', '.join(KINDS)}")
        return None
    removed, exchange = tuple(entry.get("remove", ())), entry.get("exchange", {})
    changed = machine
    if removed or exchange:
        before = len(problems.found)
        with problems.of(where):
            exchanged = {path: _component(path, given, base) for path, given in exchange.items()}
            change = Change(removed=removed, exchanged=exchanged)
            changed = _rebuilt(change, network, machine, channels)
        if len(problems.found) > before:
            return None
    else:
        change = Change()
    values, factors = entry.get("set", {}), entry.get("scale", {})
    told = [*_value_problems(values, changed), *_factor_problems(factors, values, changed, change, unknown)]
    if not problems.none(where, told):
        return None
    given = {path: _in_si(value, changed.unit(path)) for path, value in values.items()}
    scaled = {path: float(factor) for path, factor in factors.items()}
    unscaled = {path: changed.parameter_values[path] for path in factors}
    return Change(given, scaled, unscaled, change.removed, change.exchanged)


def _component(path: str, given: Any, base: Path) -> Component:
    """Return what takes the place of a component: given as one, or by the function that returns it."""
    if isinstance(given, str):
        return load_component(given, base, f'exchange."{path}"')
    if isinstance(given, Component):
        return given
    raise ModelError(
        f"exchange.\"{path}\" must be 'path/to/file.py:function' or a component, got {shown(given)}"
    )


def _rebuilt(change: Change, network: Network, machine: Machine, channels: Mapping[str, Channel]) -> Machine:
    """Return the machine with other components, once it is seen to have all channels."""
    if not isinstance(machine, DAE):
        raise ModelError(
            f"'{machine.name}' is an FMU, whose components cannot be removed or exchanged; set or scale its "
            "parameters, or make the change where the FMU is made"
        )
    rebuilt = change.applied(network).dae()
    for name, channel in channels.items():
        if not _is_there(channel, rebuilt):
            gone = change.replaces(channel.path) or "what is changed"
            raise ModelError(f"channel '{name}' is {channel.path}, which goes with '{gone}'; keep that part")
    return rebuilt


def _is_there(channel: Channel, machine: Machine) -> bool:
    """Tell whether a machine still has what a channel drives or measures."""
    if channel.driven:
        return channel.path in machine.input_names
    try:
        machine.expression(channel.path)
    except KeyError:
        return False
    return True


def _value_problems(values: Mapping[str, Any], machine: Machine) -> Iterator[str]:
    for path, value in values.items():
        where = f'set."{path}"'
        if path not in machine.parameter_values:
            yield f"{where}: {_unknown(path, machine)}"
        elif not (is_number(value) or isinstance(value, str)):
            yield f'{where} must be a number [{machine.unit(path)}] or a text such as "12 kg", got {value!r}'
        else:
            try:
                number = _in_si(value, machine.unit(path))
            except ModelError as error:
                yield f"{where}: {error}"
            else:
                if wrong := machine.field(path).problem(number):
                    yield f"{where}: {wrong}"


def _factor_problems(
    factors: Mapping[str, Any],
    values: Mapping[str, Any],
    machine: Machine,
    change: Change,
    unknown: Mapping[str, Any],
) -> Iterator[str]:
    for path, factor in factors.items():
        where = f'scale."{path}"'
        if path not in machine.parameter_values:
            yield f"{where}: {_unknown(path, machine)}"
        elif path in values:
            yield f"{where}: it is set, too; leave it out of one of both"
        elif change.replaces(path):
            yield f"{where}: '{change.replaces(path)}' is exchanged; give the new one that value"
        elif path in unknown:
            yield f"{where}: each record has a value of its own of it; set it"
        elif not is_number(factor):
            yield f"{where} must be a number, got {factor!r}"
        elif wrong := machine.field(path).problem(float(factor) * machine.parameter_values[path]):
            yield f"{where}: {wrong}"


def _unknown(path: str, machine: Machine) -> str:
    known = machine.parameter_values
    return f"the model, as it is changed, has no parameter '{path}' that can be set{nearest(path, known)}"


def _in_si(value: Any, unit: str) -> float:
    """Return a number in SI units, or what a text such as "12 kg" says."""
    if not isinstance(value, str):
        return float(value)
    number, _, given = value.strip().partition(" ")
    try:
        size = float(number)
    except ValueError:
        raise ModelError(f"'{value}' is no number with a unit, such as \"12 kg\"") from None
    return float(unit_for(given.strip(), unit).to_si(size)) if given else size
