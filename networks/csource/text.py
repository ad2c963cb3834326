"""Text: CasADi functions as C, free of symbols that a library would show."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import casadi as ca

PRELUDE = """\
#define CASADI_SYMBOL_EXPORT
#ifdef __GNUC__
#define PART static __attribute__((noinline))
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#else
#define PART static
#endif

"""
QUICK = """\
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize ("O1")
#endif

"""
BESIDE = re.compile(
    r"^CASADI_SYMBOL_EXPORT [^\n]*?_(?:alloc_mem|init_mem|free_mem|checkout|release|incref|decref|n_in|n_out"
    r"|default_in|name_in|name_out|sparsity_in|sparsity_out|work|work_bytes)\([^\n]*\) ?\{.*?^\}\n+",
    re.MULTILINE | re.DOTALL,
)
READ = re.compile(r"arg\[(\d+)\]\? arg\[\1\]\[(\d+)\] : 0;")
WRITE = re.compile(r"if \(res\[\d+\]!=0\) res")
STATEMENTS = re.compile(r"(?:^  (?:w|res\[\d+\])\[\d+\]=[^\n]*;\n)+", re.MULTILINE)
LARGE, PART = 3000, 200


def generated(functions: Sequence[Any]) -> str:
    """Return functions as C, without what CasADi adds for its own use.

    No argument or result is ever left out, so none is asked for. Where functions are large, values
    stand in the work array and statements are dealt out to functions of their own, since compilers take
    more than their share of time for long ones; more optimization would take time and gain nothing.
    """
    large = is_large(functions)
    with TemporaryDirectory() as folder:
        options: dict[str, Any] = {"casadi_int": "int", "casadi_real": "double", "avoid_stack": large}
        generator = ca.CodeGenerator("model.c", options)
        for function in functions:
            generator.add(function)
        path = generator.generate(f"{folder}/")
        text = Path(path).read_text()
    text = WRITE.sub("res", READ.sub(r"arg[\1][\2];", BESIDE.sub("", text)))
    return PRELUDE + (QUICK + _dealt_out(text) if large else text)


def is_large(functions: Sequence[Any]) -> bool:
    """Tell whether functions keep their values in the work array."""
    return any(f.is_a("SXFunction") and f.n_instructions() > LARGE for f in functions)


def _dealt_out(text: str) -> str:
    """Move long rows of statements into functions of their own, before the one that has them."""
    pieces: list[str] = []
    count, end = 0, 0
    for match in STATEMENTS.finditer(text):
        statements = match.group().splitlines(keepends=True)
        if len(statements) <= PART:
            continue
        before = text[end : match.start()]
        head = before.rindex("static int casadi_f")
        parts, calls = [], []
        for first in range(0, len(statements), PART):
            name = f"part_{count}"
            count += 1
            body = "".join(statements[first : first + PART])
            parts.append(f"PART void {name}{PARTED} {{\n{body}}}\n\n")
            calls.append(f"  {name}(arg, res, w);\n")
        pieces += [before[:head], *parts, before[head:], *calls]
        end = match.end()
    return "".join([*pieces, text[end:]])


PARTED = "(const double **arg, double **res, double *w)"
