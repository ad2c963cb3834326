"""`RunAsked`: what a run is asked for with, before it is known how it goes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..dae import DAE
from .settings import Settings

if TYPE_CHECKING:
    from ..results.result import Result


@dataclass(frozen=True, eq=False)
class RunAsked:
    """The arguments of `simulate`, looked at as far as that needs no equations."""

    dae: DAE
    settings: Settings
    start: Mapping[str, float]
    guess: Mapping[str, float]
    inputs: Mapping[str, Any]
    parameters: dict[str, float]
    sensitivities: tuple[str, ...]


RUNS: ContextVar[Callable[[RunAsked], Result] | None] = ContextVar("RUNS", default=None)
"""What computes the runs that are asked for in this context, if that is not each for itself."""
