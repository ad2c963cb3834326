"""Write licences.md: what a fresh installation brings along, and under which licence each says that it is.

python docs/make_licences.py    in an environment that holds `inertance` with the extras to be listed
"""

import re
from importlib.metadata import Distribution, PackageNotFoundError, distribution, requires
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PAGE = Path(__file__).with_name("licences.md")
LONGEST = 60
SPELT = {"Apache 2.0": "Apache-2.0", "BSD License": "BSD", "MIT License": "MIT"}


def needed(name: str, *extras: str) -> dict[str, Distribution]:
    """Return what a package with extras needs here, directly or not, and is installed, by name."""
    found: dict[str, Distribution] = {}
    waiting, seen = [(name, extras)], set()
    while waiting:
        here, wanted = waiting.pop()
        if (here, wanted) in seen:
            continue
        seen.add((here, wanted))
        for requirement in map(Requirement, requires(here) or ()):
            marker = requirement.marker
            if marker and not any(marker.evaluate({"extra": extra}) for extra in wanted or ("",)):
                continue
            try:
                found[canonicalize_name(requirement.name)] = distribution(requirement.name)
            except PackageNotFoundError:
                continue
            waiting.append((requirement.name, tuple(sorted(requirement.extras))))
    found.pop("inertance", None)
    return dict(sorted(found.items()))


def licence(package: Distribution) -> str:
    """Return what a package says of its licence."""
    data = package.metadata
    told = (data.get_all("License-Expression") or [""])[0]
    classified = [c.split(" :: ")[-1] for c in data.get_all("Classifier") or () if c.startswith("License ::")]
    told = (
        told
        or ", ".join(c for c in classified if c != "OSI Approved")
        or (data.get_all("License") or [""])[0]
    )
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
