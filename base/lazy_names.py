"""Lazy names: what a package shows is imported when it is first asked for."""

from collections.abc import Callable
from typing import Any

import lazy_loader

from .errors import nearest


def face(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return `__getattr__`, `__dir__` and `__all__` of a package with this `__name__` and `__file__`."""
    found, listed, names = lazy_loader.attach_stub(package, file)

    def find(name: str) -> Any:
        if name in names:
            return found(name)
        raise AttributeError(f"module '{package}' has no '{name}'{nearest(name, names)}")

    return find, listed, names
