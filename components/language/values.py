"""What users give to components, as types."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np

from .sampled import Sampled

Number: TypeAlias = float | np.floating[Any] | np.integer[Any] | Fraction
ParameterValue: TypeAlias = Number | Callable[[Any], Any]  # of what the component is a part of
SignalValue: TypeAlias = Number | Callable[[Any], Any] | Sampled  # of time
