"""One variable of an FMU, as its author declares it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

REAL_TYPES = ("Real", "Float64", "Float32")


@dataclass(frozen=True)
class ForeignVariable:
    """One variable of an FMU, as its author declares it; `type` is FMI's name of it.

    A `relative` one is a difference, for which the offset of its unit does not count. `choices` are the
    values of an enumeration by name.
    """

    name: str
    reference: int
    type: str
    causality: str
    variability: str
    initial: str
    unit: str
    start: str | None
    minimum: float
    maximum: float
    size: int
    text: str
    relative: bool
    choices: dict[str, int]

    @property
    def real(self) -> bool:
        """Whether it is a floating-point number."""
        return self.type in REAL_TYPES

    @property
    def is_signal(self) -> bool:
        """Whether it is one real number of double precision."""
        return self.type in ("Real", "Float64") and self.size == 1

    @property
    def settable(self) -> bool:
        """Whether a value can be given before the start."""
        chosen = self.causality == "input" or self.initial in ("exact", "approx")
        return chosen and self.variability != "constant"

    @property
    def columns(self) -> list[str]:
        """Names of its elements: its own, or `name[1]`, `name[2]`, ..., row by row."""
        return [self.name] if self.size == 1 else [f"{self.name}[{i + 1}]" for i in range(self.size)]


def foreign_variable(declared: Any, relative: bool) -> ForeignVariable:
    """Return a variable of FMPy's model description as ours; `relative` if it says so itself."""
    kind = declared.declaredType
    size = 1
    for length in declared.shape or ():
        size *= int(length)
    return ForeignVariable(
        declared.name, declared.valueReference, declared.type, declared.causality, declared.variability,
        declared.initial or "", declared.unit or (kind.unit if kind else None) or "", declared.start,
        float(_given(declared.min, kind and kind.min, "-inf")),
        float(_given(declared.max, kind and kind.max, "inf")),
        size, declared.description or "", relative or bool(kind and kind.relativeQuantity),
        {str(item.name): int(item.value) for item in (kind.items if kind else ())},
    )  # fmt: skip


def _given(*values: Any) -> Any:
    return next(value for value in values if value is not None)
