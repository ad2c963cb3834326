"""Which equations have no finite value, or no finite slope, at a point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import casadi as ca
import numpy as np

from ..dae import DAE
from ..flattening.equations import local_arguments
from ..flattening.vectors import pick
from .bound_dae import BoundDAE
from .point import Point

UNSETTLED = "no consistent set of modes"
MOST_TOLD, MOST_SHOWN = 3, 120  # laws, and characters of one
GUARD = "`inertance docs write-your-own-component` says how to guard it"


def told_without_value(closed: BoundDAE, point: Point, ahead: float = 0.0) -> str:
    """Return a sentence that names inputs and equations without a finite value or slope at a point.

    It is empty if there are none. Inputs are looked at until `ahead` [s] later.
    """
    found = [*_inputs(closed, point, ahead), *_equations(closed, point)]
    more = f", and {len(found) - MOST_TOLD} more" if len(found) > MOST_TOLD else ""
    return "; ".join(found[:MOST_TOLD]) + more


def with_remedies(dae: DAE, told: str) -> str:
    """Return what went wrong with modes, and what the components named in it have to say to that."""
    found = [
        f"'{path}': {instance.component.unsettled}"
        for path, instance in dae.flat.instances.items()
        if instance.component.unsettled and UNSETTLED in told and f" '{path}'" in told
    ]
    return "; ".join([told, *found])


def _inputs(closed: BoundDAE, point: Point, ahead: float) -> Iterator[str]:
    times = np.array([point.t, point.t + ahead])
    values = closed.input_values(np.tile(point.q, (2, 1)), times)
    for declared, course in zip(closed.dae.inputs, values.T, strict=True):
        if not np.isfinite(course).all():
            k = int(np.argmin(np.isfinite(course)))
            name = "der(" * declared.order + declared.path + ")" * declared.order
            yield f"input '{name}' is {course[k]:g} at t = {times[k]:.6g} s"


def _equations(closed: BoundDAE, point: Point) -> Iterator[str]:
    dae, flat, t = closed.dae, closed.dae.flat, point.t
    q = point.q[: dae.constants.numel()]
    values = _values(closed, replace(point, q=closed.blank(q)))
    for group in flat.groups:
        template = group[0].template
        if not template.residuals:
            continue
        given, arguments = local_arguments(flat, group)
        numbers = ca.Function("given", [dae.constants], [arguments])(q).full()
        rows = [ca.vertcat(r, *s.values()) for r, s in zip(template.residuals, template.slopes, strict=True)]
        function = ca.Function("rows", [template.symbols, given, template.time], rows)
        for place, instance in enumerate(group):
            found = [flat.joined.find(instance.base + k) for k in range(len(template.variables))]
            local = np.array([sign * values[root] for root, sign in found])
            results = function.call([np.where(np.isfinite(local), local, 1.0), numbers[:, place], t])
            for residual, result in zip(template.residuals, results, strict=True):
                value, *slopes = np.isfinite(result.full().ravel())
                if not (value and all(slopes)):
                    law = f"{residual} == 0"
                    law = law if len(law) <= MOST_SHOWN else f"{law[:MOST_SHOWN]} ..."
                    what = f"finite {'slope' if value else 'value'} of `{law}`"
                    yield f"{instance} has no {what} there{_at(template, residual, local)}"


def _values(closed: BoundDAE, point: Point) -> dict[int, float]:
    """Return every joined variable of a component, not finite where its equation has no value."""
    flat = closed.dae.flat
    count = sum(len(group) * len(group[0].template.variables) for group in flat.groups)
    roots = sorted({flat.joined.find(number)[0] for number in range(count)})
    function = closed.function("variables", closed.close(pick(closed.dae.variables, roots)))
    values = function(point.x, point.z, point.q, point.t).full().ravel()
    return dict(zip(roots, values.tolist(), strict=True))


def _at(template: Any, residual: Any, local: Any) -> str:
    used = {symbol.name() for symbol in ca.symvar(residual)}
    told = [
        f"{name} = {local[k]:.4g}"
        for name, k in template.place.items()
        if name in used and np.isfinite(local[k])
    ]
    return f" ({', '.join(told[:4])})" if told else ""
