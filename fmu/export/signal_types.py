"""Signal types: which variables of an FMU are Boolean or integer, since the blocks they come from say so."""

from __future__ import annotations

from collections.abc import Callable

from ...components.language import BooleanInput, BooleanOutput, Field, IntegerOutput, fields_of
from ...networks import DAE, Input


def type_of_variables(dae: DAE) -> Callable[[str], str]:
    """Return what tells the type of a variable by its name: "Real", "Boolean" or "Integer".

    A signal has the type of the output it comes from, whatever it goes to.
    """
    found: dict[int, tuple[str, int]] = {}
    for path, instance in dae.flat.instances.items():
        for declared in fields_of(instance.component, Field):
            if isinstance(declared, BooleanOutput | IntegerOutput):
                root, sign = dae.root(f"{path}.{declared.name}" if path else declared.name)
                found[root] = "Boolean" if isinstance(declared, BooleanOutput) else "Integer", sign

    def told(name: str) -> str:
        if dae.derived.unit(name) is not None:
            return "Real"
        root, sign = dae.root(name)
        kind, sign_there = found.get(root, ("Real", sign))
        return "Real" if kind == "Boolean" and sign != sign_there else kind  # -1 is no truth value

    return told


def type_of_input(dae: DAE, declared: Input) -> str:
    """Return "Boolean" for an input that a block takes as such, and no derivative of which is needed."""
    owner, _, name = declared.path.rpartition(".")
    taken = type(dae.flat.instances[owner].component).fields.get(name)
    moves = any(other.order and other.path == declared.path for other in dae.inputs)
    return "Boolean" if isinstance(taken, BooleanInput) and not moves else "Real"
