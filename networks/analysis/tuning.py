"""Tuning: the parameters at which a measure is least, fronts between two measures, scatter about a design."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ...components.base import InertanceError, ModelError, nearest
from ..dae import DAE
from ..network import Network

Array = NDArray[np.float64]
Bounds = Mapping[str, tuple[float, float]]
BAD, EDGE, WIDE = 1e30, 1e-6, 100.0


class Measure(Protocol):
    """What is to be small: a function of the equations and of changed parameters, such as `ride_j1`."""

    def __call__(self, dae: DAE, /, *, parameters: Mapping[str, float]) -> float:
        """Return the measure for some parameters."""
        ...


@dataclass(frozen=True)
class Tuned:
    """What tuning found.

    Attributes:
        parameters: values by name.
        value: the measure there.
        evaluations: how often it was computed.
        at_bound: parameters that lie on one of their bounds.
    """

    parameters: dict[str, float]
    value: float
    evaluations: int
    at_bound: tuple[str, ...]


def tune(
    network: Network | DAE,
    measure: Measure,
    bounds: Bounds,
    *,
    limits: Sequence[tuple[Measure, float]] = (),
    start: Mapping[str, float] | None = None,
    starts: int = 4,
    seed: int = 0,
) -> Tuned:
    """Return the parameters within bounds at which a measure is least.

    A gradient search (SLSQP) from several starts, the best refined without gradients (Nelder-Mead), so
    that the corners of worst-case measures are found too.

    Args:
        network: what is tuned.
        measure: `ride_j1`, `tyre_j3`, ... or `lambda dae, *, parameters: ...` of your own.
        bounds: (least, greatest) of each parameter, by name; searched in logarithms if over 100 to 1.
        limits: further measures and what they must not exceed.
        start: a first guess; the middle of the bounds if None.
        starts: number of starts, the first guess included.
        seed: of the others.

    Raises:
        ModelError: for unknown parameters, empty bounds, or limits that nothing found meets.

    Example:
        >>> from inertance import quarter_car, ride_j1, suspension, tune
        >>> car = quarter_car(suspension("S1", k=60e3, d=2000.0))
        >>> tuned = tune(car, ride_j1, {"strut.rest.d": (500.0, 10e3)}, starts=1)
        >>> round(tuned.parameters["strut.rest.d"]), round(tuned.value, 4)
        (2615, 1.76)
    """
    dae = network.dae() if isinstance(network, Network) else network
    problem = _Problem(dae, measure, bounds, limits)
    tried = [problem.search(x) for x in problem.starts(start, starts, seed)]
    allowed = [(value, x) for value, x in tried if problem.allowed(x) and value < BAD]
    if not allowed:
        told = ", ".join(f"{getattr(m, '__name__', 'measure')} <= {limit:g}" for m, limit in limits)
        raise ModelError(
            f"'{dae.name}': nothing within the bounds was found with {told or 'a finite measure'}"
        )
    value, x = min(allowed, key=lambda found: found[0])
    if not limits:
        value, x = problem.refine(x)
    at_bound = tuple(n for n, c in zip(bounds, x, strict=True) if c < EDGE or c > 1 - EDGE)
    return Tuned(problem.parameters(x), value, problem.count, at_bound)


def front(
    network: Network | DAE,
    first: Measure,
    second: Measure,
    bounds: Bounds,
    points: int = 9,
    **options: Any,
) -> list[tuple[float, float, dict[str, float]]]:
    """Return designs none of which beats another in both measures: (first, second, parameters).

    The second measure is limited step by step between its values at both optima, the first minimised.

    Args:
        network: what is tuned.
        first: a measure.
        second: another one.
        bounds: as for `tune`.
        points: number of designs.
        options: as for `tune`.

    Source: Y. Haimes et al., IEEE Trans. Syst. Man Cybern. 1 (1971) 296-297 (epsilon constraint).
    """
    dae = network.dae() if isinstance(network, Network) else network
    ends = [tune(dae, measure, bounds, **options) for measure in (first, second)]
    others = [float(second(dae, parameters=end.parameters)) for end in ends]
    found = [(ends[0].value, others[0], ends[0].parameters)]
    given = dict(ends[0].parameters)
    for level in np.linspace(others[0], others[1], points)[1:-1]:
        best = tune(dae, first, bounds, limits=[(second, float(level))], **{**options, "start": given})
        given = dict(best.parameters)
        found.append((best.value, float(second(dae, parameters=given)), given))
    last = ends[1].parameters
    found.append((float(first(dae, parameters=last)), others[1], last))
    return [d for d in found if not any(o[0] < d[0] and o[1] < d[1] for o in found)]


@dataclass(frozen=True, eq=False)
class Scatter:
    """How a measure scatters when parameters do: `values` of all samples, `nominal` without scatter."""

    nominal: float
    values: Array

    @property
    def mean(self) -> float:
        """Mean of the samples."""
        return float(self.values.mean())

    @property
    def std(self) -> float:
        """Standard deviation of the samples."""
        return float(self.values.std(ddof=1))

    def quantile(self, share: float) -> float:
        """Return the value that a share of the samples stays below."""
        return float(np.quantile(self.values, share))


def scatter(
    network: Network | DAE,
    measure: Measure,
    spread: Mapping[str, float],
    *,
    parameters: Mapping[str, float] | None = None,
    samples: int = 200,
    seed: int = 0,
) -> Scatter:
    """Return how a measure scatters about a design whose parameters are only roughly met.

    Args:
        network: the design.
        measure: as for `tune`.
        spread: relative standard deviation of each parameter, by name; normal, cut at three of them.
        parameters: changed parameters of the design.
        samples: Latin hypercube samples.
        seed: of the samples.
    """
    from scipy.stats import norm, qmc

    dae = network.dae() if isinstance(network, Network) else network
    given = {**dae.parameter_values, **(parameters or {})}
    _check_names(dae, spread)
    unit = qmc.LatinHypercube(len(spread), rng=np.random.default_rng(seed)).random(samples)
    shift = norm.ppf(norm.cdf(-3) + unit * (norm.cdf(3) - norm.cdf(-3)))
    factors = 1 + shift * np.array(list(spread.values()))
    base = dict(parameters or {})
    values = [
        measure(dae, parameters=base | {n: given[n] * float(c) for n, c in zip(spread, row, strict=True)})
        for row in factors
    ]
    return Scatter(float(measure(dae, parameters=base)), np.array(values, dtype=float))


def _check_names(dae: DAE, names: Mapping[str, Any]) -> None:
    known = dae.parameter_values
    problems = [f"there is no parameter '{n}'{nearest(n, known)}" for n in names if n not in known]
    if problems:
        raise ModelError(f"'{dae.name}' cannot be tuned:", problems)


class _Problem:
    """A measure as a function of a point in the unit cube."""

    def __init__(
        self, dae: DAE, measure: Measure, bounds: Bounds, limits: Sequence[tuple[Measure, float]]
    ) -> None:
        _check_names(dae, bounds)
        wrong = [
            f"{n}: bounds go from a lower to a higher number, got {b}"
            for n, b in bounds.items()
            if not b[0] < b[1]
        ]
        if wrong or not bounds:
            raise ModelError(f"'{dae.name}' cannot be tuned:", wrong or ["there are no parameters to tune"])
        self.dae, self.measure, self.names, self.limits = dae, measure, list(bounds), limits
        low, high = (np.array([b[k] for b in bounds.values()], dtype=float) for k in (0, 1))
        self.logarithmic = (low > 0) & (high > WIDE * low)
        self.low, self.high = self._scaled(low), self._scaled(high)
        self.count = 0

    def _scaled(self, values: Array) -> Array:
        return np.where(self.logarithmic, np.log(np.where(self.logarithmic, values, 1.0)), values)

    def parameters(self, x: Array) -> dict[str, float]:
        """Return the parameters at a point."""
        values = self.low + np.clip(x, 0.0, 1.0) * (self.high - self.low)
        values = np.where(self.logarithmic, np.exp(np.where(self.logarithmic, values, 0.0)), values)
        return dict(zip(self.names, map(float, values), strict=True))

    def starts(self, start: Mapping[str, float] | None, count: int, seed: int) -> list[Array]:
        from scipy.stats import qmc

        given = start or {}
        middle = self.parameters(np.full(len(self.names), 0.5))
        wanted = self._scaled(np.array([given.get(n, middle[n]) for n in self.names]))
        first = np.clip((wanted - self.low) / (self.high - self.low), 0.0, 1.0)
        if count <= 1:
            return [first]
        return [first, *qmc.LatinHypercube(len(first), rng=np.random.default_rng(seed)).random(count - 1)]

    def _of(self, measure: Measure, x: Array) -> float:
        self.count += 1
        try:
            value = float(measure(self.dae, parameters=self.parameters(x)))
        except (InertanceError, np.linalg.LinAlgError):
            return BAD
        return value if np.isfinite(value) else BAD

    def value(self, x: Array) -> float:
        return self._of(self.measure, x)

    def allowed(self, x: Array) -> bool:
        return all(self._of(m, x) <= limit * (1 + 1e-6) for m, limit in self.limits)

    def search(self, x: Array) -> tuple[float, Array]:
        from scipy.optimize import minimize

        scale = max(abs(self.value(x)), 1e-300)

        def scaled(x: Any) -> float:
            return self.value(x) / scale

        def under(measure: Measure, limit: float) -> Callable[[Array], float]:
            return lambda x: 1.0 - self._of(measure, x) / limit

        constraints: Any = [{"type": "ineq", "fun": under(m, limit)} for m, limit in self.limits]
        options: Any = {"maxiter": 60, "ftol": 1e-11, "eps": 1e-7}
        bounds = [(0.0, 1.0)] * len(x)
        found: Any = minimize(
            scaled, x, method="SLSQP", bounds=bounds, constraints=constraints, options=options
        )
        best = np.clip(found.x, 0.0, 1.0)
        return self.value(best), best

    def refine(self, x: Array) -> tuple[float, Array]:
        from scipy.optimize import minimize

        options: Any = {
            "xatol": 1e-9,
            "fatol": 1e-13 * abs(self.value(x)),
            "maxiter": 120 * len(x),
            "initial_simplex": _simplex(x),
        }
        bounds = [(0.0, 1.0)] * len(x)
        found: Any = minimize(self.value, x, method="Nelder-Mead", bounds=bounds, options=options)
        return float(found.fun), np.clip(found.x, 0.0, 1.0)


def _simplex(x: Array) -> Array:
    points = np.tile(x, (len(x) + 1, 1))
    for k in range(len(x)):
        points[k + 1, k] += 1e-3 if x[k] < 0.5 else -1e-3
    return points
