"""How large an effect must be for a gap-to-noise ratio, the gap being what parameters cannot explain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from alike import Rivals
from assembly import Rig, Values
from effects import Effect, Offer, Sized, Typical, first_guess, signals
from excitations import STEP
from stepper import Array, Drive

PRIOR = 0.2
COARSE = 2
REST = 8.0  # s, in which what always acts has come to rest before a record begins
REFITS = 8  # steps of parameters, whose answer bends: a gain of -34 % takes six
HELD = 0.3  # of a gap by slopes, that those must leave


class Scale:
    """Measures gaps on some records of a rig with given parameters, in units of each channel's noise.

    It steps at 10 kHz, which is enough for a size. `rel` is how uncertain parameters are, PRIOR if not given;
    `weight` how many samples of all records there are for one that is looked at.
    """

    def __init__(
        self,
        rig: Rig,
        values: Values,
        drives: list[Drive],
        typical: Mapping[str, Typical],
        noise: float,
        rel: Mapping[str, float] | None = None,
        weight: float = 1.0,
    ) -> None:
        self.rig, self.values, self.typical, self.weight = rig, values, typical, weight
        self.rel = np.array([rel[name] if rel else PRIOR for name in values])
        self.drives = [Drive(*(x[::COARSE] for x in (d.u, d.w, d.wd, d.wdd))) for d in drives]
        clean = self._seen(values, [])
        self.noise = self._noise(clean, noise)
        self.signal = 1 / noise
        self._clean = self._scaled(clean)
        self._projector = self._explained()

    def gap(self, effects: list[Sized]) -> tuple[float, float]:
        """Return rms of the change over noise, what parameters can explain taken off, and before it was."""
        change = self._change(effects)
        left = self._left(change)
        return tuple(float(np.sqrt(np.mean(x**2))) for x in (left, change))  # type: ignore[return-value]

    def size(self, effect: Effect, severity: float) -> float | None:
        """Return the size that makes a gap of `severity`, None if the rig would change beyond likeness."""
        size = self._guess(effect)
        for _ in range(9):
            gap, change = self.gap([(effect, size)])
            if not np.isfinite(gap) or change > 0.6 * max(self.signal, 3 * severity):
                return None
            if abs(gap / severity - 1) < 0.1:
                return size if self.refitted(effect, size) > HELD * severity else None
            size *= float(np.clip(severity / max(gap, 1e-12), 0.1, 10))
        return None

    def refitted(self, effect: Effect, size: float) -> float:
        """Return the rms of the change by an effect over noise that parameters and zeros leave, step by step.

        Slopes alone take what bends for a gap: a gain of a sensor is no other than all of a machine scaled.
        """
        changed = self._scaled(self._seen(self.values, [(effect, size)]))
        count, moved, least = len(self.values), np.zeros(self._slopes.shape[1]), np.inf
        for _ in range(REFITS):
            factors = zip(self.values.items(), moved, strict=False)
            values = {name: float(value * (1 + far)) for (name, value), far in factors}
            with np.errstate(over="ignore", invalid="ignore"):
                seen = self._scaled(self._seen(values, []))
            left = changed - seen - self._slopes[:, count:] @ moved[count:]
            if not np.isfinite(left).all():
                break
            least = min(least, float(np.sqrt(np.mean(left**2))))
            moved = moved + np.linalg.solve(self._normal, self._slopes.T @ left - self._known * moved)
        return least

    def alike(self, effect: Effect, size: float, offers: Sequence[Offer]) -> list[tuple[str, str]]:
        """Return kinds and sites that change the records as `effect` does, to less than all can tell."""
        rivals = Rivals(lambda e, s: self._left(self._change([(e, s)], REST)), self._guess, self.weight)
        return rivals.of(effect, self._left(self._change([(effect, size)])), offers, self.rig.motions)

    def _change(self, effects: list[Sized], rest: float = 0.0) -> Array:
        return self._scaled(self._seen(self.values, effects, rest)) - self._clean

    def _left(self, change: Array) -> Array:
        """Return what the parameters cannot explain of a change over noise."""
        return change - self._slopes @ (self._projector @ change)

    def _noise(self, clean: list[Array], noise: float) -> Array:
        return noise * np.sqrt(np.mean(np.concatenate(clean) ** 2, axis=0))

    def _guess(self, effect: Effect) -> float:
        return first_guess(effect, self.rig, self.drives[0], COARSE * STEP)

    def _seen(self, values: Values, effects: list[Sized], rest: float = 0.0) -> list[Array]:
        step = COARSE * STEP
        every, before = round(1e-3 / step), round(rest / step)
        rested = [Drive(*(np.pad(x, (before, 0)) for x in (d.u, d.w, d.wd, d.wdd))) for d in self.drives]
        seen = [signals(self.rig, values, drive, effects, self.typical, step) for drive in rested]
        return [fine[before::every, 1:] for fine in seen]

    def _scaled(self, seen: list[Array]) -> Array:
        return np.concatenate([(y / self.noise).ravel() for y in seen])

    def _explained(self) -> Array:
        """Return what maps a change to the relative changes of parameters that explain it best."""
        slopes = []
        for name, value in self.values.items():
            moved = self._scaled(self._seen({**self.values, name: 1.01 * value}, []))
            slopes.append((moved - self._clean) / 0.01)
        return self._mapped(np.column_stack(slopes), 1 / self.rel**2)

    def _mapped(self, slopes: Array, known: Array) -> Array:
        """Keep slopes, and what is known of what they are in, and return what maps a change to that."""
        self._slopes, self._known = slopes, known
        self._normal = slopes.T @ slopes + np.diag(known)
        return np.asarray(np.linalg.solve(self._normal, slopes.T))
