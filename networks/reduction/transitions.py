"""Switching: every transition of every mode in one list, its expressions in one vector."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import count
from typing import Any

import casadi as ca
import numpy as np

from ...components.language import Template
from ..flattening.equations import local_values
from ..flattening.flat import Instance
from ..flattening.vectors import column
from .pantelides import System


@dataclass(eq=False)
class Change:
    """One transition of one mode of one component; the integers point into `Switching.expressions`."""

    component: str
    mode: int
    source: int
    target: int
    indicator: int
    allowed: int | None = None
    resets: list[tuple[int, int, int]] = field(default_factory=list)
    impulse: int | None = None
    velocity: int = 0
    after: int = 0


@dataclass(eq=False)
class Switching:
    """All transitions.

    Attributes:
        changes: the transitions.
        expressions: SX vector of indicators, conditions, new values and velocities.
        mode_names: full name of each mode.
        mode_values: the names of its values.
        in_shock: per mode, the value that stands in for another while an impulse acts.
        impulse_names: full name of each impulse.
    """

    changes: list[Change]
    expressions: Any
    mode_names: list[str]
    mode_values: list[tuple[str, ...]]
    in_shock: list[dict[int, int]]
    impulse_names: list[str]


def switching(system: System, values: Any) -> Switching:
    """Collect the transitions of a network, in terms of its joined variables as `padded` returns them."""
    flat = system.flat
    mode_of = {(id(i), m.name): k for k, (i, m) in enumerate(flat.modes)}
    impulse_of = {(id(i), name): k for k, (i, name) in enumerate(flat.impulses)}
    changes: list[Change] = []
    expressions: list[Any] = []
    start = 0
    for group in flat.groups:
        template = group[0].template
        if not template.transitions:
            continue
        listed = _listed(template)
        every = np.arange(len(group))
        rows = local_values(flat, group, every, ca.vertcat(*listed), values)
        for instance, listing in zip(group, ca.horzsplit(rows), strict=True):
            expressions.append(listing)
            changes += _changes(system, instance, start, mode_of, impulse_of)
            start += len(listed)
    return Switching(
        changes,
        column(expressions),
        [f"{i.path}.{m.name}".lstrip(".") for i, m in flat.modes],
        [m.values for _, m in flat.modes],
        [{m.values.index(a): m.values.index(b) for a, b in m.in_shock.items()} for _, m in flat.modes],
        [f"{i.path}.{name}".lstrip(".") for i, name in flat.impulses],
    )


def _listed(template: Template) -> list[Any]:
    """Return the expressions of a template's transitions, in the order `_changes` counts them."""
    listed: list[Any] = []
    for transition in template.transitions:
        shock, allowed = transition.shock, transition.allowed
        listed += [transition.indicator, *([] if allowed is None else [allowed]), *transition.reset.values()]
        listed += [shock.velocity, shock.after] if shock is not None else []
    return [ca.SX(expression) for expression in listed]


def _changes(
    system: System,
    instance: Instance,
    start: int,
    mode_of: dict[tuple[int, str], int],
    impulse_of: dict[tuple[int, str], int],
) -> Iterator[Change]:
    place = count(start)
    template = instance.template
    shock_names = {id(symbol): name for name, symbol in template.impulses.items()}
    for transition in template.transitions:
        mode = mode_of[id(instance), transition.mode]
        change = Change(str(instance), mode, transition.source, transition.target, next(place))
        if transition.allowed is not None:
            change.allowed = next(place)
        for name in transition.reset:
            change.resets.append((*system.flat.joined.find(instance.index(name)), next(place)))
        if transition.shock is not None:
            change.impulse = impulse_of[id(instance), shock_names[id(transition.shock.impulse)]]
            change.velocity, change.after = next(place), next(place)
        yield change
