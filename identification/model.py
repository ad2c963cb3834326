"""The model of a campaign: what is asked of it, and how it is read."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

from ..components import ModelError, nearest
from ..components.base import Parameter
from ..networks import Input, Network


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


Reader = Callable[[Path, str, Mapping[str, str]], tuple[Network, Machine]]
READERS: dict[str, Reader] = {}
"""How model files that are not Python are read, by their ending: (path, what of it, port) -> both."""

RECOGNISERS: list[Callable[[Network], Machine | None]] = []
"""What recognises a network that is more than its equations, and returns what predicts it."""


def read_model(model: Network | str, port: Mapping[str, str], base: Path) -> tuple[Network, Machine]:
    """Return the network of a campaign, and what predicts its outputs.

    Args:
        model: the network, `path/to/file.py:function` that returns it, or `path/to/file.fmu`.
        port: where other parts may be joined to a model that is no Python.
        base: the folder that a relative path starts from.

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
        return READERS[".fmu"](base / f"{file}.fmu", part[1:], port)
    if port:
        raise ModelError("[port] is for a model that is an FMU; a network has its flanges")
    network = load_model(model, base) if isinstance(model, str) else model
    machines = (recognise(network) for recognise in RECOGNISERS)
    return network, next((machine for machine in machines if machine is not None), None) or network.dae()


def load_model(model: str, base: Path) -> Network:
    """Return the network that a function of a Python file returns.

    Args:
        model: `path/to/file.py:function`.
        base: the folder that a relative path starts from.

    Raises:
        ModelError: telling what is wrong, with file and line.
    """
    file, _, name = model.rpartition(":")
    path = base / file
    if not file or path.suffix != ".py":
        raise ModelError(f"model is 'path/to/file.py:function', got '{model}'")
    if not path.is_file():
        others = [p.name for p in path.parent.glob("*.py")] if path.parent.is_dir() else []
        raise ModelError(f"model: there is no file '{path}'{nearest(path.name, others)}")
    try:
        module = _module(path)
        function = getattr(module, name, None)
        if not callable(function):
            own = [key for key, value in vars(module).items() if callable(value)]
            raise ModelError(f"model: {path} has no function '{name}'{nearest(name, own)}")
        network = function()
    except ModelError:
        raise
    except (Exception, SystemExit) as error:
        raise ModelError(f"model: {_place(path, error)}: {type(error).__name__}: {error}") from error
    if not isinstance(network, Network):
        raise ModelError(f"model: {model} returned {type(network).__name__}, but a Network is needed")
    return network


def _module(path: Path) -> ModuleType:
    spec = spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.path.insert(0, str(path.parent.resolve()))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.pop(0)
    return module


def _place(path: Path, error: BaseException) -> str:
    """Return file and line of the deepest frame in the user's file."""
    if isinstance(error, SyntaxError):
        return f"{error.filename}, line {error.lineno}"
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if Path(frame.filename).resolve() == path.resolve()]
    return f"{path}, line {lines[-1]}" if lines else str(path)
