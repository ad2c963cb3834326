"""The reference of every public name, as pages that mkdocstrings fills: `::: inertance....`."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterator
from textwrap import indent
from types import FunctionType, ModuleType
from typing import Any

import inertance
from inertance.cli.catalogue import first_line, is_base
from inertance.cli.sketch import sketch
from inertance.cli.usage import usage
from inertance.components import Component
from inertance.networks.machines import elements

FAMILIES = ("translational", "rotational", "transmission", "signals", "thermal")
PAGES = {
    "networks": "Networks, runs, records",
    "language": "Elements of your own",
    "analysis": "Analysis",
    "machines": "Machines",
    "sweeps": "Sweeps",
    "synthesis": "Synthesis",
    "identification": "Identification",
    "diagnosis": "Diagnosis",
    "fmu": "FMUs",
    "modelica": "Modelica",
    "errors": "Errors",
}
STUBBED = re.compile(rf"inertance\.components\.({'|'.join(FAMILIES)})\b")


def public() -> dict[str, Any]:
    """Return every public class and function by the shortest name under which a user finds it."""
    found: dict[str, Any] = {}
    for name in dir(inertance):
        value = getattr(inertance, name)
        if isinstance(value, ModuleType):
            inner = getattr(value, "__all__", None) or [n for n in dir(value) if n[0] != "_"]
            found |= {f"{name}.{n}": getattr(value, n) for n in inner}
        else:
            found[name] = value
    shown: dict[int, str] = {}
    for name, value in found.items():
        if isinstance(value, type | FunctionType) and value.__module__.startswith("inertance"):
            shown.setdefault(id(value), name)
    return {name: found[name] for name in shown.values()}


def reference_pages() -> dict[str, str]:
    """Return the text of each page by its name: the list of all, then one a family or a subject."""
    names = public()
    pages: dict[str, dict[str, Any]] = {}
    for name, value in names.items():
        pages.setdefault(_page(name, value), {})[name] = value
    titles = {page: PAGES.get(page, f"Elements: {page}") for page in pages}
    ordered = sorted(pages, key=[*FAMILIES, *PAGES].index)
    texts = {f"reference/{page}.md": _text(titles[page], pages[page]) for page in ordered}
    return {"reference/index.md": _index({titles[page]: (page, pages[page]) for page in ordered})} | texts


def _page(name: str, value: Any) -> str:
    if isinstance(value, type) and issubclass(value, BaseException):
        return "errors"
    module, _, rest = name.partition(".")
    if family := STUBBED.match(value.__module__):
        return family[1]
    if rest:
        return module
    room = value.__module__.split(".")[1]
    return {"components": "language"}.get(room, room)


def _index(pages: dict[str, tuple[str, dict[str, Any]]]) -> str:
    lines = [
        "# Reference",
        "",
        "Every public name: what it is, its equation, what it takes in which unit, its source. Elements that",
        "slide or convert, and what every user needs, are imported from `inertance`, a name with a dot",
        "from its module: `from inertance import Mass`, `from inertance.rotational import Inertia`.",
    ]
    for title, (page, names) in pages.items():
        lines += ["", f"## {title}", "", "| name | |", "|---|---|"]
        lines += [
            f"| [`{name}`]({page}.md#{_path(value)}) | {_cell(value)} |" for name, value in names.items()
        ]
    return "\n".join([*lines, ""])


def _text(title: str, names: dict[str, Any]) -> str:
    groups: dict[str, dict[str, Any]] = {}
    for name, value in sorted(names.items()):
        groups.setdefault(_group(value) if title not in PAGES.values() else "", {})[name] = value
    return "\n".join([f"# {title}", "", *(line for g in sorted(groups) for line in _lines(g, groups[g]))])


def _lines(group: str, names: dict[str, Any]) -> Iterator[str]:
    if group:
        yield f"## {group}\n"
    for name, value in names.items():
        element = isinstance(value, type) and issubclass(value, Component)
        yield f"::: {_path(value)}"
        yield f"    options:\n      heading: {name}\n      toc_label: {name}"
        yield f"      heading_level: {3 if group else 2}"
        yield f"      {'members' if element else 'inherited_members'}: {str(not element).lower()}\n"
        if element:
            yield from _element(name, value)


def _element(name: str, kind: type[Component]) -> Iterator[str]:
    """Yield what the docstring of an element does not tell: its picture, an example, its lines."""
    yield f"```text\n{sketch(kind)}\n```\n"
    if not is_base(kind):
        yield f'??? example "{name} in a network"\n\n{_fenced(usage(kind))}'
    file = kind.__module__.removeprefix("inertance.").replace(".", "/")
    yield f'??? note "{file}.py"\n\n{_fenced(inspect.getsource(kind))}'


def _fenced(code: str) -> str:
    return indent(f"```python\n{code.rstrip()}\n```\n", "    ")


def _path(value: Any) -> str:
    """Return where mkdocstrings finds a name: an element in the stub, which has its values."""
    family = STUBBED.match(value.__module__)
    if isinstance(value, type) and getattr(elements, value.__name__, None) is value:
        return f"{elements.__name__}.{value.__name__}"
    return f"{family[0] if family else value.__module__}.{value.__qualname__}"


def _group(value: Any) -> str:
    told = (sys.modules[value.__module__].__doc__ or "").partition("\n")[0].rstrip(".")
    return told[:1].upper() + told[1:]


def _cell(value: Any) -> str:
    return first_line(value).replace("|", "\\|")
