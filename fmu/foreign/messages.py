"""What FMUs say: of FMI 2, one function of a process hears all instances and passes each its own."""

from __future__ import annotations

import ctypes
from itertools import count
from typing import Any, Protocol
from weakref import WeakValueDictionary


class Hearer(Protocol):
    """Who takes the messages of an instance."""

    def hear(self, *told: Any) -> None:
        """Take what an FMU told: its environment, name, status, category and message."""
        ...


_HEARERS: WeakValueDictionary[int, Hearer] = WeakValueDictionary()
_KEYS = count(1)
_HEARING: list[Any] = []


def _pass_on(environment: Any, *told: Any) -> None:
    from fmpy.fmi1 import printLogMessage

    hearer = _HEARERS.get(environment or 0)
    if hearer is not None:
        hearer.hear(environment, *told)
    elif not environment:  # of an instance that others made
        printLogMessage(environment, *told)


def callbacks_for(hearer: Hearer) -> Any:
    """Return the callback functions of an instance of FMI 2.

    FMPy formats messages with their values, but in the whole process hands them to the function that it
    was given last, whether that still lives or not; so it is always given the same one.
    """
    from fmpy.fmi2 import (
        calloc,
        fmi2CallbackAllocateMemoryTYPE,
        fmi2CallbackFreeMemoryTYPE,
        fmi2CallbackFunctions,
        fmi2CallbackLoggerTYPE,
        free,
    )
    from fmpy.logging import addLoggerProxy

    if not _HEARING:
        _HEARING.append(fmi2CallbackLoggerTYPE(_pass_on))
    key = next(_KEYS)
    _HEARERS[key] = hearer
    callbacks = fmi2CallbackFunctions(
        logger=_HEARING[0],
        allocateMemory=fmi2CallbackAllocateMemoryTYPE(calloc),
        freeMemory=fmi2CallbackFreeMemoryTYPE(free),
        componentEnvironment=key,
    )
    addLoggerProxy(ctypes.byref(callbacks))
    return callbacks
