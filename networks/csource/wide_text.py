"""Wide text: CasADi functions as C over the vector type `wide` of wide.h, an instruction a line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca

MOST_INSTRUCTIONS = 3000  # of a function; longer ones overflow what a processor keeps at hand
# By operation: what is written of operands a and b.
NUMBERS = {
    ca.OP_ASSIGN: "{a}", ca.OP_ADD: "{a} + {b}", ca.OP_SUB: "{a} - {b}", ca.OP_MUL: "{a} * {b}",
    ca.OP_DIV: "{a} / {b}", ca.OP_NEG: "-{a}", ca.OP_SQ: "{a} * {a}", ca.OP_TWICE: "{a} + {a}",
    ca.OP_INV: "all(1) / {a}", ca.OP_CONSTPOW: "wide_pow({a}, {b})",
}  # fmt: skip
CALLED = {
    ca.OP_EXP: "exp", ca.OP_LOG: "log", ca.OP_POW: "pow", ca.OP_SQRT: "sqrt", ca.OP_SIN: "sin",
    ca.OP_COS: "cos", ca.OP_TAN: "tan", ca.OP_ASIN: "asin", ca.OP_ACOS: "acos", ca.OP_ATAN: "atan",
    ca.OP_SINH: "sinh", ca.OP_COSH: "cosh", ca.OP_TANH: "tanh", ca.OP_ASINH: "asinh",
    ca.OP_ACOSH: "acosh", ca.OP_ATANH: "atanh", ca.OP_ATAN2: "atan2", ca.OP_FLOOR: "floor",
    ca.OP_CEIL: "ceil", ca.OP_FMOD: "fmod", ca.OP_FABS: "fabs", ca.OP_SIGN: "sign",
    ca.OP_COPYSIGN: "copysign", ca.OP_ERF: "erf", ca.OP_FMIN: "fmin", ca.OP_FMAX: "fmax",
    ca.OP_LOG1P: "log1p", ca.OP_EXPM1: "expm1", ca.OP_HYPOT: "hypot", ca.OP_REMAINDER: "remainder",
}  # fmt: skip
COMPARED = {ca.OP_LT: "{a} < {b}", ca.OP_LE: "{a} <= {b}", ca.OP_EQ: "{a} == {b}", ca.OP_NE: "{a} != {b}"}
JOINED = {ca.OP_NOT: "~{a}", ca.OP_AND: "{a} & {b}", ca.OP_OR: "{a} | {b}"}
HEAD = "static void {}(const wide **arg, wide **res) {{\n"


def can_be_wide(function: Any) -> bool:
    """Tell whether a function is a row of so many instructions, each of which has a vector form."""
    if not function.is_a("SXFunction") or function.n_instructions() > MOST_INSTRUCTIONS:
        return False
    known = {
        *NUMBERS,
        *CALLED,
        *COMPARED,
        *JOINED,
        ca.OP_IF_ELSE_ZERO,
        ca.OP_INPUT,
        ca.OP_OUTPUT,
        ca.OP_CONST,
    }
    return all(function.instruction_id(k) in known for k in range(function.n_instructions()))


def wide_text(functions: Sequence[Any]) -> str:
    """Return functions in C, named `wide_...` for `model_...`, that take and give pointers as CasADi's do."""
    return "".join(_written(function) for function in functions)


def _written(function: Any) -> str:
    lines = [HEAD.format(function.name().replace("model_", "wide_", 1))]
    held: dict[int, tuple[str, bool]] = {}  # by place: the name of its value, and whether that is a mask
    for k in range(function.n_instructions()):
        operation, into, of = (
            function.instruction_id(k), function.instruction_output(k), function.instruction_input(k)
        )  # fmt: skip
        if operation == ca.OP_OUTPUT:
            lines.append(f"    res[{into[0]}][{into[1]}] = {_number(held[of[0]])};\n")
            continue
        is_mask = operation in COMPARED or operation in JOINED
        if operation == ca.OP_INPUT:
            text = f"arg[{of[0]}][{of[1]}]"
        elif operation == ca.OP_CONST:
            text = f"all({_constant(function.instruction_constant(k))})"
        else:
            text = _applied(operation, [held[place] for place in of])
        lines.append(f"    const {'mask' if is_mask else 'wide'} v{k} = {text};\n")
        held[into[0]] = f"v{k}", is_mask
    return "".join([*lines, "}\n\n"])


def _applied(operation: int, operands: list[tuple[str, bool]]) -> str:
    if operation == ca.OP_IF_ELSE_ZERO:
        return f"only({_mask(operands[0])}, {_number(operands[1])})"
    if operation in JOINED:
        return JOINED[operation].format(**dict(zip("ab", map(_mask, operands), strict=False)))
    numbers = [_number(operand) for operand in operands]
    if operation in CALLED:
        return f"wide_{CALLED[operation]}({', '.join(numbers)})"
    return {**NUMBERS, **COMPARED}[operation].format(**dict(zip("ab", numbers, strict=False)))


def _number(operand: tuple[str, bool]) -> str:
    return f"one({operand[0]})" if operand[1] else operand[0]


def _mask(operand: tuple[str, bool]) -> str:
    return operand[0] if operand[1] else f"nonzero({operand[0]})"


def _constant(value: float) -> str:
    named = {"inf": "INFINITY", "-inf": "-INFINITY", "nan": "NAN"}
    return named.get(repr(value), repr(value))
