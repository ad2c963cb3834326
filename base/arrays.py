"""Types of arrays, of numbers and of symbols."""

from typing import TypeAlias

import casadi as ca
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Flags = NDArray[np.bool_]
Ints = NDArray[np.int64]
Symbolic: TypeAlias = ca.SX
