"""Python files of a user: what stands in a file's folder is imported for the files of that folder alone."""

import builtins
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from importlib import import_module
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any
from urllib.parse import quote, unquote

PREFIX = "files in "
UNSHADOWED = (__name__.partition(".")[0], *sys.builtin_module_names)


def module_of(path: Path) -> ModuleType:
    """Run a Python file and return its module.

    It imports what stands beside it as a script does, wherever the import is written and whenever that is
    reached. Nothing else sees these modules, so that those of two folders may have one name.
    """
    package = PREFIX + quote(str(path.parent.resolve())).replace(".", "%2E")  # tells the folder
    name = f"{package}.{path.stem}"
    spec = spec_from_file_location(name, path, loader=_Loader(name, str(path)))
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[name] = module_from_spec(spec)  # dataclasses look themselves up there
    spec.loader.exec_module(module)
    return module


class _Loader(SourceFileLoader):
    def exec_module(self, module: ModuleType) -> None:
        package = module.__name__.partition(".")[0]
        vars(module)["__builtins__"] = {**vars(builtins), "__import__": partial(_imported, package)}
        super().exec_module(module)


class _Finder:
    @staticmethod
    def find_spec(
        name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return where a module of these packages is, or the package itself."""
        if not name.startswith(PREFIX):
            return None
        if path is None:
            package = ModuleSpec(name, None, is_package=True)
            package.submodule_search_locations = [unquote(name.removeprefix(PREFIX))]
            return package
        spec = PathFinder.find_spec(name, path, target)
        if spec is not None and isinstance(spec.loader, SourceFileLoader):
            spec.loader = _Loader(name, spec.loader.path)
        return spec


sys.meta_path.insert(0, _Finder)


def _imported(
    package: str,
    name: str,
    globals: Mapping[str, object] | None = None,
    locals: Mapping[str, object] | None = None,
    fromlist: Sequence[str] | None = (),
    level: int = 0,
) -> Any:
    """Do what an import statement says, with the modules of a package before all others."""
    top = name.partition(".")[0]
    if level or not _stands_in(package, top):
        return builtins.__import__(name, globals, locals, fromlist or (), level)
    import_module(f"{package}.{name}")
    if fromlist:
        return builtins.__import__(f"{package}.{name}", globals, locals, fromlist)
    return sys.modules[f"{package}.{top}"]


def _stands_in(package: str, name: str) -> bool:
    """Tell whether a name means a file of a package; a folder of files gives way to what is installed."""
    if f"{package}.{name}" in sys.modules:
        return True
    beside = PathFinder.find_spec(name, import_module(package).__path__)
    if beside is None or name in UNSHADOWED:
        return False
    if beside.origin is None:
        return name not in sys.modules and find_spec(name) is None
    own = getattr(sys.modules.get(name), "__file__", None)
    return own is None or not Path(own).samefile(beside.origin)
