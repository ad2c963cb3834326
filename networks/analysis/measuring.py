"""Measures of a design, and what comes of those that fail."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from ...base import InertanceError, ModelError, number, shown
from ..dae import DAE

NO_VALUE = 1e30  # stands for a measure that has none


class Measure(Protocol):
    """What is to be small: a function of the equations and of changed parameters, such as `ride_j1`."""

    def __call__(self, dae: DAE, /, *, parameters: Mapping[str, float]) -> float:
        """Return the measure for some parameters."""
        ...


class BadMeasureError(ModelError):
    """A measure that raises an error of its own, or returns no number."""


def measured(measure: Measure, dae: DAE, parameters: Mapping[str, float], *, lenient: bool = False) -> float:
    """Return a measure for some parameters; if `lenient`, a large number where the library finds none.

    Raises:
        BadMeasureError: for a measure that raises an error of its own, or returns no number.
    """
    name = getattr(measure, "__name__", repr(measure))
    try:
        found = measure(dae, parameters=parameters)
    except (InertanceError, np.linalg.LinAlgError) as error:
        if lenient and not isinstance(error, BadMeasureError):
            return NO_VALUE
        raise
    except Exception as error:
        told = ", ".join(f"{n} = {v:g}" for n, v in parameters.items())
        raise BadMeasureError(
            f"measure '{name}' failed at {told}: {type(error).__name__}: {error}"
        ) from error
    if number(found):
        raise BadMeasureError(f"measure '{name}' must return a number, got {shown(found)}")
    return found
