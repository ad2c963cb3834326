"""Tables: constants of a model as C text."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .size_class import SWITCHES, most_of_class

GUARD = "INERTANCE_MODEL_H"
CONSTANTS = "#define NQ (NP + NM + NI + NK)"
LENGTH = re.compile(r"\[\d+\]")
ARGUMENTS = "(const double **arg, double **res, int *iw, double *w, int mem)"


class Tables:
    """Gathers sizes (macros) and constant arrays `model_...`; none has length zero, which C does not know."""

    def __init__(self) -> None:
        self._sizes: list[tuple[str, int]] = []
        self._declared: list[str] = []
        self._defined: list[str] = []

    def sizes(self, **sizes: int) -> None:
        """Add macros."""
        self._sizes += [(name, int(value)) for name, value in sizes.items()]

    def doubles(self, **arrays: Iterable[float]) -> None:
        """Add arrays of numbers, exact to the last bit."""
        self._arrays("double", arrays, lambda value: _number(float(value)), "0")

    def integers(self, **arrays: Iterable[Any]) -> None:
        """Add arrays of integers."""
        self._arrays("int", arrays, lambda value: str(int(value)), "0")

    def strings(self, **arrays: Iterable[str]) -> None:
        """Add arrays of texts."""
        self._arrays("char *const", arrays, _quoted, '""')

    def sparsity(self, name: str, pattern: Any) -> None:
        """Add a pattern by columns: how many entries, where columns start, and rows."""
        self.sizes(**{f"N{name.upper()}": pattern.nnz()})
        self.integers(**{f"{name}_column": pattern.colind(), f"{name}_row": pattern.row()})

    def factor(self, pattern: Any) -> None:
        """Add patterns and orders of a QR factorisation."""
        v, r, rows, order = pattern.qr_sparse()
        self.sparsity("v", v)
        self.sparsity("r", r)
        self.sizes(NROWS=v.size1())
        self.integers(order=order, place=rows)

    def header(self, model: str, functions: Sequence[str]) -> str:
        """Return model.h."""
        told = " ".join(model.split()).replace("*/", "* /")
        sizes = [f"#define {name} {value}" for name, value in self._sizes]
        return _header(f"'{told}'", [*sizes, CONSTANTS, "", *self._declared, "", *_declared(functions)])

    def shared_header(self, functions: Sequence[str]) -> str | None:
        """Return model.h for all models of a size class; None if this one is too large for any.

        Sizes are variables there, which the model brings along, and what arrays have room for is fixed.
        """
        most = most_of_class(dict(self._sizes))
        if most is None:
            return None
        lines = []
        for name, value in self._sizes:
            if name in SWITCHES:
                lines.append(f"#define {name} {value}")
            else:
                lines += [f"#define MOST_{name} {most[name]}", f"extern const int size_{name};"]
                lines.append(f"#define {name} size_{name}")
        lines += [CONSTANTS, f"#define MOST_NQ {sum(most[name] for name in ('NP', 'NM', 'NI', 'NK'))}"]
        tables = [LENGTH.sub("[]", line) for line in self._declared]
        hidden = "#ifdef __GNUC__\n#pragma GCC visibility push(hidden)\n#endif\n"
        shown = hidden.replace("push(hidden)", "pop")
        return _header("A size class", [hidden, *lines, "", *tables, "", *_declared(functions), "", shown])

    def shared_sizes(self) -> str:
        """Return the definitions of what are variables in a shared header."""
        return "".join(f"const int size_{name} = {value};\n" for name, value in self._sizes)

    def source(self) -> str:
        """Return the definitions of the tables."""
        return "\n".join(['#include "model.h"', "", "#include <math.h>", "", *self._defined, "", ""])

    def _arrays(
        self, kind: str, arrays: Mapping[str, Iterable[Any]], told: Callable[[Any], str], empty: str
    ) -> None:
        for name, values in arrays.items():
            entries = [told(value) for value in values] or [empty]
            declared = f"const {kind} model_{name}[{len(entries)}]"
            self._declared.append(f"extern {declared};")
            self._defined.append(f"{declared} = {{{', '.join(entries)}}};")


def _header(told: str, lines: Sequence[str]) -> str:
    begun = [f"/* {told}: sizes, tables and functions. */", f"#ifndef {GUARD}", f"#define {GUARD}", ""]
    return "\n".join([*begun, *lines, "", "#endif", ""])


def _declared(functions: Sequence[str]) -> list[str]:
    return [f"int {name}{ARGUMENTS};" for name in functions]


def macros(constants: Mapping[str, Any]) -> str:
    """Return a header that defines the names in capitals."""
    lines = [f"#define {name} {value!r}" for name, value in constants.items() if name.isupper()]
    guard = "INERTANCE_CONSTANTS_H"
    return "\n".join([f"#ifndef {guard}", f"#define {guard}", "", *lines, "", "#endif", ""])


def _number(value: float) -> str:
    if np.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
    return "NAN" if np.isnan(value) else repr(value)


def _quoted(text: str) -> str:
    return json.dumps(text).replace("??", "?\\?")
