"""The public components by family, under the names by which they are imported."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from types import ModuleType

from ..components import Component, ModelError, RealInput, UnknownNameError, nearest
from ..components.language import Part, template_of

Kind = type[Component]


@cache
def catalogue() -> dict[str, dict[str, Kind]]:
    """Return all public components: family, then name, then class."""
    found: dict[str, dict[str, Kind]] = {}
    for prefix, module in _faces():
        for name, value in inspect.getmembers(module, inspect.isclass):
            if issubclass(value, Component) and (family := _family(value)):
                found.setdefault(family, {})[prefix + name] = value
    return {family: dict(sorted(found[family].items())) for family in sorted(found)}


def _faces() -> Iterator[tuple[str, ModuleType]]:
    """Yield the public face and its modules of components."""
    face = import_module("..", __package__)
    yield "", face
    for name in ("machines", "rotational", "signals", "thermal"):
        yield f"{name}.", getattr(face, name)


def _family(kind: Kind) -> str:
    """Return the package that a component lives in, empty for what is of no family or needs an FMU."""
    place = kind.__module__.split(".")
    return place[2] if len(place) > 3 and place[1] != "fmu" and place[2] != "language" else ""


def by_family() -> list[tuple[str, dict[str, Kind]]]:
    """Return all public components by family and by what they are, with a title each."""
    found: dict[str, dict[str, Kind]] = {}
    for family, names in catalogue().items():
        for name, kind in names.items():
            about = (sys.modules[kind.__module__].__doc__ or "").partition("\n")[0].rstrip(".")
            found.setdefault(f"{family}: {about[:1].lower()}{about[1:]}", {})[name] = kind
    return sorted(found.items())


def mentions(name: str, kind: Kind, word: str) -> bool:
    """Return whether a component has a word in its name, its description or that of what it declares."""
    declared = " ".join(f"{field.name} {field.doc}" for field in kind.fields.values())
    return word.lower() in f"{name} {kind.__doc__} {declared}".lower()


def all_names() -> dict[str, Kind]:
    """Return every public component by its full name."""
    return {name: kind for names in catalogue().values() for name, kind in names.items()}


def full_name(kind: Kind) -> str:
    """Return the name by which a component is imported."""
    return next((name for name, known in all_names().items() if known is kind), kind.__name__)


def first_line(kind: type) -> str:
    """Return the first line of a component's docstring."""
    return (inspect.getdoc(kind) or "").partition("\n")[0]


def is_base(kind: Kind) -> bool:
    """Return whether a class is for deriving from: others do, and it lacks equations of its own.

    An element has as many equations as unknowns that are not left to the nodes, one a port.
    """
    derived = any(issubclass(other, kind) and other is not kind for other in all_names().values())
    composite = kind.connections is not Component.connections
    composite = composite or any(isinstance(field, Part) for field in kind.fields.values())
    if composite or not derived:
        return False
    try:
        template = template_of(kind())
    except (ModelError, NotImplementedError):
        return True
    inputs = {name for name, field in kind.fields.items() if isinstance(field, RealInput)}
    unknowns = [v for v in template.variables if not v.startswith("der(") and v not in inputs]
    ports = sum("." in name for name in unknowns) // 2
    return len(template.residuals) + len(template.aliases) < len(unknowns) - ports


def find(name: str) -> str:
    """Return the full name of a component; capitals and a family in front may be left out.

    Raises:
        UnknownNameError: for an unknown name, with the nearest one.
    """
    known, lower = all_names(), name.lower()
    spoken = {_plain(full): full for full in reversed(known)} | {full.lower(): full for full in known}
    if name in known:
        return name
    if lower in spoken:
        return spoken[lower]
    guess = nearest(lower, spoken)
    for low in sorted(spoken, key=len):
        guess = guess.replace(f"'{low}'", f"'{spoken[low]}'")
    raise UnknownNameError(f"there is no component '{name}'{guess}; `inertance components` lists them all")


def _plain(full: str) -> str:
    return full.rpartition(".")[2].lower()


def namesakes(full: str) -> list[str]:
    """Return the other components of the same plain name."""
    return [name for name in all_names() if name != full and _plain(name) == _plain(full)]
