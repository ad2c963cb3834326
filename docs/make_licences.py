"""Write licences.md: what a fresh installation brings along, and under which licence each says that it is.

python docs/make_licences.py    in an environment that holds `inertance` with the extras to be listed
"""

import re
from importlib.metadata import Distribution, PackageNotFoundError, distribution, requires
from pathlib import Path

PAGE = Path(__file__).with_name("licences.md")
NAME = re.compile(r"[\w.-]+")
LONGEST = 60
SPELT = {"Apache 2.0": "Apache-2.0", "BSD License": "BSD", "MIT License": "MIT"}


def needed(name: str, extra: str = "") -> dict[str, Distribution]:
    """Return what a package needs, directly or not, and is installed, by name."""
    found: dict[str, Distribution] = {}
    waiting = [(name, extra)]
    while waiting:
        name, extra = waiting.pop()
        for line in requires(name) or ():
            requirement, _, marker = line.partition(";")
            if "extra" in marker and not (extra and re.search(rf"extra == ['\"]{extra}['\"]", marker)):
                continue
            other = NAME.match(requirement)
            assert other
            inner = re.search(r"\[(.*?)\]", requirement)
            try:
                package = distribution(other[0])
            except PackageNotFoundError:
                continue
            key = re.sub(r"[-_.]+", "-", package.metadata["Name"]).lower()
            waiting += [(other[0], e.strip()) for e in (inner[1].split(",") if inner else [])]
            if key not in found and key != "inertance":
                found[key] = package
                waiting.append((other[0], ""))
    return dict(sorted(found.items()))


def licence(package: Distribution) -> str:
    """Return what a package says of its licence."""
    data = package.metadata
    told = data.get("License-Expression") or ""
    classified = [c.split(" :: ")[-1] for c in data.get_all("Classifier") or () if c.startswith("License ::")]
    told = told or ", ".join(c for c in classified if c != "OSI Approved") or data.get("License") or ""
    first = told.strip().partition("\n")[0]
    return (SPELT.get(first, first) if first and len(first) <= LONGEST else "") or "see its files"


def table(packages: dict[str, Distribution]) -> str:
    """Return packages with their versions and licences."""
    rows = (f"| {name} | {package.version} | {licence(package)} |" for name, package in packages.items())
    return "\n".join(["| package | version | licence |", "|---|---|---|", *rows])


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    first = needed("inertance")
    for mark, packages in {
        "inertance": first,
        "docs": {name: d for name, d in needed("inertance", "docs").items() if name not in first},
        "test": {name: d for name, d in needed("inertance", "test").items() if name not in first},
    }.items():
        shown = re.compile(rf"(<!-- {mark} -->\n\n).*?(?=\n\n|\n?\Z)", re.DOTALL)
        text = shown.sub(lambda found, made=packages: found[1] + table(made), text)
    PAGE.write_text(text, encoding="utf-8")
