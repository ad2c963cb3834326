"""Expressions: a CasADi expression as Modelica text."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import casadi as ca

from ..base import ModelError
from ..components.language import called, written_out

LONGEST = 200_000  # characters of one expression
ATOM = re.compile(r"\w+(\.\w+)*(\(.*\))?|[\d.]+(e[+-]?\d+)?")
INFIX = {ca.OP_ADD: "+", ca.OP_SUB: "-", ca.OP_MUL: "*", ca.OP_DIV: "/", ca.OP_POW: "^", ca.OP_CONSTPOW: "^"}
PRODUCTS = (ca.OP_MUL, ca.OP_DIV, ca.OP_POW, ca.OP_CONSTPOW, ca.OP_SQ, ca.OP_TWICE)
RELATIONS = {ca.OP_LT: "<", ca.OP_LE: "<=", ca.OP_EQ: "==", ca.OP_NE: "<>"}
LOGIC = {ca.OP_AND: "and", ca.OP_OR: "or"}
CALLS = {
    ca.OP_SQRT: "sqrt", ca.OP_EXP: "exp", ca.OP_LOG: "log", ca.OP_SIN: "sin", ca.OP_COS: "cos",
    ca.OP_TAN: "tan", ca.OP_ASIN: "asin", ca.OP_ACOS: "acos", ca.OP_ATAN: "atan", ca.OP_SINH: "sinh",
    ca.OP_COSH: "cosh", ca.OP_TANH: "tanh", ca.OP_FLOOR: "floor", ca.OP_CEIL: "ceil", ca.OP_FABS: "abs",
    ca.OP_SIGN: "sign", ca.OP_FMIN: "min", ca.OP_FMAX: "max", ca.OP_ATAN2: "atan2", ca.OP_FMOD: "rem",
}  # fmt: skip
PATTERNS = {
    ca.OP_NEG: "-{0}",
    ca.OP_SQ: "{0}^2",
    ca.OP_TWICE: "2*{0}",
    ca.OP_INV: "1/{0}",
    ca.OP_LOG1P: "log(1 + {0})",
    ca.OP_EXPM1: "(exp({0}) - 1)",
    ca.OP_ASINH: "log({0} + sqrt({0}^2 + 1))",
    ca.OP_ACOSH: "log({0} + sqrt({0}^2 - 1))",
    ca.OP_ATANH: "(log(1 + {0}) - log(1 - {0}))/2",
    ca.OP_HYPOT: "sqrt({0}^2 + {1}^2)",
    ca.OP_COPYSIGN: "(if {1} < 0 then -abs({0}) else abs({0}))",
}


class Printer:
    """Writes expressions of symbols that have names in Modelica; `integers` are those of whole numbers."""

    def __init__(self, names: Mapping[int, str], integers: frozenset[int] = frozenset()) -> None:
        self._names, self._integers = names, integers
        self._known: dict[tuple[int, bool], str] = {}

    def number(self, expression: Any) -> str:
        """Return a real expression as text."""
        return self._text(ca.SX(expression), truth=False)

    def truth(self, expression: Any) -> str:
        """Return a condition as text."""
        return self._text(ca.SX(expression), truth=True)

    def equation(self, residual: Any) -> str:
        """Return `left = right` of what is to be zero."""
        residual = ca.SX(residual)
        if residual.n_dep() == 2 and residual.op() == ca.OP_SUB:
            return f"{self.number(residual.dep(0))} = {self.number(residual.dep(1))}"
        return f"{self.number(residual)} = 0"

    def _text(self, e: Any, truth: bool) -> str:
        key = e.element_hash(), truth
        if e.is_constant():
            return _constant(float(e), truth)
        if key not in self._known:
            self._known[key] = self._made(e, truth)
            if len(self._known[key]) > LONGEST:
                raise ModelError("an equation is too long to be written as Modelica text")
        return self._known[key]

    def _made(self, e: Any, truth: bool) -> str:
        if e.is_symbolic():
            name = self._names[e.element_hash()]
            return f"{name} <> 0" if truth else name
        if e.is_output() and (function := written_out(e.dep(0).which_function())):
            return self._text(_entry(e, function), truth)
        op = e.op()
        logical = self._logical(e, op)
        if logical:
            return logical if truth else f"(if {logical} then 1.0 else 0.0)"
        text = self._real(e, op)
        return f"{_bracketed(text)} <> 0" if truth else text

    def _logical(self, e: Any, op: int) -> str:
        if op == ca.OP_NOT:
            return f"not ({self.truth(e.dep(0))})"
        if op in LOGIC:
            return f"({self.truth(e.dep(0))}) {LOGIC[op]} ({self.truth(e.dep(1))})"
        if op not in RELATIONS:
            return ""
        both = [e.dep(0), e.dep(1)]
        whole = any(s.is_symbolic() and s.element_hash() in self._integers for s in both)
        sides = [str(int(s)) if whole and s.is_constant() else self._factor(s) for s in both]
        return f"{sides[0]} {RELATIONS[op]} {sides[1]}"

    def _real(self, e: Any, op: int) -> str:
        if op == ca.OP_ADD and (cases := _cases(e)):
            condition, yes, no = cases
            return f"(if {self.truth(condition)} then {self.number(yes)} else {self.number(no)})"
        if op == ca.OP_IF_ELSE_ZERO:
            return f"(if {self.truth(e.dep(0))} then {self.number(e.dep(1))} else 0)"
        parts = [e.dep(k) for k in range(e.n_dep())]
        if op in (ca.OP_ADD, ca.OP_SUB):
            right = self.number(parts[1])
            right = right if parts[1].n_dep() and parts[1].op() in PRODUCTS else _bracketed(right)
            return f"{self.number(parts[0])} {INFIX[op]} {right}"
        if op == ca.OP_MUL and parts[0].n_dep() and parts[0].op() == op:
            return f"{self.number(parts[0])}*{self._factor(parts[1])}"
        if op in INFIX:
            return INFIX[op].join(self._factor(part) for part in parts)
        if op in CALLS:
            return f"{CALLS[op]}({', '.join(map(self.number, parts))})"
        if op in PATTERNS:
            return PATTERNS[op].format(*map(self._factor, parts))
        raise ModelError(f"Modelica has no name for the function in `{e}`")

    def _factor(self, e: Any) -> str:
        return _bracketed(self.number(e))


def _entry(e: Any, function: Any) -> Any:
    """Return the entry that an expression is of what it calls, of a function that stands in for that."""
    return called(function, [e.dep(0).dep(k) for k in range(e.dep(0).n_dep())])[e.which_output()]


def _cases(e: Any) -> tuple[Any, Any, Any] | None:
    """Return condition and both cases of what `if_else` made, if it did."""
    yes, no = e.dep(0), e.dep(1)
    if not yes.n_dep() or not no.n_dep() or {yes.op(), no.op()} != {ca.OP_IF_ELSE_ZERO}:
        return None
    condition, other = yes.dep(0), no.dep(0)
    if other.n_dep() and other.op() == ca.OP_NOT and ca.is_equal(other.dep(0), condition, 5):
        return condition, yes.dep(1), no.dep(1)
    return None


def _bracketed(text: str) -> str:
    balanced = ATOM.fullmatch(text) and ("(" not in text or _closes_last(text))
    return text if balanced or _enclosed(text) else f"({text})"


def _enclosed(text: str) -> bool:
    return text.startswith("(") and _closes_last(text)


def _closes_last(text: str) -> bool:
    """Tell whether the first bracket of a text is closed by its last character."""
    depth = 0
    for place, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if character == ")" and not depth:
            return place == len(text) - 1
    return False


def _constant(value: float, truth: bool) -> str:
    if truth:
        return "true" if value else "false"
    return number(value)


def number(value: float) -> str:
    """Return a number as Modelica writes it."""
    if value != value or abs(value) == float("inf"):
        raise ModelError(f"Modelica has no number {value}")
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))
