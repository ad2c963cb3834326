"""The network that `path/to/file.py:function` stands for."""

from __future__ import annotations

import sys
import traceback
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from ..components import ModelError, nearest
from ..networks import Network


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
