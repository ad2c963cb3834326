"""The errors of the library, and the nearest name for a wrong one."""

from collections.abc import Iterable


class InertanceError(Exception):
    """Anything the library refuses or fails to do, told in words."""

    @property
    def headline(self) -> str:
        """The first line of what is told."""
        return str(self).partition("\n")[0]


class ModelError(InertanceError, ValueError):
    """A component or a network that cannot be turned into equations; lists every problem found."""

    def __init__(self, title: str, problems: Iterable[str] = ()) -> None:
        self.problems = list(problems)
        super().__init__("\n".join([title, *(f"  - {problem}" for problem in self.problems)]))


class UnknownNameError(InertanceError, KeyError):
    """A name that stands for nothing there; the message tells the nearest one."""

    def __str__(self) -> str:
        return str(self.args[0])


class UnknownPartError(InertanceError, AttributeError):
    """An attribute that a component does not have; the message tells the nearest one."""


class MissingPackageError(InertanceError, ModuleNotFoundError):
    """A package that is wanted for this and is not installed; the message tells how to install it."""


class MissingFileError(ModelError, FileNotFoundError):
    """A file or folder that is not there."""


class InitialConditionError(InertanceError, ValueError):
    """Start values that contradict the equations or each other."""


class SimulationError(InertanceError, RuntimeError):
    """A run that could not be finished; `result` holds what was computed before."""

    def __init__(self, message: str, result: object = None) -> None:
        self.result = result
        super().__init__(message)


def nearest(name: object, known: Iterable[str]) -> str:
    """Return `"; did you mean 'k'?"` for the known name closest to `name`, or nothing."""
    from difflib import get_close_matches

    if not isinstance(name, str):
        return ""
    by_folded = {other.lower(): other for other in known if other != name}
    matches = get_close_matches(name.lower(), list(by_folded), n=1)
    return f"; did you mean '{by_folded[matches[0]]}'?" if matches else ""
