"""Functions over vectors of numbers: every operation gives in each lane what CasADi gives for one number."""

import ctypes
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.networks.csource import wide_text as wide
from inertance.networks.csource.toolchain import ToolchainError, compile_shared, compiler

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

SHIM = """
__attribute__((visibility("default"))) int lanes(void) { return LANES; }
__attribute__((visibility("default"))) void evaluate(const double *in, double *out, int n, int m) {
    wide given[8], found[128];
    memset(given, 0, sizeof given);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < LANES; k++) given[i][k] = in[i * LANES + k];
    wide_all((const wide *[]){given}, (wide *[]){found});
    for (int i = 0; i < m; i++)
        for (int k = 0; k < LANES; k++) out[i * LANES + k] = found[i][k];
}
"""


def operations(a: Any, b: Any) -> list[Any]:
    """Every operation there is, of numbers that may be anything."""
    positive, inside = a * a + 0.1, 0.9 * ca.sin(a)
    compared = [
        a < b,
        a <= b,
        ca.eq(a, b),
        ca.ne(a, b),
        ca.logic_and(a > 0, b > 0),
        ca.logic_or(a > 0, b > 0),
    ]
    chosen = [ca.if_else(a < b, a, b * b), ca.if_else(a, 2.0, b), ca.if_else(ca.logic_not(a < 0), a, 7.0)]
    rational = [a + b, a - b, a * b, a / (b + 10), -a, a * a, 2 * a, 1 / (a + 20), 3.5 * a, a - 0.0]
    cornered = [ca.fabs(a), ca.sign(a), ca.fmin(a, b), ca.fmax(a, b), ca.floor(a), ca.ceil(a), ca.fmod(a, 3)]
    smooth = [f(a / 5) for f in (ca.sin, ca.cos, ca.tan, ca.exp, ca.sinh, ca.cosh, ca.tanh, ca.atan, ca.erf)]
    bounded = [f(inside) for f in (ca.asin, ca.acos, ca.atanh, ca.asinh, ca.log1p, ca.expm1)]
    of_positive = [f(positive) for f in (ca.sqrt, ca.log)] + [
        positive**b,
        positive**1.7,
        ca.acosh(positive + 1),
    ]
    pairs = [ca.atan2(a, b), ca.copysign(a, b), ca.hypot(a, b), ca.remainder(a, 3)]
    return [*compared, *chosen, *rational, *cornered, *smooth, *bounded, *of_positive, *pairs]


def compiled(function: Any, folder: Path, *flags: str) -> Any:
    text = '#include "wide.h"\n' + wide.wide_text([function]) + SHIM
    (folder / "all.c").write_text(text)
    here = Path(wide.__file__).parent
    made = compile_shared([folder / "all.c"], folder / "all.so", include=[here], flags=("-O1", *flags))
    return ctypes.CDLL(str(made))


@pytest.mark.parametrize("flags", [("-march=native",), ()], ids=["native", "any"])
def test_every_operation(tmp_path: Path, flags: tuple[str, ...]) -> None:
    pair = ca.SX.sym("pair", 2)
    function = ca.Function("model_all", [pair], [ca.vertcat(*operations(*ca.vertsplit(pair)))], {"cse": True})
    assert wide.can_be_wide(function)
    library = compiled(function, tmp_path, *flags)
    lanes, count = library.lanes(), function.nnz_out(0)
    special = [0.0, -0.0, 1.0, -1.0, 1e-300, -3.0, 17.25, -2.5]
    points = np.array([[a, b] for a in special for b in special] + [[-7.3, 8.1], [0.3, -9.9]] * 4)
    for rows in points.reshape(-1, lanes, 2):
        given, found = np.ascontiguousarray(rows.T), np.empty((count, lanes))
        library.evaluate(*(ctypes.c_void_p(array.ctypes.data) for array in (given, found)), 2, count)
        wanted = np.array([function(row).full().ravel() for row in rows]).T
        assert found == pytest.approx(wanted, rel=2e-15 * 8, abs=1e-300)


def test_what_is_no_number_stays_in_its_lane(tmp_path: Path) -> None:
    """A lane whose equations break down leaves the others alone, and a branch not taken leaves its own."""
    pair = ca.SX.sym("pair", 2)
    a, b = ca.vertsplit(pair)
    values = ca.vertcat(a / b, ca.if_else(b > 0, ca.log(b), 5.0), ca.fmax(a, b), ca.sign(a))
    library = compiled(ca.Function("model_all", [pair], [values]), tmp_path, "-march=native")
    lanes = library.lanes()
    given, found = np.ones((2, lanes)), np.empty((4, lanes))
    given[:, 1] = np.nan, 2.0
    given[:, 2] = 1.0, 0.0
    given[:, 3] = 3.0, -1.0
    library.evaluate(*(ctypes.c_void_p(array.ctypes.data) for array in (given, found)), 2, 4)
    assert found[:, 0].tolist() == [1.0, 0.0, 1.0, 1.0]
    assert np.isnan(found[[0, 3], 1]).all()
    assert found[2, 1] == 2.0
    assert found[:2, 2].tolist() == [np.inf, 5.0]
    assert found[:, 3].tolist() == [-3.0, 5.0, 3.0, 1.0]


def test_long_functions_and_data_inside_them_are_left_to_scalar_code() -> None:
    x, t = ca.SX.sym("x"), ca.MX.sym("t")
    long = x
    for _ in range(wide.MOST_INSTRUCTIONS):
        long = ca.sin(long) + 1
    data = ia.Sampled(np.arange(4.0), np.arange(4.0) ** 2)
    table = ca.interpolant("table", "linear", [data.time], data.values)(t)
    assert not wide.can_be_wide(ca.Function("model_long", [x], [long]))
    assert not wide.can_be_wide(ca.Function("model_data", [t], [table]))
