"""The network that MODEL, `path/to/file.py:function`, stands for."""

from __future__ import annotations

from ..components import ModelError
from ..networks import Network, UserCodeError, load_model
from .failure import FAILED, WRONG_USE, fail


def load_network(model: str) -> Network:
    """Return the network of `path/to/file.py:function`, or end the command with what is wrong."""
    try:
        return load_model(model, asked="MODEL")
    except UserCodeError as error:
        fail(str(error), FAILED)
    except ModelError as error:
        fail(str(error), WRONG_USE)
