"""The search for the least of a measure in the unit cube, by exact derivatives where it has them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...base import Array, ModelError, by_name, demand, finite, named, nearest, number, numbers, shown
from ..dae import DAE
from .linearise import Varied
from .measures import NO_VALUE, Measure, measured
from .norms import Norm

Bounds = Mapping[str, tuple[float, float]]
LOGARITHMIC_RATIO = 100.0  # of the bounds, above which a parameter is searched in logarithms
PEAKS_FOLLOWED, PEAK_ROUNDS = 4, 8
DIFFERENCE, AGREEMENT = 1e-6, 1e-2  # a derivative is held against a difference this wide, this closely
BOUND_MARGIN, EDGE_SHARE, ROUNDING = 2.0**-33, 1e-6, 1e-9


def check_names(dae: DAE, names: Mapping[str, Any]) -> None:
    """Raise a `ModelError` for names that are no parameters."""
    known = dae.parameter_values
    problems = [f"there is no parameter '{n}'{nearest(n, known)}" for n in names if n not in known]
    if problems:
        raise ModelError(f"'{dae.name}' cannot be tuned:", problems)


def _are_limits(given: Any) -> bool:
    if not isinstance(given, Sequence):
        return False
    pairs = all(isinstance(pair, tuple | list) and len(pair) == 2 for pair in given)
    return pairs and all(callable(measure) and not number(limit) for measure, limit in given)


class TuningProblem:
    """A measure and its limits as functions of a point in the unit cube.

    Attributes:
        exact: whether all of them have exact derivatives.
    """

    def __init__(
        self, dae: DAE, measure: Measure, bounds: Bounds, limits: Sequence[tuple[Measure, float]]
    ) -> None:
        bounds = named("bounds", bounds)
        check_names(dae, bounds)
        if not callable(measure):
            raise ModelError(f"a measure is a function of the equations and `parameters=`, got {measure!r}")
        wrong = [
            f"{n}: bounds go from a lower to a higher number, got {b}"
            for n, b in bounds.items()
            if numbers(finite())(b) or not (np.shape(b) == (2,) and b[0] < b[1])
        ]
        if wrong or not bounds:
            raise ModelError(f"'{dae.name}' cannot be tuned:", wrong or ["there are no parameters to tune"])
        if not _are_limits(limits):
            raise ModelError(f"limits are pairs (measure, number), got {shown(limits)}")
        for _, limit in limits:
            if not limit > 0:
                raise ModelError(f"'{dae.name}': a limit must be above 0, got {limit:g}")
        self.dae, self.measure, self.names, self.limits = dae, measure, list(bounds), limits
        low, high = (np.array([b[k] for b in bounds.values()], dtype=float) for k in (0, 1))
        self.logarithmic = (low > 0) & (high > LOGARITHMIC_RATIO * low)
        self.low, self.high = self._scaled(low), self._scaled(high)
        self.count = 0
        self.exact = True
        self._at: tuple[bytes, dict[int, Norm]] = (b"", {})

    def _scaled(self, values: Array) -> Array:
        return np.where(self.logarithmic, np.log(np.where(self.logarithmic, values, 1.0)), values)

    def parameters(self, x: Array) -> dict[str, float]:
        """Return the parameters at a point."""
        values = self.low + np.clip(x, 0.0, 1.0) * (self.high - self.low)
        values = np.where(self.logarithmic, np.exp(np.where(self.logarithmic, values, 0.0)), values)
        return dict(zip(self.names, map(float, values), strict=True))

    def starts(self, start: Mapping[str, float] | None, count: int, seed: int) -> list[Array]:
        """Return the first guess and others in the cube."""
        from scipy.stats import qmc

        given = named("start", start)
        check_names(self.dae, given)
        demand("tune()", start=(given, by_name(finite())))
        middle = self.parameters(np.full(len(self.names), 0.5))
        wanted = self._scaled(np.array([given.get(n, middle[n]) for n in self.names]))
        first = np.clip((wanted - self.low) / (self.high - self.low), 0.0, 1.0)
        if count <= 1:
            return [first]
        return [first, *qmc.LatinHypercube(len(first), rng=np.random.default_rng(seed)).random(count - 1)]

    def of(self, measure: Measure, x: Array) -> Norm:
        """Return a measure at a point, a large number where it has none."""
        x = np.clip(x, 0.0, 1.0)
        if self._at[0] != x.tobytes():
            self._at = (x.tobytes(), {})
        known = self._at[1]
        if id(measure) not in known:
            self.count += 1
            given = self.parameters(x)
            found = measured(measure, self.dae, Varied(given) if self.exact else given, lenient=True)
            norm = found if isinstance(found, Norm) else Norm(found)
            known[id(measure)] = norm if np.isfinite(found) else Norm(NO_VALUE)
        return known[id(measure)]

    def value(self, x: Array) -> float:
        """Return the measure that is to be small."""
        return float(self.of(self.measure, x))

    def allowed(self, x: Array) -> bool:
        """Return whether a point meets the limits."""
        return all(self.of(m, x) <= limit * (1 + 1e-6) for m, limit in self.limits)

    def search(self, x: Array) -> tuple[float, Array]:
        """Return the least value near a point that SLSQP finds, and where."""
        measures = self.measure, *(measure for measure, _ in self.limits)
        self.exact = self.exact and all(self._true(measure, x) for measure in measures)
        peaky = self.exact and self.of(self.measure, x).peaks
        best = self._below_peaks(x) if peaky else self._smooth(x)
        return self.value(best), best

    def _smooth(self, x: Array) -> Array:
        scale = max(abs(self.value(x)), 1e-300)
        slope = (lambda x: self.gradient(self.measure, x) / scale) if self.exact else None
        return self._minimum(lambda x: self.value(x) / scale, slope, x, self._constraints(len(x)))

    def _below_peaks(self, x: Array) -> Array:
        """Minimise a bound t on the local peaks, and on the gains where peaks have been that merged since."""
        watched: list[float] = []
        for _ in range(PEAK_ROUNDS):
            before = self.value(x)
            known = [p.frequency for p in self._peaks(x) if p and p.frequency and np.isfinite(p.frequency)]
            watched = [*watched, *known][-2 * PEAKS_FOLLOWED :]
            tried = self._below(x, watched)
            if not self.value(tried) < before * (1 - 1e-10) and self.allowed(x):
                break
            x = tried
        return x

    def _below(self, x: Array, watched: Sequence[float]) -> Array:
        scale, n = max(abs(self.value(x)), 1e-300), len(x)

        def gains(y: Array) -> list[Norm]:
            where_peaks_were = self.of(self.measure, y[:-1]).gains(watched) or [Norm(0.0)] * len(watched)
            return [*self._peaks(y[:-1]), *where_peaks_were]

        def room(y: Array) -> Array:
            return np.asarray(y[-1] - np.array(gains(y), dtype=float) / scale)

        def slopes(y: Array) -> Array:
            rows = [-self._in_cube(gain, y[:-1]) / scale for gain in gains(y)]
            return np.hstack([np.array(rows), np.ones((len(rows), 1))])

        constraints = [{"type": "ineq", "fun": room, "jac": slopes}, *self._constraints(n)]
        top = np.r_[np.zeros(n), 1.0]
        return self._minimum(lambda y: y[-1], lambda _: top, np.r_[x, 1.0], constraints)[:n]

    def _peaks(self, x: Array) -> list[Norm]:
        found = self.of(self.measure, x)
        return [*(found.peaks or [Norm(found)]), *[Norm(0.0)] * PEAKS_FOLLOWED][:PEAKS_FOLLOWED]

    def _constraints(self, n: int) -> list[dict[str, Any]]:
        """Return the limits as SLSQP takes them; what follows the first n coordinates is not theirs."""

        def one(measure: Measure, limit: float) -> dict[str, Any]:
            def room(y: Array) -> float:
                return 1.0 - float(self.of(measure, y[:n])) / limit

            def slope(y: Array) -> Array:
                return np.append(-self.gradient(measure, y[:n]) / limit, np.zeros(len(y) - n))

            return {"type": "ineq", "fun": room} | ({"jac": slope} if self.exact else {})

        return [one(measure, limit) for measure, limit in self.limits]

    def _minimum(self, function: Any, slope: Any, y: Array, constraints: list[dict[str, Any]]) -> Array:
        """Return what SLSQP finds within the bounds; on a bound of 0 there may be nothing to solve for."""
        from scipy.optimize import minimize

        n = len(self.names)
        bounds: Any = [(BOUND_MARGIN, 1 - BOUND_MARGIN)] * n + [(None, None)] * (len(y) - n)
        differences = {"maxiter": 60, "ftol": 1e-11, "eps": 1e-7}
        options: Any = {"maxiter": 100, "ftol": 1e-12} if self.exact else differences
        found: Any = minimize(
            function, y, jac=slope, method="SLSQP", bounds=bounds, constraints=constraints, options=options
        )
        return np.append(np.clip(found.x[:n], BOUND_MARGIN, 1 - BOUND_MARGIN), found.x[n:])

    def gradient(self, measure: Measure, x: Array) -> Array:
        """Return the exact derivatives of a measure in the cube."""
        return self._in_cube(self.of(measure, x), x)

    def _in_cube(self, norm: Norm, x: Array) -> Array:
        per = (self.high - self.low) * np.where(self.logarithmic, list(self.parameters(x).values()), 1.0)
        return np.asarray([norm.gradient.get(name, 0.0) for name in self.names] * per)

    def _true(self, measure: Measure, x: Array) -> bool:
        """Return whether a measure's derivatives are there, and are those of what it returns."""
        found = self.of(measure, x)
        if found >= NO_VALUE:
            return True
        if not set(self.names) <= set(found.gradient):
            return False
        slope, along = self.gradient(measure, x), np.where(x < 0.5, DIFFERENCE, -DIFFERENCE)
        missed = abs(self.of(measure, x + along) - found - float(slope @ along))
        return bool(missed <= AGREEMENT * float(np.abs(slope) @ np.abs(along)) + 1e-9 * abs(found))

    def on_bounds(self, x: Array) -> tuple[float, Array]:
        """Return a point with what lies next to a bound on it, unless it is worse there."""
        for k in np.flatnonzero(np.abs(x - np.round(x)) < EDGE_SHARE):
            bound = np.round(x[k])
            for place in (bound, abs(bound - BOUND_MARGIN)):
                moved, value = x.copy(), self.value(x)
                moved[k] = place
                if self.value(moved) <= value + ROUNDING * abs(value) and self.allowed(moved):
                    x = moved
                    break
        return self.value(x), x

    def refine(self, x: Array) -> tuple[float, Array]:
        """Return a point as good or better, found without derivatives."""
        from scipy.optimize import minimize

        simplex = np.vstack([x, x + np.diag(np.where(x < 0.5, 1e-3, -1e-3))])
        precision = {"xatol": 1e-9, "fatol": 1e-13 * abs(self.value(x))}
        options: Any = {**precision, "maxiter": 120 * len(x), "initial_simplex": simplex}
        bounds = [(0.0, 1.0)] * len(x)
        found: Any = minimize(self.value, x, method="Nelder-Mead", bounds=bounds, options=options)
        return float(found.fun), np.clip(found.x, 0.0, 1.0)
