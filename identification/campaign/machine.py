"""The model of a campaign: what is asked of it, and how it is read."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from ...base import shown
from ...components import ModelError
from ...components.language import Parameter
from ...networks import Input, Network, load_model


class Machine(Protocol):
    """What a campaign asks of a model: names, units and parameters. A `DAE` is one."""

    @property
    def name(self) -> str:
        """What it is called."""
        ...

    @property
    def inputs(self) -> Sequence[Input]:
        """External signals and those of their derivatives that are needed."""
        ...

    @property
    def input_names(self) -> list[str]:
        """Full names of the external signals."""
        ...

    @property
    def parameter_values(self) -> dict[str, float]:
        """Every parameter that can be set, with its value."""
        ...

    def names(self) -> Iterable[str]:
        """Return the full names of all variables."""
        ...

    def unit(self, path: str) -> str:
        """Return the unit of a variable or parameter, empty if it has none."""
        ...

    def field(self, path: str) -> Parameter:
        """Return the declaration of a parameter."""
        ...

    def expression(self, path: str) -> Any:
        """Return what can be measured under a name; KeyError, with the nearest name, if nothing can."""
        ...


Reader = Callable[[Path, str, Mapping[str, str], bool], tuple[Network, Machine]]
READERS: dict[str, Reader] = {}
"""How models that are no Python are read, by their ending: (path, what of it, port, validate) -> both."""

RECOGNISERS: list[Callable[[Network], Machine | None]] = []
"""What recognises a network that is more than its equations, and returns what predicts it."""


def read_model(
    model: Network | str, port: Mapping[str, str], base: Path, validate: bool = True
) -> tuple[Network, Machine]:
    """Return the network of a campaign, and what predicts its outputs.

    Args:
        model: the network, `path/to/file.py:function` that returns it, or `path/to/file.fmu`.
        port: where other parts may be joined to a model that is no Python.
        base: the folder that a relative path starts from.
        validate: whether to refuse an FMU whose description its schema does not allow.

    Raises:
        ModelError: telling what is wrong.
    """
    file, _, part = model.partition(".fmu") if isinstance(model, str) else ("", "", "")
    if isinstance(model, str) and model == f"{file}.fmu{part}" and part[:1] in ("", ":"):
        if ".fmu" not in READERS:
            raise ModelError(
                f"'{model}' is an FMU, whose parameters `inertance diagnose` fits; in Python, import "
                "inertance.diagnosis before the campaign is made"
            )
        return READERS[".fmu"](base / f"{file}.fmu", part[1:], port, validate)
    if port:
        raise ModelError("[port] is for a model that is an FMU; a network has its flanges")
    network = load_model(model, base) if isinstance(model, str) else model
    if not isinstance(network, Network):
        raise ModelError(f"a Network or 'path/to/file.py:function' is needed, got {shown(network)}")
    machines = (recognise(network) for recognise in RECOGNISERS)
    return network, next((machine for machine in machines if machine is not None), None) or network.dae()
