"""What a public function of a network was given."""

from __future__ import annotations

from typing import Any

from ..base import ModelError, shown
from .dae import remedy_for
from .network import Network


def network_of(given: Network | Any) -> Network:
    """Return a network that was given.

    Raises:
        ModelError: for anything else.
    """
    if isinstance(given, Network):
        return given
    raise ModelError(f"a Network is needed, got {shown(given)}{remedy_for(given)}")
