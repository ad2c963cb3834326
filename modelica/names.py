"""Names: what things are called in Modelica, and strings and units as it has them."""

from __future__ import annotations

import re

_WORDS = """
algorithm and annotation block break class connect connector constant constrainedby der discrete each else
elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for
function if import impure in initial inner input loop model not operator or outer output package
parameter partial protected public pure record redeclare replaceable return stream then true type when
while within
abs sign sqrt div mod rem ceil floor integer sin cos tan asin acos atan atan2 sinh cosh tanh exp log log10 min
max sum product time delay sample pre edge change reinit terminal Real Integer Boolean String Modelica
"""
RESERVED = frozenset(_WORDS.split())
UNIT = re.compile(r"1|[A-Za-z]+\d*(\.[A-Za-z]+\d*)*(/([A-Za-z]+\d*|\([A-Za-z]+\d*(\.[A-Za-z]+\d*)+\)))?")


def identifier(name: str) -> str:
    """Return a name that Modelica allows: letters, digits and underscores, and no word of its own."""
    cleaned = re.sub(r"\W", "_", name, flags=re.ASCII) or "_"
    cleaned = f"m{cleaned}" if cleaned[0].isdigit() else cleaned
    return f"{cleaned}_" if cleaned in RESERVED else cleaned


def reference(path: str) -> str:
    """Return a path of names, also inside `der()`."""
    if path.startswith("der("):
        return f"der({reference(path[4:-1])})"
    return ".".join(map(identifier, path.split(".")))


def quoted(text: str) -> str:
    """Return a string."""
    inner = " ".join(text.split()).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{inner}"'


def unit(name: str) -> str:
    """Return the attribute that tells a unit; empty for those that Modelica cannot write (1/m^n)."""
    name = denominator(name)
    return f"unit={quoted(name)}" if UNIT.fullmatch(name) else ""


def denominator(name: str) -> str:
    """Return a unit with brackets around what a slash divides by, if that is a product."""
    upper, slash, lower = name.partition("/")
    return f"{upper}/({lower})" if "." in lower and not lower.startswith("(") else upper + slash + lower
