"""Where a gap lies: at which sites, in which seconds, in which band, in which regime of motion."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ...base import Array
from ...identification import Experiment, Record
from .. import criteria
from ..effects.effect import Motion
from ..effects.hypothesis import inserted
from ..effects.sites import Site
from ..law.spans import spans
from ..models.study import Study
from ..search.model_comparison import Refit
from ..search.score_test import Candidate
from ..search.whitened_record import WhitenedRecord


def shares(candidates: Sequence[Candidate]) -> dict[str, float]:
    """Return shares of what the best effect at each site would explain, the largest first."""
    best: dict[str, float] = {}
    for candidate in candidates:
        best[candidate.site.path] = max(best.get(candidate.site.path, 0.0), candidate.gain)
    total = sum(best.values())
    ordered = sorted(best.items(), key=lambda entry: -entry[1])[: criteria.SITES_TOLD]
    return {site: round(gain / total, 4) for site, gain in ordered if total}


def located(study: Study, fitted: Refit, candidates: Sequence[Candidate]) -> dict[str, Any]:
    """Return windows of time, the band of frequency and the regime of motion that hold a model's gap."""
    study = study.displaced(fitted.effects)
    records = study.campaign.experiments
    missed = [*fitted.train, *fitted.test]
    spans = windows(records, missed)
    found: dict[str, Any] = {"windows": spans, "band": band(records, missed)}
    found["unit"] = "windows in s, band in Hz"
    if candidates:
        motions = moved(study, fitted, candidates[0].site, records)
        ratios = regimes(records, motions, missed)
        regime = max(ratios, key=lambda name: ratios[name])
        lasting = sum(float(w["to"]) - float(w["from"]) for w in spans)
        brief = lasting < criteria.EPISODE_TIME_SHARE * sum(float(np.ptp(e.compared.time)) for e in records)
        found["regime"] = "any" if brief or ratios[regime] < criteria.REGIME_GAP_RATIO else regime
        found["regimes"] = ratios
    return found


def excess(experiment: Experiment, residuals: Mapping[str, Array]) -> Array:
    """Return the squared residual of a record above that of noise at each instant; 0 where it is omitted."""
    above: Array = np.sum([r**2 - 1.0 for r in residuals.values()], axis=0)
    if experiment.omitted is not None:
        above[experiment.omitted] = 0.0
    return above


def windows(
    experiments: Sequence[Experiment], missed: Sequence[Mapping[str, Array]]
) -> list[dict[str, float | str]]:
    """Return the stretches that hold most of the gap; all of each record where it is spread out.

    Each is {"record", "from", "to", "share"}, its instants in s.
    """
    pairs = zip(experiments, missed, strict=True)
    return spans([(e.compared.name, e.compared.time, excess(e, residuals)) for e, residuals in pairs])


def band(experiments: Sequence[Experiment], missed: Sequence[Mapping[str, Array]]) -> list[float]:
    """Return the frequencies [Hz] between which most of the power of the gap above noise lies."""
    rate = min(e.compared.rate for e in experiments)
    common = np.linspace(0, rate / 2, 1000)
    above = np.zeros(len(common))
    for experiment, residuals in zip(experiments, missed, strict=True):
        for residual in map(experiment.counted, residuals.values()):
            segment = min(len(residual), criteria.SPECTRUM_SEGMENT_SAMPLES)
            f, density = spectrum(residual, experiment.compared.rate, segment)
            above += np.interp(common, f, density - 2 / experiment.compared.rate) * len(residual)
    power = np.cumsum(np.maximum(above, 0.0))
    power /= max(float(power[-1]), 1e-300)
    return [round(float(common[np.searchsorted(power, share)]), 3) for share in criteria.BAND_POWER_SHARES]


def spectrum(values: Array, rate: float, segment: int) -> tuple[Array, Array]:
    """Return frequencies [Hz] and the power spectral density by Welch's method; the mean stays in."""
    from scipy.signal import welch

    length = min(segment, len(values))
    f, density = welch(values, rate, nperseg=length, detrend=False)  # pyright: ignore[reportArgumentType]
    return f, density


def regimes(
    experiments: Sequence[Experiment], motions: Sequence[Motion], missed: Sequence[Mapping[str, Array]]
) -> dict[str, float]:
    """Return the gap in each regime of motion over the average gap."""

    def counted(parts: Iterable[Array]) -> Array:
        return np.concatenate([e.counted(part) for e, part in zip(experiments, parts, strict=True)])

    speed = np.abs(counted(m.v for m in motions))
    travel = np.abs(counted(m.s - 0.5 * (m.s.max() + m.s.min()) for m in motions))
    above = counted(excess(e, residuals) for e, residuals in zip(experiments, missed, strict=True))
    mean = float(above.mean())
    inside = {
        "reversals": speed < criteria.SLOW_SPEED_SHARE * speed.max(),
        "high speed": speed > criteria.LARGE_MOTION_SHARE * speed.max(),
        "large travel": travel > criteria.LARGE_MOTION_SHARE * travel.max(),
    }
    return {
        name: round(float(above[at].mean()) / mean, 3) if at.any() and mean > 0 else 0.0
        for name, at in inside.items()
    }


def moved(study: Study, fitted: Refit, site: Site, experiments: Sequence[Experiment]) -> list[Motion]:
    """Return how a site moves in a fitted model at the instants of records; of a channel, value and rates."""
    if site.domain == "channel":
        return [_signal(e.compared, site.path) for e in experiments]
    given, motions = fitted.parameters | inserted(fitted.effects), []
    model = study.predictor(fitted.effects, sites=[site])
    starts = fitted.starts_of(study.campaign.experiments)
    for experiment in experiments:
        start = starts.get(id(experiment))
        record = WhitenedRecord(study, model, experiment, given, fitted.effects, start=start)
        motion, t = record.motion(0, site), experiment.compared.time
        s, v, f, a = (np.interp(t, motion.t, x) for x in (motion.s, motion.v, motion.f, motion.a))
        motions.append(Motion(t, s, v, f, a))
    return motions


def _signal(record: Record, channel: str) -> Motion:
    values = record.values[channel]
    rate = np.gradient(values, record.time)
    return Motion(record.time, values, rate, np.zeros(len(values)), np.gradient(rate, record.time))
