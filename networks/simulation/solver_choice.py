"""Solver choice: what "auto" stands for, decided here for runs, fits, sweeps and diagnoses alike.

A model is compiled where that pays: once so many runs of it are foreseen, or its runs by CVODES or IDAS have
taken as long, as compiling takes. It is compiled beside the run that goes on, for those that follow, and kept
for other processes, which use it from their first run on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from time import thread_time
from weakref import WeakKeyDictionary

import casadi as ca

from ...base import ModelError
from ...base.kept_files import kept_files
from ..dae import DAE
from ..flattening.flat import Flat
from .bound_dae import BoundDAE
from .settings import Settings, Tolerance

WORTH_COMPILING = 40_000  # samples of all runs that are foreseen
COMPILE_SECONDS = 0.25  # of a small model, twice what it takes where the core is kept
WRITE_SECONDS = 3e-5  # to write an instruction of a model as C
SOON = 0.05  # s that writing may take before a first run, if what looks like it was worth compiling before
FINEST_COMPILED = 1e-10  # relative tolerance; for less, methods of a higher order pay
HYBRID_SHARE = 1 / 32  # of the tolerance, by which compiled hybrid runs are as exact as those by CVODES
_FORESEEN: WeakKeyDictionary[Flat, int] = WeakKeyDictionary()
_ACCOUNTS: WeakKeyDictionary[Flat, dict[str, Account]] = WeakKeyDictionary()


@dataclass(frozen=True)
class Choice:
    """By what a run goes: compiled, to a tolerance, or interpreted; and why.

    What an interpreted run costs goes on the `account` of its model, if that may be compiled one day.
    """

    compiled: bool
    why: str
    tolerance: Tolerance
    account: Account | None = None


@dataclass(eq=False)
class Account:
    """What interpreted runs of a model have cost in this process, and what speaks `against` compiling it.

    Attributes:
        writing: how long it takes to write the model as C [s].
        spent: on runs that have not paid for a compilation yet [s].
        last: on the last run [s].
        patience: how much may be spent until it is looked for again among what is kept [s].
        known: whether it was found there, or compiled here.
    """

    writing: float
    spent: float = 0.0
    last: float = 0.0
    against: str = ""
    patience: float = 0.0
    known: bool = False

    @property
    def worth(self) -> float:
        """Time of runs for which compiling pays [s]."""
        return COMPILE_SECONDS + self.writing

    @contextmanager
    def paying(self, closed: BoundDAE) -> Iterator[Callable[[], None]]:
        """Count an interpreted run; yields what, called on its way, begins to compile once that pays."""
        began = thread_time()

        def look_up() -> None:
            if self.spent + thread_time() - began >= self.worth:
                self._begin(closed)

        try:
            yield look_up
        finally:
            self.last = thread_time() - began
            self.spent += self.last

    def told(self, closed: BoundDAE) -> tuple[bool, str]:
        """Tell whether a run goes compiled, by what runs before it have taken, and why."""
        if not self.against and ("native" in vars(closed) or self._is_at_hand(closed)):
            return self.load(closed, "it was compiled before")
        if self.spent >= self.worth:
            self._begin(closed)
        if self.against:
            return False, self.against
        if not (self.known and closed.program.is_begun):
            spent = f"its runs have taken {self.spent:.2g} s"
            return False, f"{spent}, and compiling pays from {self.worth:.2g} s on"
        if self.last > self.worth:
            return self.load(closed, f"its last run took {self.last:.2g} s")
        return False, "it is being compiled for later runs"

    def load(self, closed: BoundDAE, why: str) -> tuple[bool, str]:
        """Compile a model, unless that was done, and load it; tell whether that went well, and why (not)."""
        with self._noting():
            _ = closed.native
        return not self.against, self.against or why

    def _is_at_hand(self, closed: BoundDAE) -> bool:
        """Tell whether a model only needs to be loaded."""
        if self.known:
            ready = False
            with self._noting():
                ready = closed.program.is_ready(closed)
            return ready
        if self.spent < self.patience or self.writing > max(SOON, self.spent):
            return False
        self.patience = 2.0 * self.spent + SOON
        if not kept_files().holds(closed.mark):
            return False
        with self._noting():
            self.known = closed.program.is_ready(closed)
        return self.known

    def _begin(self, closed: BoundDAE) -> None:
        """Let a model be compiled beside what goes on, for what runs have cost."""
        if self.against or (self.known and closed.program.is_begun):
            return
        self.known, self.spent = True, max(0.0, self.spent - self.worth)
        with self._noting():
            closed.program.begin(closed)

    @contextmanager
    def _noting(self) -> Iterator[None]:
        """Note what speaks against compiling: no compiler, functions that cannot be written as C, no disk."""
        try:
            yield
        except (ModelError, OSError, RuntimeError) as error:
            self.against = str(error).partition("\n")[0]


def foresee(dae: DAE, samples: int) -> None:
    """Note how many samples all runs of a model will come to, with tolerances that are chosen for them."""
    _FORESEEN[dae.flat] = samples


def chosen(closed: BoundDAE, settings: Settings, followed: bool) -> Choice:
    """Return by what a run goes; `followed` tells whether it follows sensitivities."""
    asked, tolerance = settings.solver, settings.tolerance
    if asked != "auto":
        return Choice(asked == "compiled", "it was asked for", tolerance)
    against = _against(closed, tolerance, followed)
    if against:
        return Choice(False, against, tolerance)
    account, foreseen = _account(closed), _FORESEEN.get(closed.dae.flat, 0)
    if foreseen >= WORTH_COMPILING and not account.against:
        compiled, why = account.load(closed, f"runs of {foreseen} samples are foreseen")
    else:
        compiled, why = account.told(closed)
    if compiled:
        tolerance = compiled_tolerance(closed.dae, settings)
    return Choice(compiled, why, tolerance, account)


def compiled_tolerance(dae: DAE, settings: Settings) -> Tolerance:
    """Return to what tolerance a run goes if it goes compiled."""
    closer = settings.solver == "auto" and dae.hybrid and not _FORESEEN.get(dae.flat, 0)
    return settings.tolerance.times(HYBRID_SHARE) if closer else settings.tolerance


def against_compiling(closed: BoundDAE, settings: Settings) -> str:
    """Say what speaks against compiling a run that follows no sensitivities; nothing if it was asked for."""
    if settings.solver == "compiled":
        return ""
    return _against(closed, settings.tolerance, followed=False) or _account(closed).against


def _against(closed: BoundDAE, tolerance: Tolerance, followed: bool) -> str:
    """Say what only CVODES and IDAS can do."""
    if followed and not closed.dae.hybrid:
        return "sensitivities are followed"
    if closed.courses:
        return f"input '{next(iter(closed.courses))}' is a Polynomial"
    return f"rtol is below {FINEST_COMPILED:g}" if tolerance.rtol < FINEST_COMPILED else ""


def _account(closed: BoundDAE) -> Account:
    known = _ACCOUNTS.setdefault(closed.dae.flat, {})
    if closed.mark not in known:
        dae = closed.dae
        laws = ca.vertcat(dae.ode, dae.alg, dae.switching.expressions)
        known[closed.mark] = Account(
            WRITE_SECONDS * ca.Function("laws", dae.arguments(), [laws]).n_instructions()
        )
    return known[closed.mark]
