"""Derived quantities: what follows from an element's variables, and costs nothing until it is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .fields import Field

KINETIC, POTENTIAL, LOSS_POWER, SUPPLY_POWER = "kinetic", "potential", "lossPower", "supplyPower"


@dataclass(eq=False)
class Derived(Field):
    """A quantity that is computed from variables, parameters and modes of an element: no unknown."""

    law: Callable[[Any], Any] = lambda _: 0.0


def derived(unit: str, doc: str, law: Callable[[Any], Any]) -> Any:
    """Declare a quantity that follows from variables of an element.

    Args:
        unit: SI unit.
        doc: what it is.
        law: a function of the element that returns it; it may use whatever equations may, but a `der` that
            they do not have.
    """
    return Derived(unit, doc, law)


def energy(law: Callable[[Any], Any]) -> Any:
    """Declare the energy [J] that an element stores, as its `kinetic` or its `potential`."""
    return Derived("J", "stored energy", law)


def dissipation(law: Callable[[Any], Any]) -> Any:
    """Declare the power [W] that an element turns into heat, as its `lossPower`."""
    return Derived("W", "dissipated power", law)


def supply(law: Callable[[Any], Any]) -> Any:
    """Declare the power [W] that an amplifier or actuator puts into an element, as its `supplyPower`."""
    return Derived("W", "power that comes in otherwise than through flanges", law)
