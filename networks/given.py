"""What a public function of a network was given: a network, or its equations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..base import ModelError, shown
from ..components.language import Component
from .dae import DAE

if TYPE_CHECKING:
    from .network import Network


def dae_of(given: Network | DAE | Any) -> DAE:
    """Return the equations of a network, or those that were given; a ModelError is for anything else."""
    if isinstance(given, DAE):
        return given
    if _is_network(given):
        return given.dae()
    raise ModelError(f"a Network (or the DAE of one) is needed, got {shown(given)}{_remedy(given)}")


def network_of(given: Network | Any) -> Network:
    """Return a network that was given; a ModelError is for anything else."""
    if _is_network(given):
        return given
    raise ModelError(f"a Network is needed, got {shown(given)}{_remedy(given)}")


def element_of(given: Component | Any) -> Component:
    """Return a component that was given, which may be a network; a ModelError is for anything else."""
    if isinstance(given, Component):
        return given
    raise ModelError(f"a component is needed, got {shown(given)}{_remedy(given)}")


def _is_network(given: Any) -> bool:
    return isinstance(given, Component) and callable(getattr(type(given), "dae", None))


def _remedy(given: Any) -> str:
    if isinstance(given, Component):
        return "; put it into a Network and connect it"
    if isinstance(given, type) and issubclass(given, Component):
        return f"; give one, {given.__name__}(...), and not its class"
    return "; call the function that makes it" if callable(given) else ""
