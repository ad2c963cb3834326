"""What numbers cannot be computed: told in words."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from .errors import SimulationError


@contextmanager
def computing(what: str) -> Iterator[None]:
    """Let a singular matrix, an overflow or a division by zero within be a SimulationError that names `what`.

    Raises:
        SimulationError: for a `numpy.linalg.LinAlgError` and for an `ArithmeticError`.
    """
    try:
        yield
    except (np.linalg.LinAlgError, ArithmeticError) as error:
        told = f"{what} leads to numbers that cannot be computed with ({error})"
        raise SimulationError(
            f"{told}; look for values far from those of a machine in the model, its bounds and the records"
        ) from error
