"""Families of equations: one form, many instances."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from ...base import Ints
from ...components.language import slopes_of
from .forms import Form
from .vectors import pick, pick_matrix, stacked

ZERO = -1


def padded(variables: Any) -> Any:
    """Return the SX vector of all variables with a zero after them."""
    return stacked(variables, ca.SX(0))


@dataclass(eq=False)
class Family:
    """N equations of one form.

    Its methods take some instances as rows in ascending order, and all variables as `padded` returns them.

    Args:
        form: the equation in local symbols.
        columns: (N, n), the variable each local symbol stands for, per instance.
        signs: (N, n), its sign.
        arguments: SX (k, N), what the form takes as given.
        label: names the component of an instance in messages.
    """

    form: Form
    columns: Ints
    signs: Ints
    arguments: Any
    label: Callable[[int], str]

    def __len__(self) -> int:
        return len(self.columns)

    def evaluate(self, expression: Any, rows: Ints, values: Any, time: Any) -> Any:
        """Return an expression of local symbols for some instances, as an SX row."""
        return self._called(self.form.function(expression), self.columns[rows], rows, values, time)

    def solved(self, pattern: tuple[int, ...], rows: Ints, values: Any, time: Any) -> Any | None:
        """Return what an unknown of some instances is by their equations, as an SX row.

        None if it is not linear, or if its slope depends on a mode. In `pattern` local symbols that are the
        unknown or its negative are 1 or -1, others 0.
        """
        slope = self.form.slope(pattern)
        if slope is None or self.form.is_hybrid(slope):
            return None
        columns = np.where(np.array(pattern) != 0, ZERO, self.columns[rows])
        return self._called(self.form.function(self.form.solution(slope)), columns, rows, values, time)

    def _called(self, function: Any, columns: Ints, rows: Ints, values: Any, time: Any) -> Any:
        """Return a function of (locals, given, time) for some instances."""
        chosen = pick_matrix(values, columns)
        negative = np.flatnonzero(self.signs[rows] < 0).tolist()
        if negative:
            chosen.nz[negative] = -chosen.nz[negative]
        given = self.arguments if len(rows) == len(self) else self.arguments[:, rows.tolist()]
        return function(chosen, given, time)

    def differentiated(self, rows: Ints, derivative_of: Callable[[int], tuple[int, int]]) -> Family:
        """Return the family of the time derivatives of some instances' residuals."""
        form, again, moved = self.form.differentiated()
        unique, inverse = np.unique(self.columns[rows][:, moved], return_inverse=True)
        found = np.array([derivative_of(c) for c in unique.tolist()], dtype=np.int64).reshape(-1, 2)
        of_rates = found[inverse.reshape(len(rows), len(moved))]
        return Family(
            form,
            np.hstack([self.columns[rows][:, again], of_rates[..., 0]]),
            np.hstack([self.signs[rows][:, again], self.signs[rows][:, moved] * of_rates[..., 1]]),
            self.arguments[:, rows.tolist()],
            lambda row: self.label(int(rows[row])),
        )

    def chosen(self, rows: Ints) -> Family:
        """Return the family of some instances."""
        return Family(
            self.form,
            self.columns[rows],
            self.signs[rows],
            self.arguments[:, rows.tolist()],
            lambda row: self.label(int(rows[row])),
        )


def sum_family(columns: ArrayLike, signs: ArrayLike, label: Callable[[int], str]) -> Family:
    """Return the equations that state that signed variables sum to zero."""
    numbers = np.array(columns, dtype=np.int64)
    rows, width = numbers.shape
    symbols = ca.SX.sym("term", width)
    form = Form(ca.sum1(symbols), symbols, slopes=[ca.SX(1)] * width)
    return Family(form, numbers, np.array(signs, dtype=np.int64), ca.SX(0, rows), label)


def without_duplicates(family: Family) -> list[Family]:
    """Return a family as families in whose equations every variable stands once.

    Two forces of a node that are equal and opposite cancel; left alone, they would count as unknowns.
    """
    ordered = np.sort(family.columns, axis=1)
    double = (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
    if not double.any():
        return [family]
    plain, rows = np.flatnonzero(~double), np.flatnonzero(double)
    first = np.array([[row.index(c) for c in row] for row in family.columns[rows].tolist()])
    turned = family.signs[rows] * np.take_along_axis(family.signs[rows], first, axis=1)
    forms, kind = np.unique(np.hstack([first, turned]), axis=0, return_inverse=True)
    half = forms.shape[1] // 2
    merged = [
        _merged(family, form[:half], form[half:], rows[kind.ravel() == k]) for k, form in enumerate(forms)
    ]
    return [*([family.chosen(plain)] if len(plain) else []), *merged]


def _merged(family: Family, first: Ints, turned: Ints, rows: Ints) -> Family:
    """Write each local symbol as its first double, turned or not, and drop what cancels."""
    form = family.form
    symbols = [form.locals[int(f)] * int(s) for f, s in zip(first, turned, strict=True)]
    residual = ca.substitute(form.residual, form.locals, ca.vertcat(*symbols))
    slopes = slopes_of(residual, form.locals)
    cancelled = [i for i in range(len(first)) if slopes[i].is_zero()]
    residual = ca.substitute(residual, pick(form.locals, cancelled), ca.DM.zeros(len(cancelled)))
    kept = [i for i in range(len(first)) if first[i] == i and i not in cancelled]
    part = family.chosen(rows)
    return replace(
        part,
        form=Form(residual, pick(form.locals, kept), form.given, form.modes, form.time),
        columns=part.columns[:, kept],
        signs=part.signs[:, kept],
    )
