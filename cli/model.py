"""The network that MODEL, `path/to/file.py:function`, stands for."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from ..components import InertanceError, nearest
from ..networks import Network
from .failure import FAILED, WRONG_USE, fail


def load_network(model: str) -> Network:
    """Return the network of `path/to/file.py:function`, or end the command with what is wrong."""
    file, _, function = model.rpartition(":")
    path = Path(file)
    if not file or path.suffix != ".py":
        fail(f"MODEL is path/to/file.py:function, got '{model}'", WRONG_USE)
    if not path.is_file():
        fail(f"there is no file '{path}'", WRONG_USE)
    module = _guarded(path, lambda: _module(path))
    network = _guarded(path, _function(path, module, function))
    if not isinstance(network, Network):
        fail(f"{model} returned {type(network).__name__}, but MODEL returns a Network", WRONG_USE)
    return network


def _function(path: Path, module: ModuleType, name: str) -> Callable[[], Any]:
    function = getattr(module, name, None)
    if callable(function):
        return function  # type: ignore[no-any-return]
    own = [
        key
        for key, value in vars(module).items()
        if callable(value) and getattr(value, "__module__", "") == module.__name__
    ]
    known = f"; it has {', '.join(own)}" if own else ""
    fail(f"{path} has no function '{name}'{nearest(name, own) or known}", WRONG_USE)


def _module(path: Path) -> ModuleType:
    spec = spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        fail(f"{path} cannot be read as Python", WRONG_USE)
    module = module_from_spec(spec)
    sys.path.insert(0, str(path.parent.resolve()))
    spec.loader.exec_module(module)
    return module


def _guarded(path: Path, function: Callable[[], Any]) -> Any:
    """Call what the user wrote; tell an error by its line, without a traceback."""
    try:
        return function()
    except InertanceError as error:
        fail(f"{_place(path, error)}: {error}", FAILED)
    except Exception as error:
        fail(f"{_place(path, error)}: {type(error).__name__}: {error}", FAILED)


def _place(path: Path, error: Exception) -> str:
    """Return file and line of the deepest frame in the user's file."""
    if isinstance(error, SyntaxError):
        return f"{error.filename}, line {error.lineno}"
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if Path(frame.filename).resolve() == path.resolve()
    ]
    return f"{path}, line {lines[-1]}" if lines else str(path)
