"""Screening: what each effect at each site would explain of the residual, from one linear response each.

With residual r, slopes J of the uncertain parameters (in units of their prior standard deviation) and
signature G of an effect, all in units of noise, the score is the drop of

    |r - J p - G a|^2 + |p|^2

by sizes a on their physical side. It is the one-sided Lagrange multiplier test, with priors.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...base import Array, computing
from ...identification import Prior
from ..criteria import CHANNEL_PROBE_SHARE, DEPENDENT_EIGENVALUE_RATIO, FOUND_EFFECT_DEVIATIONS
from ..effects.effect import EFFECTS, Effect, Motion
from ..effects.hypothesis import Hypothesis, SitedEffect, inserted, rubbed
from ..effects.plausibility import INERTIAS, inertias
from ..effects.sites import Site, surrounded
from ..models.probes import scaled
from ..models.study import Study
from .model_comparison import Refit
from .whitened_record import Forced, WhitenedRecord


@dataclass(frozen=True, eq=False)
class Candidate(SitedEffect):
    """An effect at a site (or on a channel) with the values that explain most.

    Attributes:
        gain: drop of the squared residual, in units of noise, over what the nominal parameters can do.
        share: what is left of its signature once the parameters' slopes are taken off, 0 to 1.
        parameters: those of the model that it was screened on; along a missing force, those that suit it.
        sized: whether runs have told its values, not just what is linear.
    """

    values: dict[str, float]
    gain: float
    share: float
    parameters: Mapping[str, float]
    sized: bool = False


@dataclass(eq=False)
class _Tally:
    """Products of signatures with the slopes, the residual and themselves, summed over records."""

    effect: Effect
    site: Site
    shape: dict[str, float]
    products: Any = 0.0


class _Sums:
    """Sums over records that all candidates share, and theirs.

    `prior` is the covariance of the parameters, `moved` how far they move alone.
    """

    def __init__(self, slopes: Sequence[Array], records: Sequence[WhitenedRecord]) -> None:
        count = slopes[0].shape[1]
        own = sum((columns.T @ columns for columns in slopes), np.eye(count))
        self.prior: Array = np.asarray(np.linalg.inv(own), dtype=float)
        self.residual: Array = sum(
            (columns.T @ record.residual for columns, record in zip(slopes, records, strict=True)),
            np.zeros(count),
        )
        self.moved: Array = self.prior @ self.residual
        self.tallies: dict[tuple[str, str, str, tuple[float, ...]], _Tally] = {}


@computing("the screening of effects")
def screen(
    study: Study,
    parameters: Mapping[str, float],
    effects: Sequence[Hypothesis] = (),
    forced: Sequence[Forced] = (),
    near: Refit | None = None,
) -> list[Candidate]:
    """Return candidates beside refitted parameters and effects found already, the most explaining first.

    Records are first thought to begin where those of a model do that is `near`.
    They are screened along runs of the model, or of the model that is `forced` in each record, if it is.
    """
    study = study.displaced(effects)
    sites, found = [rubbed(site, effects) for site in study.sites], inserted(effects)
    given = {**parameters, **found}
    experiments, count = study.screened()
    predictor = study.predictor(effects, [*given], sites)
    numbers = {site.path: number for number, site in enumerate(sites)}
    runs: list[tuple[int, Forced] | None] = [(numbers[one.site], one) for one in forced]
    runs = runs or [None] * len(experiments)
    starts = near.starts_of(study.campaign.experiments) if near is not None else {}
    records = [
        WhitenedRecord(study, predictor, e, given, effects, count, run, starts.get(id(e)))
        for e, run in zip(experiments, runs, strict=True)
    ]
    motions = [[record.motion(number, site) for record in records] for number, site in enumerate(sites)]
    resting = next((n for n, experiment in enumerate(experiments) if experiment.initial == "rest"), None)
    led = resting is None and study.is_led
    moving = zip(sites, motions, strict=True)
    sites = surrounded([scaled(site, moved, resting, led) for site, moved in moving], _inertias(study))
    deviations = [study.campaign.priors[name].scale for name in parameters]
    deviations += [FOUND_EFFECT_DEVIATIONS * (abs(value) or 1.0) for value in found.values()]
    slopes = [record.slopes * np.array(deviations) for record in records]
    sums = _Sums(slopes, records)
    left = [r.residual - columns @ sums.moved for r, columns in zip(records, slopes, strict=True)]
    motions = _missing(records, left, motions)
    reach = {
        name: max(float(np.abs(record.measured.values[name]).max()) for record in records)
        for name in study.campaign.measured
    }
    for index, record in enumerate(records):
        _add(sums, record, slopes[index], sites, [moved[index] for moved in motions], motions, reach)
    priors = study.campaign.priors if forced else {}
    return sorted(_scored(sums, parameters, priors), key=lambda candidate: -candidate.gain)


def _inertias(study: Study) -> dict[tuple[str, str], float]:
    """Return the largest inertia of each part of a model, by its path and the domain of its motion."""
    found: dict[tuple[str, str], float] = {}
    for domain, unit in INERTIAS.items():
        for name, value in inertias(study.campaign.machine, unit).items():
            key = study.part(name), domain
            found[key] = max(value, found.get(key, 0.0))
    return found


def _add(
    sums: _Sums,
    record: WhitenedRecord,
    slopes: Array,
    sites: Sequence[Site],
    moved: Sequence[Motion],
    motions: Sequence[Sequence[Motion]],
    reach: Mapping[str, float],
) -> None:
    """Add what one record says of every candidate."""

    def count(site: Site, found: Sequence[tuple[Effect, dict[str, float], int]], columns: Array) -> None:
        products = columns.T @ np.column_stack([slopes, record.residual, columns])
        begin, first = 0, slopes.shape[1] + 1
        for effect, shape, width in found:
            rows, own = products[begin : begin + width], slice(first + begin, first + begin + width)
            key = effect.kind, site.path, site.load, tuple(shape.values())
            tally = sums.tallies.setdefault(key, _Tally(effect, site, shape))
            tally.products += np.column_stack([rows[:, :first], rows[:, own]])
            begin += width

    def act(site: Site, number: int, motion: Motion, probe: str) -> None:
        found = list(_forces(site, motion, motions[number], probe))
        if found:
            columns = record.to_inputs({f"{probe}_{number}.u": np.hstack([c for _, _, c in found])})
            count(site, [(effect, shape, c.shape[1]) for effect, shape, c in found], columns)

    for number, site in enumerate(sites):
        for probe in ("push", "stretch"):
            act(site, number, moved[number], probe)
        for other, pressed in _pressed(site, sites):
            act(pressed, number, replace(moved[number], f=moved[other].f), "push")
    for effect, site, shape, own in _channel_changes(record, reach):
        count(site, [(effect, shape, own.shape[1])], own)


def _pressed(site: Site, sites: Sequence[Site]) -> Iterator[tuple[int, Site]]:
    """Yield the neighbours of a site, by their numbers, and it as it is loaded by their forces alone."""
    for number, other in enumerate(sites):
        if site.places >= {"across", "loaded"} and other.path in site.neighbours and other.force:
            yield number, replace(site, load=other.moving, places=frozenset({"loaded"}))


def _missing(
    records: Sequence[WhitenedRecord], left: Sequence[Array], motions: Sequence[Sequence[Motion]]
) -> list[list[Motion]]:
    """Return motions of sites with how much of what is left a unit of force would explain along them all."""
    pushes = [f"push_{number}.u" for number in range(len(motions))]
    by_record = [[r.explained(part, push) for push in pushes] for r, part in zip(records, left, strict=True)]
    told = []
    for moved, parts in zip(motions, zip(*by_record, strict=True), strict=True):
        known = [part for part in parts if part is not None]
        missed = np.concatenate([motion.s for motion in moved]), np.concatenate([np.zeros(0), *known])
        told.append([replace(m, missed=missed) for m in moved] if len(known) == len(parts) else list(moved))
    return told


def _forces(
    site: Site, motion: Motion, motions: Sequence[Motion], probe: str
) -> Iterator[tuple[Effect, dict[str, float], Array]]:
    """Yield, for each effect and shape, the force or stretch of a unit of each size at a site."""
    widest = max(motions, key=lambda m: m.travel)
    for effect in EFFECTS.values():
        stretched = effect.place == "series"
        if effect.basis is None or not effect.may_act(site) or stretched != (probe == "stretch"):
            continue
        if not motion.travel or (stretched and not motion.f.any()):
            continue
        about = effect.about(motion, site)
        for shape in effect.shaped(site.domain, widest):
            yield effect, shape, np.column_stack(effect.basis(about, shape))


def _channel_changes(
    record: WhitenedRecord, reach: Mapping[str, float]
) -> Iterator[tuple[Effect, Site, dict[str, float], Array]]:
    """Yield, for each shape, what a small effect on each channel changes, per unit of its size."""
    for effect in EFFECTS.values():
        if effect.change is None:
            continue
        sizes = effect.sizes("channel")
        for name, path in (record.inputs if effect.drives else record.outputs).items():
            signal = record.measured.values[name] if effect.drives else record.predicted[name]
            if not np.ptp(signal):
                continue
            part = CHANNEL_PROBE_SHARE * float(np.ptp(signal))
            nothing = dict.fromkeys([q.name for q in sizes], 0.0)
            small = [{"s": 1 / record.measured.rate, "unit": part}.get(q.unit, 1.0) for q in sizes]
            site = Site(name, "channel", path, "", frozenset({"channel"}), travel=reach[name])
            for shape in effect.shaped("channel", site):
                changes = np.column_stack(
                    [
                        (record.passed_on(effect, signal, {**nothing, q.name: size, **shape}) - signal) / size
                        for q, size in zip(sizes, small, strict=True)
                    ]
                )
                if effect.drives:
                    own = record.to_inputs({path: record.acting(name, changes)})
                else:
                    own = record.to_output(name, changes)
                yield effect, site, shape, own


def _scored(sums: _Sums, parameters: Mapping[str, float], priors: Mapping[str, Prior]) -> Iterator[Candidate]:
    """Yield the best shape of each effect at each site; parameters with `priors` move with it.

    By what a gear brings or by what friction leaves of it, none is better while friction is small.
    """
    best: dict[tuple[object, ...], Candidate] = {}
    count = len(sums.prior)
    for tally in sums.tallies.values():
        crossed, seen, own = np.split(tally.products, [count, count + 1], axis=1)
        matrix = np.asarray(own - crossed @ sums.prior @ crossed.T, dtype=float)
        seen = seen[:, 0] - crossed @ sums.moved
        sizes = tally.effect.sizes(tally.site.domain)
        values, gain = _least(matrix, seen, np.array([q.low for q in sizes]))
        size = np.trace(own)
        share = float(np.trace(matrix) / size) if size > 0 else 0.0
        chosen = dict(zip([q.name for q in sizes], values.tolist(), strict=True)) | tally.shape
        further = (sums.moved - sums.prior @ crossed.T @ values).tolist()
        beside = {
            name: priors[name].at((value - priors[name].center) / priors[name].scale + step)
            for (name, value), step in zip(parameters.items(), further, strict=False)
            if priors
        }
        candidate = Candidate(tally.effect, tally.site, chosen, gain, share, beside or parameters)
        key = *candidate.key, tally.site.load == tally.site.moving
        if key not in best or gain > best[key].gain:
            best[key] = candidate
    yield from best.values()


def _least(matrix: Array, seen: Array, low: Array) -> tuple[Array, float]:
    """Return sizes a that minimise a'Ma - 2 a'c above their lower bounds, and the drop."""
    from scipy.optimize import lsq_linear

    sizes = np.diag(matrix)
    scale = np.sqrt(np.where(sizes > 0, sizes, 1.0))
    strength, vectors = np.linalg.eigh(matrix / np.outer(scale, scale))
    kept = strength > DEPENDENT_EIGENVALUE_RATIO
    root = np.sqrt(strength[kept])[:, None] * vectors[:, kept].T
    wanted = (vectors[:, kept].T @ (seen / scale)) / np.sqrt(strength[kept])
    if not kept.any():
        return np.zeros(len(low)), 0.0
    bounds = np.where(np.isfinite(low), 0.0, -np.inf), np.inf
    with np.errstate(invalid="ignore"):  # a step that nothing bounds is reflected nowhere
        found = lsq_linear(root, wanted, bounds)
    return np.maximum(found.x / scale, low), float(wanted @ wanted - 2 * found.cost)
