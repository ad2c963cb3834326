"""Tuning: the parameters at which a measure is least, fronts between two measures, scatter about a design."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ...base import Array, ModelError, at_least, between, demand, function, named, shown, whole
from ...base.checks import check_keywords
from ...base.html import page, table_of_texts
from ..dae import DAE
from ..given import dae_of
from ..lanes.gatherer import Gatherer
from ..network import Network
from .descent import BOUND_MARGIN, Bounds, TuningProblem, check_names
from .measures import NO_VALUE, Measure, measured


@dataclass(frozen=True)
class Tuned:
    """What tuning found.

    Attributes:
        parameters: values by name.
        value: the measure there.
        evaluations: how often it was computed.
        at_bound: parameters that lie on one of their bounds, or next to one where the measure has no value.
        exact: whether the search had exact derivatives.
    """

    parameters: dict[str, float]
    value: float
    evaluations: int
    at_bound: tuple[str, ...]
    exact: bool

    def _repr_html_(self) -> str:
        rows = (
            (name, f"{value:.6g}", "at a bound" if name in self.at_bound else "")
            for name, value in self.parameters.items()
        )
        title = f"{self.value:.6g} after {self.evaluations} evaluations"
        return page("tuned", title, table_of_texts(("parameter", "value", ""), rows))


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

    Sequential quadratic programming (SLSQP) from several starts. H2 and H-infinity norms, and so all ready
    measures, bring exact derivatives (adjoint of the Lyapunov equation, singular vectors at the peak); of
    an H-infinity norm the local peaks are held below a bound that is minimised, as the least one has
    several of one height. Any other measure is differentiated by differences, and the best result refined
    without derivatives (Nelder-Mead).

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
        >>> from inertance.analysis import ride_j1, tune
        >>> from inertance.machines import quarter_car, suspension
        >>> car = quarter_car(suspension("S1", k=60e3, d=2000.0))
        >>> tuned = tune(car, ride_j1, {"strut.rest.d": (500.0, 10e3)}, starts=1)
        >>> round(tuned.parameters["strut.rest.d"]), round(tuned.value, 4)
        (2615, 1.76)
    """
    demand("tune()", starts=(starts, whole(1)), seed=(seed, whole(0)))
    dae = dae_of(network)
    problem = TuningProblem(dae, measure, bounds, limits)
    tried = [problem.search(x) for x in problem.starts(start, starts, seed)]
    allowed = [(value, x) for value, x in tried if problem.allowed(x) and value < NO_VALUE]
    if not allowed:
        told = ", ".join(f"{getattr(m, '__name__', 'measure')} <= {limit:g}" for m, limit in limits)
        raise ModelError(
            f"'{dae.name}': nothing within the bounds was found with {told or 'a finite measure'}"
        )
    value, x = min(allowed, key=lambda found: found[0])
    if not (limits or problem.exact):
        value, x = problem.refine(x)
    value, x = problem.on_bounds(x)
    at_bound = tuple(n for n, c in zip(bounds, x, strict=True) if abs(c - round(c)) <= BOUND_MARGIN)
    return Tuned(problem.parameters(x), value, problem.count, at_bound, problem.exact)


def pareto_front(
    network: Network | DAE, first: Measure, second: Measure, bounds: Bounds, points: int = 9, **options: Any
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
    if whole(2)(points):
        raise ModelError(f"a front has at least its two ends, got points={points}")
    check_keywords("pareto_front()", options, tune)
    dae = dae_of(network)
    begin, end = (tune(dae, measure, bounds, **options) for measure in (first, second))
    highest = float(second(dae, parameters=begin.parameters))
    found = [(begin.value, highest, begin.parameters)]
    for level in np.linspace(highest, end.value, points)[1:-1].tolist():
        limits = [*options.get("limits", ()), (second, level)]
        limited = {**options, "start": found[-1][2], "limits": limits}
        best = tune(dae, first, bounds, **limited)
        found.append((best.value, float(second(dae, parameters=best.parameters)), best.parameters))
    found.append((float(first(dae, parameters=end.parameters)), end.value, end.parameters))
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
        demand("quantile()", share=(share, between(0, 1)))
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

    dae = dae_of(network)
    if whole(2)(samples):
        raise ModelError(f"scatter needs at least 2 samples, got {samples}")
    demand("scatter()", measure=(measure, function), seed=(seed, whole(0)))
    spread, parameters = named("spread", spread), named("parameters", parameters)
    below = [f"{name}: {shown(share)}" for name, share in spread.items() if at_least(0)(share)]
    if below or not spread:
        raise ModelError("scatter takes relative deviations of at least 0:", below or ["there are none"])
    check_names(dae, spread)
    given = {**dae.parameter_values, **parameters}
    unit = qmc.LatinHypercube(len(spread), rng=np.random.default_rng(seed)).random(samples)
    shift = norm.ppf(norm.cdf(-3) + unit * (norm.cdf(3) - norm.cdf(-3)))
    scattered = np.array([given[name] for name in spread]) * (1 + shift * np.array(list(spread.values())))
    designs = [parameters | dict(zip(spread, row, strict=True)) for row in scattered.tolist()]
    works = [partial(measured, measure, dae, design) for design in (parameters, *designs)]
    nominal, *values = map(float, Gatherer(len(works)).results(works))
    return Scatter(nominal, np.array(values))
