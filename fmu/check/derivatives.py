"""Derivatives that an FMU gives, against differences of what it computes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...base import Array
from ..errors import FMUError
from .probe import Probe, Subject
from .report import Finding, measured

LIMIT = 1e-6
STRIDES = 10.0 ** -np.arange(1, 11)
ROUNDING = 64 * np.finfo(float).eps
RESOLVED = 0.1 * LIMIT
STILL = 1e-6
LEAST_STRIDDEN = 1e-3
MOST_KNOWNS = 60
MOST_MODES = 8


@dataclass(eq=False)
class Derivatives:
    """Looks at the derivatives of Model Exchange, once in every mode that a run visits.

    Called with a probe at an instant of the run, it leaves the probe as it was.
    """

    subject: Subject
    discrete: list[str] = field(init=False)
    modes: list[tuple[float, ...]] = field(default_factory=list)
    forward: tuple[float, str] = (0.0, "")
    adjoint: tuple[float, str] = (0.0, "")
    _last: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        fmu = self.subject.fmu
        self.discrete = self.subject.discrete()
        self.able = fmu.capable("ME", "providesDirectionalDerivative")
        self.backward = fmu.capable("ME", "providesAdjointDerivatives")
        variables = fmu.variables
        rates = [u.variable.name for u in fmu.description.derivatives]
        outputs = [
            n for n, v in fmu.outputs.items() if v.real and v.size == 1 and v.variability == "continuous"
        ]
        self.unknowns = list(dict.fromkeys([*rates, *outputs]))
        inputs = [
            n for n, v in fmu.inputs.items() if v.real and v.size == 1 and v.variability == "continuous"
        ]
        self.knowns = [*fmu.states, *inputs]
        self.states = len(fmu.states)
        self.nominals = np.maximum(self.subject.nominals(self.knowns), LEAST_STRIDDEN)
        self._rows = [variables[n].reference for n in self.unknowns]
        self._columns = [variables[n].reference for n in self.knowns]

    def __call__(self, probe: Probe, t: float) -> None:
        """Look, if the mode is one not seen before and the run has stayed in it since the last call."""
        if not self.able or not self.unknowns or len(self.modes) >= MOST_MODES:
            return
        mode = (*probe.values(self.discrete), *np.sign(probe.watched()))
        stays, self._last = mode == self._last, mode
        if not stays or mode in self.modes:
            return
        self.modes.append(mode)
        self._look(probe, t)

    def _look(self, probe: Probe, t: float) -> None:
        x, u = np.array(probe.states()), probe.values(self.knowns[self.states :])
        base = np.concatenate([x, u])
        for place in _spread(len(self.knowns)):
            seed = np.zeros(len(self.knowns))
            seed[place] = 1.0
            exact = probe.directional(self._rows, [self._columns[place]], [1.0])
            scale = max(abs(base[place]), self.nominals[place])
            error, row = self._compared(probe, t, base, seed, exact, scale)
            if error > self.forward[0]:
                told = f"{self.unknowns[row]} by {self.knowns[place]} at {t:.6g} s"
                self.forward = (error, told)
        if self.backward and self.knowns:
            self._reversed(probe, t)
        self._set(probe, t, base)

    def _compared(
        self, probe: Probe, t: float, base: Array, seed: Array, exact: Array, scale: float
    ) -> tuple[float, int]:
        """Return the least error over the strides that resolve it, of the unknown where that is greatest.

        A stride resolves a derivative if rounding errors of the difference are a tenth of the limit at most,
        or if nothing at all changes over a millionth of the known's size; where none does, because nothing
        depends on the known, rounding errors are forgiven.
        """
        best = np.full((2, len(self.unknowns)), np.inf)
        for h in STRIDES * scale:
            try:
                ahead, behind = (self._moved(probe, t, base + side * h * seed) for side in (1, -1))
            except FMUError:
                continue
            difference = (ahead - behind) / (2 * h)
            size = np.maximum(np.maximum(np.abs(exact), np.abs(difference)), 1e-300)
            rounding = ROUNDING * np.maximum(np.abs(ahead), np.abs(behind)) / h / size
            error = np.abs(exact - difference) / size
            resolved = (rounding <= RESOLVED) | ((error == 0) & (h >= STILL * scale))
            best[0] = np.where(resolved, np.fmin(best[0], error), best[0])
            best[1] = np.fmin(best[1], np.maximum(error - rounding, 0))
        least = np.where(np.isfinite(best[0]), best[0], best[1])
        worst = int(np.argmax(least))
        return float(least[worst]), worst

    def _moved(self, probe: Probe, t: float, point: Array) -> Array:
        self._set(probe, t, point)
        return probe.values(self.unknowns)

    def _set(self, probe: Probe, t: float, point: Array) -> None:
        probe.put(t, point[: self.states])
        for name, value in zip(self.knowns[self.states :], point[self.states :], strict=True):
            variable = self.subject.fmu.variables[name]
            probe.set((variable.type, [variable.reference], 1), [value])

    def _reversed(self, probe: Probe, t: float) -> None:
        """Hold w.(J v) = (w J).v, for a few v and w."""
        numbers = np.random.default_rng(1)
        for _ in range(3):
            v = numbers.normal(size=len(self._columns)) * self.nominals
            forward = probe.directional(self._rows, self._columns, v)
            w = numbers.normal(size=len(self._rows)) / np.maximum(np.abs(forward), 1e-300)
            w[forward == 0] = 0
            found = probe.adjoint(self._rows, self._columns, w) * v
            error = abs(found.sum() - w @ forward) / max(
                np.abs(found).sum(), np.abs(w * forward).sum(), 1e-300
            )
            if error > self.adjoint[0]:
                self.adjoint = (float(error), f"at {t:.6g} s")

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        label = self.subject.label("ME")
        kinds = [("directional derivatives", self.able, self.forward)]
        if self.subject.fmu.version[0] == "3":
            kinds.append(("adjoint derivatives", self.backward, self.adjoint))
        for check, able, (error, told) in kinds:
            if not able:
                yield Finding(label, check, None, told="the FMU gives none")
            elif not self.modes:
                yield Finding(label, check, None, told="the run is too short to look at any")
            else:
                count = f"{len(self.modes)} mode{'s' if len(self.modes) > 1 else ''}"
                yield measured(label, check, error, LIMIT, f"{told}; {count}" if told else count)


def _spread(count: int) -> Sequence[int]:
    """Return which knowns are looked at: all, or some from first to last."""
    return sorted({int(k) for k in np.linspace(0, count - 1, min(count, MOST_KNOWNS))}) if count else []
