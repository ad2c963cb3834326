"""Instructions: what an SX function does, operation by operation, and the same done anew."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import casadi as ca

from ...components.language import called, written_out


class Instruction(NamedTuple):
    """An operation: its number, which it is, where to and from where, its constant, and what it calls."""

    number: int
    operation: int
    into: list[int]
    of: list[int]
    constant: float
    called: Any = None

    def applied(self, operands: Sequence[Any]) -> list[Any]:
        """Return what it makes of operands."""
        if self.called is not None:
            return called(self.called, operands)
        apply = ca.SX.unary if len(operands) == 1 else ca.SX.binary
        return [apply(self.operation, *operands)]

    @property
    def is_closed(self) -> bool:
        """Whether it calls a function of which nothing but its numbers is known."""
        return self.called is not None and not self.called.is_a("SXFunction")

    @property
    def written_out(self) -> Instruction:
        """The same, calling a function with all pieces that the one it calls looks up, if that does."""
        found = self.called and written_out(self.called)
        return self._replace(called=found) if found else self


Apply = Callable[[Instruction, Sequence[Any]], list[Any]]


def instructions(function: Any) -> list[Instruction]:
    """Return the operations of an SX function."""
    found = []
    nodes = function.instructions_sx() if function.get_function() else []
    for k in range(function.n_instructions()):
        operation = function.instruction_id(k)
        constant = function.instruction_constant(k) if operation == ca.OP_CONST else 0.0
        asked = nodes[k].which_function() if operation == ca.OP_CALL else None
        into, of = function.instruction_output(k), function.instruction_input(k)
        found.append(Instruction(k, operation, into, of, constant, asked))
    return found


def replayed(function: Any, arguments: Sequence[Any], apply: Apply) -> list[Any]:
    """Return the results of an SX function for SX arguments, each operation done by `apply`.

    Symbols that are none of its arguments stay.
    """
    results = _room(function)
    _replay(function, [argument.nz[:].nonzeros() for argument in arguments], results, apply)
    return _shaped(function, results)


def put_in(symbols: Any, definitions: Any, others: Sequence[Any], calling: bool) -> tuple[Any, list[Any]]:
    """Put definitions of symbols, each in terms of those before it, into each other and into others.

    Where these are `calling` functions they are replayed, each symbol read as what it has become: CasADi
    3.8.2 loses calls where it does the same.
    """
    if not calling:
        replaced: Any = ca.substitute_inplace([symbols], [definitions], [*others])
        return replaced[0][0], replaced[1]
    expressions = [ca.densify(definitions), *others]
    function = ca.Function("defined", [symbols], expressions, {"allow_free": True})
    results = _room(function)
    _replay(function, results[:1], results, Instruction.applied)
    first, *rest = _shaped(function, results)
    return first, rest


def with_pieces_written(function: Any) -> Any:
    """Return an SX function that holds all the pieces that one looks up; itself if it looks up none."""
    if not (function.is_a("SXFunction") and function.get_function()):
        return function
    arguments = [ca.SX.sym("given", function.sparsity_in(k)) for k in range(function.n_in())]
    results = replayed(function, arguments, lambda one, operands: one.written_out.applied(operands))
    return ca.Function(function.name(), arguments, results, function.name_in(), function.name_out())


def _room(function: Any) -> list[list[Any]]:
    return [[None] * function.nnz_out(k) for k in range(function.n_out())]


def _shaped(function: Any, results: Sequence[Sequence[Any]]) -> list[Any]:
    shapes = map(function.sparsity_out, range(function.n_out()))
    return [ca.SX(shape, ca.vertcat(*entries)) for shape, entries in zip(shapes, results, strict=True)]


def _replay(
    function: Any, arguments: Sequence[Sequence[Any]], results: Sequence[list[Any]], apply: Apply
) -> None:
    """Fill results with what a function makes of arguments, entry by entry, in its order."""
    free = iter(function.free_sx())
    work: dict[int, Any] = {}
    for instruction in instructions(function):
        operation, into, of = instruction.operation, instruction.into, instruction.of
        if operation == ca.OP_OUTPUT:
            results[into[0]][into[1]] = work[of[0]]
        elif operation == ca.OP_INPUT:
            work[into[0]] = arguments[of[0]][of[1]]
        elif operation == ca.OP_CONST:
            work[into[0]] = ca.SX(instruction.constant)
        elif operation == ca.OP_PARAMETER:
            work[into[0]] = next(free)
        else:
            work.update(zip(into, apply(instruction, [work[place] for place in of]), strict=True))
