"""Derivatives that an FMU gives, against differences of what it computes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ...base import Array
from ..errors import FMUError
from ..foreign.variable import ForeignVariable
from .probe import CheckedFMU, Probe
from .report import Finding, measured

LIMIT = 1e-6
STRIDES = 10.0 ** -np.arange(1, 11)  # of central differences, of a known's size
ROUNDING = 64 * np.finfo(float).eps
LEFT_OPEN = 0.1 * LIMIT  # by a difference that resolves a derivative
UNCHANGED_STRIDE = 1e-6
SMALLEST_SIZE = 1e-3  # of a known, against which strides are long
KNOWNS_COMPARED = 60
MODES_VISITED = 8


class Derivatives:
    """Looks at the derivatives of Model Exchange, once in every mode that a run visits.

    Called with a probe at an instant of the run, it leaves the probe as it was.
    """

    def __init__(self, fmu: CheckedFMU) -> None:
        self.fmu, self.discrete = fmu, fmu.discrete()
        self.able = fmu.capable("ME", "providesDirectionalDerivative")
        self.backward = fmu.capable("ME", "providesAdjointDerivatives")
        rates = [u.variable.name for u in fmu.description.derivatives]
        self.unknowns = list(dict.fromkeys([*rates, *_moving(fmu.outputs)]))
        self.knowns, self.states = [*fmu.states, *_moving(fmu.inputs)], len(fmu.states)
        self.nominals = np.maximum(fmu.nominals(self.knowns), SMALLEST_SIZE)
        self.modes: list[tuple[float, ...]] = []
        self.forward = self.adjoint = (0.0, "")  # greatest error, and where
        self._last: tuple[float, ...] = ()
        self._rows, self._columns = (
            [fmu.variables[n].reference for n in names] for names in (self.unknowns, self.knowns)
        )

    def __call__(self, probe: Probe, t: float) -> None:
        """Look, if the mode is one not seen before and the run has stayed in it since the last call."""
        if not self.able or not self.unknowns or len(self.modes) >= MODES_VISITED:
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
            self._set(probe, t, base)
            exact = probe.directional(self._rows, [self._columns[place]], [1.0])
            scale = max(abs(base[place]), self.nominals[place])
            error, row = self._compared(probe, t, base, seed, exact, scale)
            if error > self.forward[0]:
                told = f"{self.unknowns[row]} by {self.knowns[place]} at {t:.6g} s"
                self.forward = (error, told)
        self._set(probe, t, base)
        if self.backward and self.knowns:
            self._reversed(probe, t)

    def _compared(
        self, probe: Probe, t: float, base: Array, seed: Array, exact: Array, scale: float
    ) -> tuple[float, int]:
        """Return the error at the strides that resolve it, of the unknown where that is greatest.

        What a difference leaves open are rounding errors, and what a stride ten times as long changes: the
        bending of the law, or noise. A stride resolves a derivative if that is a tenth of the limit at most,
        or if nothing at all changes over a millionth of the known's size. Where none does, because nothing
        depends on the known, or little near rest, what they leave open is forgiven.
        """
        least, beyond = np.full((2, len(self.unknowns)), np.inf)
        wider = np.full(len(self.unknowns), np.nan)
        for h in STRIDES * scale:
            try:
                ahead, behind = (self._moved(probe, t, base + side * h * seed) for side in (1, -1))
            except FMUError:
                continue
            difference = (ahead - behind) / (2 * h)
            size = np.maximum(np.maximum(np.abs(exact), np.abs(difference)), 1e-300)
            rounding = ROUNDING * np.maximum(np.abs(ahead), np.abs(behind)) / h
            left_open = (rounding + np.abs(wider - difference)) / size
            error, wider = np.abs(exact - difference) / size, difference
            unchanged = (error == 0) & (h >= UNCHANGED_STRIDE * scale)
            least = np.where((left_open <= LEFT_OPEN) | unchanged, np.fmin(least, error), least)
            beyond = np.fmin(beyond, np.maximum(error - left_open, 0))
        found = np.where(np.isfinite(least), least, beyond)
        worst = int(np.argmax(found))
        return float(found[worst]), worst

    def _moved(self, probe: Probe, t: float, point: Array) -> Array:
        self._set(probe, t, point)
        return probe.values(self.unknowns)

    def _set(self, probe: Probe, t: float, point: Array) -> None:
        probe.move_to(t, point[: self.states])
        for name, value in zip(self.knowns[self.states :], point[self.states :], strict=True):
            variable = self.fmu.variables[name]
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
            size = max(np.abs(found).sum(), np.abs(w * forward).sum(), 1e-300)
            error = float(abs(found.sum() - w @ forward) / size)
            if error > self.adjoint[0]:
                self.adjoint = (error, f"at {t:.6g} s")

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        label = self.fmu.label("ME")
        kinds = [("directional derivatives", self.able, self.forward)]
        if self.fmu.version[0] == "3":
            kinds.append(("adjoint derivatives", self.backward, self.adjoint))
        for check, able, (error, told) in kinds:
            if not able:
                yield Finding(label, check, None, told="the FMU gives none")
            elif not self.modes:
                yield Finding(label, check, None, told="the run is too short to look at any")
            else:
                count = f"{len(self.modes)} mode{'s' if len(self.modes) > 1 else ''}"
                yield measured(label, check, error, LIMIT, f"{told}; {count}" if told else count)


def _moving(variables: Mapping[str, ForeignVariable]) -> list[str]:
    return [n for n, v in variables.items() if v.real and v.size == 1 and v.variability == "continuous"]


def _spread(count: int) -> Sequence[int]:
    """Return which knowns are looked at: all, or some from first to last."""
    return sorted(set(np.linspace(0, count - 1, min(count, KNOWNS_COMPARED)).astype(int).tolist()))
