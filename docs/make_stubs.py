"""Make the stubs of components, families and machines: what type checkers and editors know of each element.

python docs/make_stubs.py [--check]

From the fields of a class comes the signature with which it is made, with units and ranges. With --check
nothing is written, and exit code 1 tells that stubs are not what the classes say.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from textwrap import fill, indent
from types import FunctionType, ModuleType
from typing import Any

from inertance.cli.catalogue import is_base
from inertance.components.language import (
    Component,
    Field,
    Option,
    Parameter,
    Part,
    RealInput,
    Variable,
    given_fields,
    is_required,
    told,
)

PACKAGE = "inertance.components"
MODULES = [
    *(
        f"{PACKAGE}.{family}"
        for family in ("rotational", "signals", "thermal", "translational", "transmission")
    ),
    "inertance.networks.machines.elements",
]
WIDTH = 110
OWN_ARGUMENTS = re.compile(r"\n\nArgs:(?:\n {4}.*)+")
HEAD = '''"""{doc}"""

# Made by docs/make_stubs.py from the classes; do not edit.

{imports}

'''
Kind = type[Component]


def stub(name: str) -> str:
    """Return the stub of a module."""
    module = import_module(name)
    shown = {value for value in vars(module).values() if _is_own(value, module)}
    kinds = sorted(_with_bases(shown, module), key=lambda kind: (len(kind.__mro__), kind.__name__))
    classes = "\n".join(_class(kind, module) for kind in kinds)
    return HEAD.format(doc=module.__doc__, imports=_imports(kinds, module, classes)) + classes


def path_of(name: str) -> Path:
    """Return where the stub of a module stands."""
    return Path(import_module(name).__file__ or "").with_suffix(".pyi")


def _is_own(value: Any, module: ModuleType) -> bool:
    """Return whether a value is a class of components that lives in a package."""
    own = isinstance(value, type) and issubclass(value, Component)
    return own and value.__module__.startswith(f"{module.__package__}.")


def _with_bases(kinds: set[Kind], module: ModuleType) -> set[Kind]:
    return {base for kind in kinds for base in kind.__mro__ if _is_own(base, module)}


def _imports(kinds: list[Kind], module: ModuleType, classes: str) -> str:
    """Return the imports of what the text of classes names; of a family, through its face."""
    typing = [name for name in ("Any", "Literal") if re.search(rf"\b{name}\b", classes)]
    language = ("Component", "Number", "ParameterValue", "SignalValue")
    places = {"language": {name for name in language if re.search(rf"\b{name}\b", classes)}}
    for base in {base for kind in kinds for base in kind.__bases__}:
        if base is not Component and not _is_own(base, module):
            places.setdefault(_place(base), set()).add(base.__name__)
    inside = (module.__package__ or "").startswith(PACKAGE)
    if not inside and "rotational" in places:  # whose names are those of what slides
        places[""] = {"rotational"}
        del places["rotational"]
    above = ".." if inside else "...components."
    own = (
        f"from {(above + place).rstrip('.')} import {', '.join(sorted(names))}"
        for place, names in sorted(places.items())
    )
    numpy = ["import numpy as np", ""] if "np." in classes else []
    return "\n".join([f"from typing import {', '.join(typing)}", "", *numpy, *own])


def _place(kind: Kind) -> str:
    """Return the family, or the file, in which a component stands."""
    return kind.__module__.removeprefix(f"{PACKAGE}.").split(".")[0]


def _class(kind: Kind, module: ModuleType) -> str:
    turning = not (module.__package__ or "").startswith(PACKAGE)
    bases = ", ".join(
        f"rotational.{base.__name__}" if turning and _place(base) == "rotational" else base.__name__
        for base in kind.__bases__
    )
    parts = [_docstring(kind), *_fields(kind), *_members(kind), _constructor(kind)]
    return f"class {kind.__name__}({bases}):\n{indent(chr(10).join(filter(None, parts)), '    ')}\n"


def _docstring(kind: Kind) -> str:
    doc = inspect.cleandoc(kind.__doc__ or "")
    given = [] if _is_open(kind) else given_fields(kind)
    if given:
        doc = OWN_ARGUMENTS.sub("", doc)
        lines = [f"    {field.name}: {told(field)}." for field in given]
        lines = [fill(line, WIDTH - 4, subsequent_indent=" " * 8) for line in lines]
        doc += "\n".join(["\n", "Args:", *lines, ""])
    elif "\n" in doc:
        doc += "\n"
    return f'{"r" if chr(92) in doc else ""}"""{doc}"""\n' if doc else ""


def _fields(kind: Kind) -> Iterator[str]:
    for name, field in vars(kind).items():
        if isinstance(field, Field):
            yield f'{name}: Any\n"""{told(field)}"""'


def _taken(given: inspect.Parameter) -> str:
    return f"{given.name}: Any" + ("" if given.default is given.empty else " = ...")


def _members(kind: Kind) -> Iterator[str]:
    """Yield what a class has besides fields and what components have, under the types that equations have."""
    for name, value in vars(kind).items():
        if name.startswith("_") or isinstance(value, Field) or hasattr(Component, name):
            continue
        if isinstance(value, property):
            yield f"@property\ndef {name}(self) -> Any: ..."
        elif isinstance(value, FunctionType):
            taken = map(_taken, list(inspect.signature(value).parameters.values())[1:])
            yield f"def {name}({', '.join(['self', *taken])}) -> Any: ..."
        else:
            yield f"{name}: Any"


def _is_open(kind: Kind) -> bool:
    """Return whether a class is for deriving from, so that any field may come to it."""
    return kind.__name__.startswith("_") or is_base(kind)


def _constructor(kind: Kind) -> str:
    given = given_fields(kind)
    if _is_open(kind):
        return "def __init__(self, **values: Any) -> None: ..."
    if not given:
        return "def __init__(self) -> None: ..."
    lines = [f"    {field.name}: {_type(field)}{_default(field)}," for field in given]
    if kind.parts is not Component.parts:
        lines.append("    **parts: Component,")
    return "\n".join(["def __init__(", "    self,", "    *,", *lines, ") -> None: ..."])


def _type(field: Field) -> str:
    if isinstance(field, Option):
        if field.choices is not None and set(map(type, field.choices)) == {bool}:
            return "bool"
        if field.choices is not None:
            return f"Literal[{', '.join(map(repr, field.choices))}]"
        return "int | np.integer[Any]" if type(field.default) is int else "Any"
    types = {Parameter: "ParameterValue", Variable: "Number", RealInput: "SignalValue", Part: "Component"}
    return next(name for kind, name in types.items() if isinstance(field, kind))


def _default(field: Field) -> str:
    if is_required(field):
        return ""
    default = getattr(field, "default", ...)
    return f" = {default!r}" if isinstance(default, bool | int | float | str | None) else " = ..."


def main() -> int:
    """Write the stubs, or tell which are old."""
    wanted = {path_of(name): stub(name) for name in MODULES}
    old = [path for path, text in wanted.items() if not path.exists() or path.read_text("utf-8") != text]
    for path in old:
        print(f"old: {path}" if "--check" in sys.argv else f"wrote {path}")
        if "--check" not in sys.argv:
            path.write_text(wanted[path], "utf-8")
    return int(bool(old) and "--check" in sys.argv)


if __name__ == "__main__":
    sys.exit(main())
