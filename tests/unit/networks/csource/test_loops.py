"""Large functions as loops: the same numbers as CasADi's, in few statements."""

import ctypes
from ctypes import POINTER, c_double
from itertools import pairwise
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pytest
from inertance.networks import compile_shared
from inertance.networks.csource.text import generated
from inertance.networks.csource.toolchain import ToolchainError, compiler

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

COUNT = 600


def row(x: Any, p: Any) -> Any:
    """Forces of springs in a row: one form repeated, with another at the ends."""
    force = [p[k] * (x[k + 1] - x[k]) + p[k + 1] * ca.sin(x[k]) for k in range(COUNT - 1)]
    return ca.vertcat(force[0], *(b - a for a, b in pairwise(force)), -force[-1])


def odd(x: Any, p: Any) -> Any:
    """All kinds of operations, results that are read again, copies, constants and a long sum."""
    turned = [x[(7 * k) % COUNT] for k in range(COUNT)]
    bent = [ca.if_else(a > -0.5, ca.fmax(a, p[k]) ** 2, -3.0 * a) for k, a in enumerate(turned)]
    total = sum(bent)
    rows = [b / (2.0 + total**2) - 1.5 for b in bent]
    return ca.vertcat(*rows, total, total, x[3], 4.0, -p[5], ca.atan2(bent[1], bent[2]))


def compiled(function: Any, folder: Path) -> tuple[Any, str, int]:
    """Return a function as compiled from its text, with that text and the room it needs."""
    text, room = generated([function])
    name, shape = function.name(), "(const double **arg, double **res, int *iw, double *w, int mem)"
    shown = f"int shown{shape} {{ return {name}(arg, res, iw, w, mem); }}"
    shown = f'__attribute__((visibility("default"))) {shown}'
    (folder / f"{name}.c").write_text(f"#include <math.h>\nint {name}{shape};\n{text}{shown}\n")
    path = compile_shared([folder / f"{name}.c"], folder / f"{name}.so", flags=["-Wall"])
    library = ctypes.CDLL(str(path))
    return library.shown, text, room


def _pointer(array: Any) -> Any:
    return array.ctypes.data_as(POINTER(c_double))


def _pointers(arrays: list[Any]) -> Any:
    return (POINTER(c_double) * len(arrays))(*map(_pointer, arrays))


@pytest.mark.parametrize("law", [row, odd])
def test_loops_compute_what_casadi_does(law: Any, tmp_path: Path) -> None:
    x, p = ca.SX.sym("x", COUNT), ca.SX.sym("p", COUNT)
    value = law(x, p)
    function = ca.Function(law.__name__, [x, p], [ca.densify(value), x + p], {"cse": True})
    assert function.n_instructions() > 3000
    call, _, room = compiled(function, tmp_path)
    random = np.random.default_rng(1)
    for _ in range(3):
        given = [random.normal(size=COUNT) for _ in "xp"]
        results = [np.full(function.numel_out(k), np.nan) for k in range(2)]
        work = np.zeros(room)
        arguments, outcomes = (_pointers(arrays) for arrays in (given, results))
        call(arguments, outcomes, None, _pointer(work), 0)
        for result, wanted in zip(results, function(*given), strict=True):
            assert result == pytest.approx(np.asarray(wanted).ravel(), rel=1e-13, abs=1e-13)


def test_what_repeats_is_one_statement(tmp_path: Path) -> None:
    x, p = ca.SX.sym("x", COUNT), ca.SX.sym("p", COUNT)
    many = ca.vertcat(*(row(x + k, p) for k in range(3)))
    function = ca.Function("springs", [x, p], [many], {"cse": True})
    assert function.n_instructions() > 3000
    _, text, room = compiled(function, tmp_path)
    statements = [line for line in text.splitlines() if "]=" in line]
    assert len(statements) < 40
    assert f"k < {COUNT - 2}" in text
    assert room < 6 * COUNT
