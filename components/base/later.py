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
                shown = self._shown(module)
                if name in shown:
                    return shown[name]
        raise AttributeError(f"module '{self.package}' has no attribute '{name}'")

    def names(self) -> list[str]:
        """Return all names that the modules show."""
        return [name for module in self.modules for name in self._shown(module)]

    def _shown(self, module: str) -> dict[str, Any]:
        path = f"{self.package}.{module}"
        return {
            name: item
            for name, item in vars(import_module(path)).items()
            if name[0] != "_" and getattr(item, "__module__", "").startswith(path)
        }
