"""Lazy names: what a package shows is imported when it is first asked for."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

import lazy_loader


def face(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return `__getattr__`, `__dir__` and `__all__` of a package with this `__name__` and `__file__`."""
    found, listed, names = lazy_loader.attach_stub(package, file)

    def find(name: str) -> Any:
        if name in names:
            return found(name)
        raise AttributeError(f"module '{package}' has no '{name}'{_nearest(package, name, names, found)}")

    return find, listed, names


def _nearest(package: str, name: str, names: list[str], found: Callable[[str], Any]) -> str:
    """Return a hint at the name that was meant, which may be one of a module that the package shows."""
    from difflib import get_close_matches

    known = {shown.lower(): shown for shown in names}
    probed = name.startswith("_") or package != __name__.partition(".")[0]  # as test runners probe a copy
    for shown in () if probed else names:
        if isinstance(module := found(shown), ModuleType):
            inner = getattr(module, "__all__", dir(module))
            known = {other.lower(): f"{shown}.{other}" for other in inner} | known
    matches = get_close_matches(name.lower(), known, n=1)
    return f"; did you mean '{known[matches[0]]}'?" if matches else ""
