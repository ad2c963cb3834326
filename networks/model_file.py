"""The network, or the component, that `path/to/file.py:function` stands for."""

from __future__ import annotations

import traceback
from pathlib import Path

from ..base import InertanceError, ModelError, is_utf_16, module_of, nearest, there_is_file
from ..components import Component
from .network import Network


class UserCodeError(ModelError):
    """What a file of a model raised; the message has file and line."""


def load_model(model: str, base: Path = Path(), asked: str = "model") -> Network:
    """Return the network that a function of a Python file returns.

    Args:
        model: `path/to/file.py:function`.
        base: the folder that a relative path starts from.
        asked: what the file is called where it is asked for.

    Raises:
        ModelError: telling what is wrong; a UserCodeError, with file and line, for what the file raises.
    """
    network = _returned(model, base, asked, "Network")
    if not isinstance(network, Network):
        raise ModelError(f"{model} returned {type(network).__name__}, but {asked} returns a Network")
    return network


def load_component(model: str, base: Path = Path(), asked: str = "component") -> Component:
    """Return the component that a function of a Python file returns; arguments and errors as `load_model`."""
    component = _returned(model, base, asked, "component")
    if not isinstance(component, Component):
        raise ModelError(f"{model} returned {type(component).__name__}, but {asked} returns a component")
    return component


def _returned(model: str, base: Path, asked: str, wanted: str) -> object:
    """Return what a function of a Python file returns; what that should be is `wanted`."""
    file, _, name = model.rpartition(":")
    path = base / file
    if not file or path.suffix != ".py":
        raise ModelError(f"{asked} is 'path/to/file.py:function', got '{model}'")
    there_is_file(path)
    if is_utf_16(path):
        raise ModelError(f"{path}: Python reads UTF-8, and this file is UTF-16; save it as UTF-8")
    try:
        module = module_of(path)
        function = getattr(module, name, None)
        made: object = function() if callable(function) else None
    except InertanceError as error:
        raise UserCodeError(f"{_place(path, error)}: {error}") from error
    except SystemExit as error:
        told = f"the model ends Python (sys.exit({error.code!r})); let it return a {wanted}"
        raise UserCodeError(f"{_place(path, error)}: {told}") from error
    except Exception as error:
        raise UserCodeError(f"{_place(path, error)}: {type(error).__name__}: {error}") from error
    if not callable(function):
        named = {n: getattr(v, "__module__", "") for n, v in vars(module).items() if callable(v)}
        own = [n for n, home in named.items() if home == module.__name__]
        known = f"; it has {', '.join(own)}" if own else ""
        raise ModelError(f"{path} has no function '{name}'{nearest(name, own) or known}")
    return made


def _place(path: Path, error: BaseException) -> str:
    """Return file and line of the deepest frame in the user's file."""
    if isinstance(error, SyntaxError):
        return f"{error.filename or path}, line {error.lineno or 1}"
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if Path(frame.filename).resolve() == path.resolve()]
    return f"{path}, line {lines[-1]}" if lines else str(path)
