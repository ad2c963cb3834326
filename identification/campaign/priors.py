"""`Prior`: what is known of a parameter before the fit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...components import nearest
from ...components.language import Parameter
from .machine import Machine
from .problems import NUMBER, TEXT, Problems

LARGEST_NUMBER = 1e60  # of a parameter, in SI units, whose powers are numbers, too
LEAST_REL = 1e-12  # that numbers resolve
PER_RECORD = "record"
RANGES = {"rel": NUMBER, "min": NUMBER, "max": NUMBER}
KINDS = {**RANGES, "per": TEXT}


@dataclass(frozen=True)
class Prior:
    """What is known of a parameter before the fit.

    Args:
        center: the value in the model.
        sd: standard deviation; infinite if only bounds are given.
        min, max: bounds.
    """

    center: float
    sd: float
    min: float
    max: float

    @property
    def scale(self) -> float:
        """A change of the parameter that counts."""
        if np.isfinite(self.sd):
            return self.sd
        width = self.max - self.min
        return 0.25 * width if np.isfinite(width) else abs(self.center) or 1.0

    @property
    def range(self) -> tuple[float, float]:
        """The bounds, as they are from the center in units of `scale`."""
        return (self.min - self.center) / self.scale, (self.max - self.center) / self.scale

    def at(self, share: float) -> float:
        """Return the value that is so many times `scale` from the center, within the bounds."""
        return min(max(self.center + share * self.scale, self.min), self.max)

    def moved(self, value: float) -> float:
        """Return how far a value is from the center in standard deviations, by difference or by ratio.

        By ratio since a thousandth of what was assumed is far off, but 2 deviations only if rel = 0.5.
        """
        away = abs(value - self.center) / self.sd
        if not away or not value * self.center > 0:
            return away
        by_ratio = abs(np.log(value / self.center)) / np.log1p(self.sd / abs(self.center))
        return float(max(away, by_ratio)) if abs(value) < abs(self.center) else away


def read_priors(
    entries: Mapping[str, Any],
    machine: Machine,
    limits: Mapping[str, tuple[float, float]],
    problems: Problems,
) -> dict[str, Prior]:
    """Return what is known of the uncertain parameters, within the limits that some have beside their own."""
    values = machine.parameter_values
    priors: dict[str, Prior] = {}
    for path, entry in entries.items():
        where = f'parameters."{path}"'
        if path not in values:
            problems.add(f"{where}: the model has no parameter '{path}'{nearest(path, values)}")
        elif not isinstance(entry, Mapping) or not set(entry) & set(RANGES):
            problems.add(f"{where}: give rel (relative standard deviation), or min and max")
        elif problems.sound(where, entry, KINDS):
            further = limits.get(path, (-np.inf, np.inf))
            priors[path] = _prior(machine.field(path), values[path], entry, further)
            problems.none(where, _prior_problems(priors[path], entry))
    return priors


def is_per_record(entry: Mapping[str, Any]) -> bool:
    """Return whether an entry of [parameters] is of a value that each record has of its own."""
    return entry.get("per") == PER_RECORD


def least(declared: Parameter, value: float = 0.0) -> float:
    """Return the least that a parameter may be; where it must be above that, by a billionth of its value."""
    if declared.above is not None:
        return declared.above + 1e-9 * (abs(value) or 1.0)
    return -np.inf if declared.min is None else declared.min


def _prior(declared: Parameter, value: float, entry: Mapping[str, Any], limits: tuple[float, float]) -> Prior:
    sd = entry["rel"] * abs(value) if "rel" in entry else np.inf
    lowest = max(entry.get("min", -np.inf), least(declared, value), limits[0])
    highest = min(bound for bound in (entry.get("max"), declared.max, limits[1]) if bound is not None)
    return Prior(value, sd, lowest, highest)


def _prior_problems(prior: Prior, entry: Mapping[str, Any]) -> Iterator[str]:
    if "per" in entry and not is_per_record(entry):
        yield (
            f'per is "{PER_RECORD}", for a value that each record has of its own, got {entry["per"]!r}; '
            "leave it out for one of all records"
        )
    rel = entry.get("rel", 1.0)
    if rel <= 0:
        yield f"rel must be above 0, got {rel:g}"
    elif rel < LEAST_REL:
        yield f"rel {rel:g} leaves no freedom; leave out what is known, or give at least {LEAST_REL:g}"
    elif "rel" in entry and prior.center == 0:
        yield "rel of a value that is 0 leaves no freedom; give min and max"
    for name, value in {"rel": prior.sd, "min": prior.min, "max": prior.max}.items():
        if name in entry and abs(value) > LARGEST_NUMBER:
            yield f"{name} {entry[name]:g} is beyond any machine; give what the parameter may be"
    if not prior.min < prior.max:
        yield f"min {prior.min:g} must be below max {prior.max:g}"
    elif not prior.min <= prior.center <= prior.max:
        yield f"the model's value {prior.center:g} is outside {prior.min:g} to {prior.max:g}"
