"""Where a network starts from by itself: states that agree with what is fixed, modes settled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .coverage import check_covered
from .dae import DAE
from .initial import wishes
from .run import Settings
from .simulate import started
from .stepper import Array, nominal_sizes


@dataclass(frozen=True, eq=False)
class Start:
    """Start values of states and algebraic unknowns, and the sizes of states."""

    x: Array
    z: Array
    nominal: Array


def starting_point(dae: DAE, inputs: Mapping[str, Any], start: Mapping[str, float]) -> Start:
    """Return where a run of a network begins at t = 0; see `DAE.simulate` for the arguments.

    Raises:
        InitialConditionError: for start values that contradict each other.
    """
    closed = dae.closed(inputs)
    check_covered(dae.name, closed.signals, 0.0, 0.0)
    numbers = dae.system.flat.table.values({})
    q = np.concatenate([numbers, np.zeros(closed.q.numel() - len(numbers))])
    settings = Settings(0.0, 1.0, 1.0, 1e-6, 1e-8, "auto", False)
    point = started(closed, settings, q, wishes(dae, start, {})).point
    return Start(point.x, point.z, nominal_sizes(dae, dae.states))
