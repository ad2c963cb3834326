"""The channels of a campaign, and their stated noise: read, and checked against its model."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

from ...base import is_number, unit_for
from ...components import nearest
from ...components.language import INTERPOLATIONS
from ..records.record import Channel, outputs_of
from .machine import Machine
from .problems import NUMBER, TEXT, Problems

KINDS = {"input": TEXT, "output": TEXT, "unit": TEXT, "interpolation": TEXT, "delay": NUMBER}


def read_channels(entries: Mapping[str, Any], machine: Machine, problems: Problems) -> dict[str, Channel]:
    """Return the channels; every input that has no signal needs one."""
    channels: dict[str, Channel] = {}
    before = len(problems.found)
    for name, entry in entries.items():
        where = f"channels.{name}"
        if not isinstance(entry, Mapping) or ("input" in entry) == ("output" in entry):
            problems.add(f'{where}: give either input = "path" or output = "path"')
        elif problems.sound(where, entry, KINDS):
            with problems.of(where):
                channel = _channel(entry, machine)
                if problems.none(where, _channel_problems(channel, channels, machine)):
                    unit_for(channel.unit, channel.si)
                    channels[name] = channel
    problems.add(*_missing(entries, channels, machine))
    if not outputs_of(channels) and len(problems.found) == before:
        problems.add("channels: no output is measured, so there is nothing to compare")
    return channels


def _channel(entry: Mapping[str, Any], machine: Machine) -> Channel:
    driven = "input" in entry
    path = entry["input"] if driven else entry["output"]
    known = machine.names() if not driven or path in machine.input_names else ()
    si = machine.unit(path) if path in known else ""
    interpolation, delay = entry.get("interpolation", "cubic"), float(entry.get("delay", 0.0))
    return Channel(path, driven, entry.get("unit", si), si, interpolation, delay)


def _channel_problems(channel: Channel, others: Mapping[str, Channel], machine: Machine) -> Iterator[str]:
    path = channel.path
    if channel.driven and path not in machine.input_names:
        known = machine.input_names
        told = nearest(path, known) or f"; the inputs are {', '.join(known) or 'none'}"
        yield f"the model has no input '{path}'{told}"
        return
    if not channel.driven:
        machine.expression(path)
    if path == "time":
        yield "'time' is what records are told by, and no sensor measures it; give a motion or a force"
    if path in machine.parameter_values:
        yield f"'{path}' is a parameter, which no sensor measures; give a motion or a force"
    if channel.interpolation not in INTERPOLATIONS:
        known_ones = " or ".join(f"'{one}'" for one in INTERPOLATIONS)
        yield f"interpolation is {known_ones}, got '{channel.interpolation}'"
    if channel.held and any(i.path == path and i.order for i in machine.inputs):
        yield (
            "the model needs the derivative of what jumps here from sample to sample; let the command act "
            "as a signal in a law of force, or follow it by a Position with exact=False"
        )
    if channel.delay and not channel.driven:
        yield f"delay is of an input, got {channel.delay:g} s for an output; shift its column instead"
    for name, other in others.items():
        if other.path == path and channel.driven and other.driven:
            yield f"'{path}' is driven by channel '{name}' already; keep one of them"
        elif other.path == path and channel.driven != other.driven:
            yield f"'{path}' is channel '{name}' already, once as input and once as output; keep one of them"


def _missing(entries: Mapping[str, Any], channels: Mapping[str, Channel], machine: Machine) -> Iterator[str]:
    """Yield inputs that nothing drives, unless a faulty channel was meant to."""
    meant = {str(entry.get("input")) for entry in entries.values() if isinstance(entry, Mapping)}
    given = {channel.path for channel in channels.values() if channel.driven} | meant
    for declared in machine.inputs:
        if declared.order == 0 and declared.signal is None and declared.path not in given:
            yield f"channels: input '{declared.path}' [{declared.unit}] has no signal; measure it or bind it"


def read_noise(
    entries: Mapping[str, Any], channels: Mapping[str, Channel], declared: Collection[str], problems: Problems
) -> dict[str, float]:
    """Return the stated noise of output channels in SI units."""
    outputs = outputs_of(channels)
    stated = {}
    for name, value in entries.items():
        if name in declared and name not in channels:
            continue
        if name not in outputs:
            problems.add(f"noise.{name}: there is no output channel '{name}'{nearest(name, outputs)}")
        elif not is_number(value) or not float(value) > 0:
            problems.add(
                f"noise.{name}: the standard deviation must be above 0 {channels[name].unit}, got {value!r}"
            )
        else:
            stated[name] = float(value) * unit_for(channels[name].unit, channels[name].si).factor
    return stated
