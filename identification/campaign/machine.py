"""The model of a campaign: what is asked of it, and how it is read."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from ...base import shown
from ...components import ModelError
from ...components.language import Parameter
from ...networks import Input, Network, load_model


class Machine(Protocol):
    """What a campaign asks of a model: names, units and parameters. A `DAE` is one.

    `inputs` are external signals and those of their derivatives that are needed, `parameter_values` hold all
    that can be set. The unit of what has none is empty. `expression` returns what can be measured under a
    name; a KeyError tells the nearest name if nothing can.
    """

    @property
    def name(self) -> str: ...
    @property
    def inputs(self) -> Sequence[Input]: ...
    @property
    def input_names(self) -> list[str]: ...
    @property
    def parameter_values(self) -> dict[str, float]: ...
    def names(self) -> Iterable[str]: ...
    def unit(self, path: str) -> str: ...
    def field(self, path: str) -> Parameter: ...
    def expression(self, path: str) -> Any: ...


Reader = Callable[[Network | str, Mapping[str, str], Path, bool], tuple[Network, Machine]]
"""What returns the network of a campaign and what predicts its outputs: of (model, port, base, validate)."""


def fmu_and_kind(model: Network | str) -> tuple[str, str] | None:
    """Return the parts of `path/to/file.fmu` or `path/to/file.fmu:kind`; None for another model."""
    found = re.fullmatch(r"(.*?\.fmu)(?::(.*))?", model) if isinstance(model, str) else None
    return (found[1], found[2] or "") if found else None


def read_network(
    model: Network | str, port: Mapping[str, str], base: Path, validate: bool = True
) -> tuple[Network, Machine]:
    """Return the network of a campaign, and its equations: the `Reader` of what is no FMU.

    Raises:
        ModelError: telling what is wrong; for an FMU, what can be done with it.
    """
    if fmu_and_kind(model):
        raise ModelError(
            f"'{model}' is an FMU, whose equations are not known; `inertance diagnose` fits its parameters, "
            'too; in Python, diagnose("campaign.toml"), or diagnose() of a Campaign made with '
            "reader=inertance.diagnosis.read_model"
        )
    if port:
        raise ModelError("[port] is for a model that is an FMU; a network has its flanges")
    network = load_model(model, base) if isinstance(model, str) else model
    if not isinstance(network, Network):
        raise ModelError(f"a Network or 'path/to/file.py:function' is needed, got {shown(network)}")
    return network, network.dae()
