"""`Later`: names of a package whose modules are imported when one of them is first asked for."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class Later:
    """What some modules of a package show, for the package's `__getattr__` and `__dir__`.

    Args:
        package: its full name.
        modules: their names in it, in the order in which they are asked.
    """

    def __init__(self, package: str, *modules: str) -> None:
        self.package, self.modules = package, modules

    def find(self, name: str) -> Any:
        """Return what a name stands for.

        Raises:
            AttributeError: if no module shows it.
        """
        if not name.startswith("_") and name not in self.modules:
            for module in self.modules:
                path, face = self._face(module)
                if _is_own(face.get(name), path):
                    return face[name]
        raise AttributeError(f"module '{self.package}' has no attribute '{name}'")

    def names(self) -> list[str]:
        """Return all names that the modules show."""
        faces = map(self._face, self.modules)
        return [
            name
            for path, face in faces
            for name, item in face.items()
            if name[0] != "_" and _is_own(item, path)
        ]

    def _face(self, module: str) -> tuple[str, dict[str, Any]]:
        path = f"{self.package}.{module}"
        return path, vars(import_module(path))


def _is_own(item: Any, path: str) -> bool:
    """Tell whether something is defined in a module or below it, not imported there from elsewhere."""
    return getattr(item, "__module__", "").startswith(path)
