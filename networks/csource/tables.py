"""Tables: constants of a model as C text."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

GUARD = "INERTANCE_MODEL_H"
ARGUMENTS = "(const double **arg, double **res, int *iw, double *w, int mem)"


class Tables:
    """Gathers sizes (macros) and constant arrays; none has length zero, which C does not know."""

    def __init__(self) -> None:
        self._sizes: list[tuple[str, int]] = []
        self._declared: list[str] = []
        self._defined: list[str] = []

    def size(self, name: str, value: int) -> None:
        """Add a macro."""
        self._sizes.append((name, int(value)))

    def doubles(self, name: str, values: Iterable[float]) -> None:
        """Add an array of numbers, exact to the last bit."""
        self._array("double", name, [_number(float(v)) for v in values] or ["0"])

    def integers(self, name: str, values: Iterable[Any]) -> None:
        """Add an array of integers."""
        self._array("int", name, [str(int(v)) for v in values] or ["0"])

    def strings(self, name: str, values: Sequence[str]) -> None:
        """Add an array of texts."""
        self._array("char *const", name, [_quoted(v) for v in values] or ['""'])

    def sparsity(self, name: str, count: str, pattern: Any) -> None:
        """Add a pattern by columns: where columns start, and rows."""
        self.size(count, pattern.nnz())
        self.integers(f"{name}_column", pattern.colind())
        self.integers(f"{name}_row", pattern.row())

    def factor(self, pattern: Any) -> None:
        """Add patterns and orders of a QR factorisation; empty ones if it is not wanted."""
        if pattern is None:
            v = r = None
            order, rows = [], []
        else:
            v, r, rows, order = pattern.qr_sparse()
        self.size("NV", 0 if v is None else v.nnz())
        self.size("NR", 0 if r is None else r.nnz())
        self.size("NROWS", 0 if v is None else v.size1())
        for name, part in (("v", v), ("r", r)):
            self.integers(f"model_{name}_column", [] if part is None else part.colind())
            self.integers(f"model_{name}_row", [] if part is None else part.row())
        self.integers("model_order", order)
        self.integers("model_place", rows)

    def header(self, model: str, functions: Sequence[str]) -> str:
        """Return model.h."""
        told = " ".join(model.split()).replace("*/", "* /")
        lines = [f"/* '{told}': sizes, tables and functions. */", f"#ifndef {GUARD}", f"#define {GUARD}", ""]
        lines += [f"#define {name} {value}" for name, value in self._sizes]
        lines += ["#define NQ (NP + NM + NI + NK)", ""]
        lines += [*self._declared, ""]
        lines += [f"int {name}{ARGUMENTS};" for name in functions]
        return "\n".join([*lines, "", "#endif", ""])

    def source(self) -> str:
        """Return the definitions of the tables."""
        return "\n".join(['#include "model.h"', "", "#include <math.h>", "", *self._defined, "", ""])

    def _array(self, kind: str, name: str, entries: list[str]) -> None:
        self._declared.append(f"extern const {kind} {name}[{len(entries)}];")
        self._defined.append(f"const {kind} {name}[{len(entries)}] = {{{', '.join(entries)}}};")


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
