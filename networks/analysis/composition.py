"""Parts of linear systems, and systems one after another."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ...base import ModelError, UnknownNameError, between, demand, instance, listed, nearest, shown, text
from .statespace import StateSpace


def part_of(system: StateSpace, pair: Any) -> StateSpace:
    """Return the part from some inputs to some outputs; see `StateSpace.__getitem__`."""
    if not isinstance(pair, tuple) or len(pair) != 2:
        raise ModelError(f"'{system.name}': a part is system[outputs, inputs], got [{shown(pair)}]")
    rows = [_place(system, "output", name) for name in listed("outputs", pair[0])]
    columns = [_place(system, "input", name) for name in listed("inputs", pair[1])]
    picked = np.ix_(rows, columns)
    D_s = [D[picked] for D in system.D_s]
    highest = max((order for order, D in enumerate(D_s, start=1) if D.any()), default=0)
    return replace(
        system, B=system.B[:, columns], C=system.C[rows], D=system.D[picked], D_s=tuple(D_s[:highest]),
        inputs=tuple(system.inputs[k] for k in columns), outputs=tuple(system.outputs[k] for k in rows),
        input_units=tuple(system.input_units[k] for k in columns),
        output_units=tuple(system.output_units[k] for k in rows),
        slopes={by: part_of(slope, pair) for by, slope in system.slopes.items()},
    )  # fmt: skip


def chained(system: StateSpace, after: StateSpace, output: int | str, name: str) -> StateSpace:
    """Return a system with one output passed through another; see `StateSpace.then`."""
    given = {"after": (after, instance(StateSpace)), "output": (output, instance(int, str))}
    demand("then()", **given, name=(name, text))
    row = _place(system, "output", output) if isinstance(output, str) else output
    demand("then()", output=(row, between(0, len(system.outputs) - 1)))
    if not (system.proper and after.proper):
        raise ModelError(f"'{system.name}': only proper systems are chained; take a derivative as the input")
    name = name or f"{system.outputs[row]} ({after.name})"
    n, added, of_row = len(system.A), len(after.A), [row]
    A = np.block([[system.A, np.zeros((n, added))], [after.B @ system.C[of_row], after.A]])
    B = np.vstack([system.B, after.B @ system.D[of_row]])
    C, D = np.hstack([system.C, np.zeros((len(system.C), added))]), system.D.copy()
    C[row], D[row] = np.hstack([after.D @ system.C[of_row], after.C]), after.D @ system.D[of_row]
    still = replace(after, A=np.zeros_like(after.A), C=np.zeros_like(after.C))
    slopes = {by: chained(slope, still, row, name) for by, slope in system.slopes.items()}
    outputs, units = list(system.outputs), list(system.output_units)
    outputs[row] = name
    if after.output_units != after.input_units:
        units[row] = after.output_units[0]
    return replace(
        system, A=A, B=B, C=C, D=D, outputs=tuple(outputs), output_units=tuple(units),
        states=(*system.states, *(f"{name}.{state}" for state in after.states)),
        state_units=(*system.state_units, *after.state_units), slopes=slopes,
    )  # fmt: skip


def _place(system: StateSpace, kind: str, name: str) -> int:
    known = system.outputs if kind == "output" else system.inputs
    if name not in known:
        raise UnknownNameError(f"'{system.name}' has no {kind} '{name}'{nearest(name, known)}")
    return known.index(name)
