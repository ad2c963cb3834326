"""`Tie`: a parameter that follows another one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf, isclose
from typing import Any

from ...components import nearest
from ...components.language import parts_of
from ...networks import DAE, Network
from .machine import Machine
from .priors import least
from .problems import NUMBER, TEXT, Problems

SAME_VALUE = 1e-6
KINDS = {"share": TEXT, "ratio": NUMBER}


@dataclass(frozen=True)
class Tie:
    """A parameter of a network that is `ratio` times another one, `share`; `depth` is that of its component.

    It is the value of that parameter: a function of what encloses its component.
    """

    share: str
    ratio: float
    depth: int

    def __call__(self, scope: Any) -> Any:
        for _ in range(self.depth - 1):
            scope = scope._owner
        for name in self.share.split("."):
            scope = getattr(scope, name)
        return self.ratio * scope


def shares(entry: Any) -> bool:
    """Return whether an entry of [parameters] says to share the value of another one."""
    return isinstance(entry, Mapping) and "share" in entry


def read_ties(entries: Mapping[str, Any], machine: Machine, problems: Problems) -> dict[str, Tie]:
    """Return what [parameters] says to share the value of another parameter."""
    ties = {}
    for path, entry in entries.items():
        where = f'parameters."{path}"'
        if not shares(entry):
            continue
        sound = problems.sound(where, entry, KINDS)
        if sound and problems.none(where, _tie_problems(path, entry, entries, machine)):
            ties[path] = Tie(entry["share"], float(entry.get("ratio", 1.0)), path.count("."))
    return ties


def _tie_problems(
    path: str, entry: Mapping[str, Any], entries: Mapping[str, Any], machine: Machine
) -> Iterator[str]:
    known, shared = machine.parameter_values, entry["share"]
    if not isinstance(machine, DAE):
        yield "share is for the parameters of a network; give the FMU one parameter for both"
    elif path not in known:
        yield f"the model has no parameter '{path}'{nearest(path, known)}"
    elif shared not in known:
        yield f"share: the model has no parameter '{shared}'{nearest(shared, known)}"
    elif shared == path:
        yield "share names the parameter itself; name another one"
    elif shares(entries.get(shared)):
        yield f"share: '{shared}' itself shares '{entries[shared]['share']}'; name one that stands for itself"
    elif entry.get("ratio", 1.0) == 0:
        yield "ratio must not be 0; leave the parameter out, and give it in the model"


def tied(network: Network, ties: Mapping[str, Tie]) -> Network:
    """Return a copy of a network in which parameters follow others."""
    copy = network.clone()
    for path, tie in ties.items():
        *owners, name = path.split(".")
        component: Any = copy
        for owner in owners:
            component = parts_of(component)[owner]
        setattr(component, name, tie)
    return copy


def limits_of(ties: Mapping[str, Tie], machine: Machine) -> dict[str, tuple[float, float]]:
    """Return, by parameter, the range that those that share it leave it."""
    limits: dict[str, tuple[float, float]] = {}
    for path, tie in ties.items():
        field = machine.field(path)
        low, high = (end / tie.ratio for end in (least(field), inf if field.max is None else field.max))
        before = limits.get(tie.share, (-inf, inf))
        limits[tie.share] = max(before[0], min(low, high)), min(before[1], max(low, high))
    return limits


def changes(ties: Mapping[str, Tie], machine: Machine) -> Iterator[str]:
    """Yield parameters that have other values in the model, as it is without ties, than those they share."""
    values = machine.parameter_values
    for path, tie in ties.items():
        before, now = values[path], tie.ratio * values[tie.share]
        if not isclose(before, now, rel_tol=SAME_VALUE):
            yield f"{path}: begins at {now:.6g} {machine.unit(path)}, with {tie.share}, not at {before:.6g}"
