"""The error of FMUs."""

from ..components import InertanceError


class FMUError(InertanceError, RuntimeError):
    """An FMU that cannot be read, run or written; says which, why, and what to do."""
