"""`Ranked`: a candidate that was fitted, what it does for the test runs, and why it was not accepted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..criteria import CERTAIN_RESIDUAL_SHARE, CLEAR_STANDARD_ERRORS
from ..effects.hypothesis import told
from ..search.model_comparison import Refit, clearness


@dataclass(frozen=True)
class Ranked:
    """A candidate that was fitted: what it does for the test runs, and the chance of that without it.

    Attributes:
        values: its parameters, fitted, in SI units.
        units: theirs.
    """

    kind: str
    site: str
    test_gain: float
    p: float
    values: Mapping[str, float] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def told(self) -> str:
        """Kind and site in words."""
        return told(self.kind, self.site)

    @property
    def parameters(self) -> str:
        """Its parameters in words."""
        units = {name: unit for name, unit in self.units.items() if unit != "1"}
        told = (f"{name} = {value:.4g} {units.get(name, '')}" for name, value in self.values.items())
        return ", ".join(part.rstrip() for part in told)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values, as in the JSON file."""
        named = {"kind": self.kind, "site": self.site, "parameters": dict(self.values)}
        return {**named, "test_gain": self.test_gain, "p": self.p}

    @property
    def standard_errors(self) -> float:
        """By how many standard errors, over the test runs, the model with it is the better one."""
        from scipy.stats import norm

        return float(norm.isf(self.p))

    @property
    def is_clear(self) -> bool:
        """Whether it does better than the scatter over the test runs."""
        return self.standard_errors >= CLEAR_STANDARD_ERRORS

    @property
    def refused(self) -> str:
        """Why it is not the verdict, by what it does for the test runs."""
        if self.test_gain <= 0:
            return "makes the test runs worse"
        if self.is_clear and self.test_gain >= CERTAIN_RESIDUAL_SHARE:
            return "is clear, but by what is left it looks like something else"
        if self.is_clear:
            return "is clear, but too little to be named"
        if self.standard_errors <= 0:
            return "most of these runs would be worse for"
        return (
            f"is {self.standard_errors:.2g} standard errors of the scatter over these runs, where "
            f"{CLEAR_STANDARD_ERRORS:g} are asked for"
        )


def ranked(fitted: Sequence[Refit], base: Refit, units: Sequence[Mapping[str, str]]) -> tuple[Ranked, ...]:
    """Return candidates that were fitted on top of a model, what does most for the test runs first."""
    from scipy.stats import norm

    before = base.blocks.sum()
    found = []
    for model, own in zip(fitted, units, strict=True):
        placed = model.effects[-1]
        gain, p = float(1 - model.blocks.sum() / before), float(norm.sf(clearness(base, model)))
        found.append(Ranked(*placed.key, gain, p, placed.values, own))
    return tuple(sorted(found, key=lambda one: -one.test_gain))
