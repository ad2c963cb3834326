"""NumPy functions on CasADi symbols, which CasADi warns of."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def numpy_on_symbols() -> Iterator[None]:
    """Let `np.sin` and the like work on symbols without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)
        yield
