"""Duplicates: a variable that joining made stand twice in one equation is written once.

Two forces of a node that are equal and opposite cancel; left alone, they would count as unknowns.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np

from ...base import Ints
from .families import Family
from .forms import Form
from .vectors import pick


def without_duplicates(family: Family) -> list[Family]:
    """Return a family as families in whose equations every variable stands once."""
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
    slopes = ca.densify(ca.jacobian(residual, form.locals))
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
