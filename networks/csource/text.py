"""Text: CasADi functions as C, free of symbols that a library would show."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import casadi as ca

from .loops import looped

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
AUXILIARY_FUNCTIONS = re.compile(
    r"^CASADI_SYMBOL_EXPORT [^\n]*?_(?:alloc_mem|init_mem|free_mem|checkout|release|incref|decref|n_in|n_out"
    r"|default_in|name_in|name_out|sparsity_in|sparsity_out|work|work_bytes)\([^\n]*\) ?\{.*?^\}\n+",
    re.MULTILINE | re.DOTALL,
)
READ = re.compile(r"arg\[(\d+)\]\? arg\[\1\]\[(\d+)\] : 0;")
WRITE = re.compile(r"if \(res\[\d+\]!=0\) res")
BODY = re.compile(
    r"^static int casadi_f\d+\([^\n]*\{\n((?:  (?:w|res\[\d+\])\[\d+\]=[^\n]*;\n)+)  return 0;\n",
    re.MULTILINE,
)
PLACE = re.compile(r"\bw\[(\d+)\]")
LARGE_FUNCTION = 3000  # instructions, from which on loops are looked for


def generated(functions: Sequence[Any]) -> tuple[str, int]:
    """Return functions as C, without what CasADi adds for its own use, and the work array they need.

    No argument or result is ever left out, so none is asked for. Where functions are large, values stand in
    the work array, and long rows of statements become loops.
    """
    large = any(f.is_a("SXFunction") and f.n_instructions() > LARGE_FUNCTION for f in functions)
    with TemporaryDirectory() as folder:
        options: dict[str, Any] = {"casadi_int": "int", "casadi_real": "double", "avoid_stack": large}
        generator = ca.CodeGenerator("model.c", options)
        for function in functions:
            generator.add(function)
        path = generator.generate(f"{folder}/")
        text = Path(path).read_text(encoding="utf-8")
    text = WRITE.sub("res", READ.sub(r"arg[\1][\2];", AUXILIARY_FUNCTIONS.sub("", text)))
    working = (f for f in functions if f.get_function() or not f.is_a("SXFunction"))
    room = max((f.sz_w() for f in working), default=0)
    return _with_loops(PRELUDE + text, room) if large else (PRELUDE + text, room)


def _with_loops(text: str, room: int) -> tuple[str, int]:
    """Put loops where functions are rows of statements, and tell how much room they need, or more."""
    pieces: list[str] = []
    end = 0
    for number, match in enumerate(BODY.finditer(text)):
        parts, calls, needed = looped(match.group(1).splitlines(keepends=True), f"part_{number}")
        pieces += [text[end : match.start()], parts, text[match.start() : match.start(1)], calls]
        room, end = max(room, needed), match.end(1)
    pieces.append(text[end:])
    untouched = [int(place) for piece in pieces[::4] for place in PLACE.findall(piece)]
    return "".join(pieces), max([room, *(place + 1 for place in untouched)])
