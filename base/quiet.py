"""What others wrote, called with symbols: NumPy's functions work on them, those that want numbers say so."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import casadi as ca

_reading: ContextVar[bool] = ContextVar("functions are called with symbols", default=False)
_number = ca.SX.__float__


@contextmanager
def numpy_on_symbols() -> Iterator[None]:
    """Let `np.sin` and the like work on symbols without a warning; `math.sin`, which makes NaN, fails."""
    token = _reading.set(True)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FutureWarning)
            yield
    finally:
        _reading.reset(token)


def _float(symbol: Any) -> float:
    if _reading.get() and not symbol.is_constant():
        raise TypeError(
            "float() and Python's math functions take numbers, no symbols: write ca.sin or np.sin"
        )
    return float(_number(symbol))


ca.SX.__float__ = _float  # type: ignore[method-assign]
