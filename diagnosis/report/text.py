"""What a report says in words."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import copysign

import numpy as np

from ...identification import Experiment, Prior
from ...networks import pretty_unit
from .. import criteria
from ..effects.effect import EFFECTS
from ..effects.hypothesis import told
from ..search.score_test import Candidate
from ..verdict.ranked import Ranked
from ..verdict.verdict import Verdict
from ..verdict.wording import foretold, left_of

SOURCES = {
    "stated": "as stated",
    "spectrum": "from the top of the spectrum",
    "quietest instants": "from the quietest instants",
}  # of noise, in words


def number(value: float) -> str:
    """Return a value with the digits that count."""
    return f"{value:.4g}"


def chance(p: float) -> str:
    """Return a probability with the digits that count."""
    return f"{p:.2g}" if p > criteria.LEAST_PROBABILITY_TOLD else "< 1e-6"


def believed(prior: Prior) -> str:
    """Return what was assumed of a parameter: value and standard deviation, or bounds."""
    if prior.sd < float("inf"):
        return f"{number(prior.center)} ± {number(prior.sd)}"
    return f"{number(prior.min)} to {number(prior.max)}"


def deviations(prior: Prior, value: float) -> str:
    """Return how far a value is from what was assumed, in standard deviations."""
    return f"{copysign(prior.moved(value), value - prior.center):+.2f}"


def conclusion(verdict: Verdict) -> Iterator[str]:
    """Yield the verdict in a sentence, its confidence, and what it rests on."""
    yield verdict.sentence
    yield f"Left: {left_of(verdict.gap)}."
    if verdict.effects:
        yield f"Confidence: {verdict.assurance}."
    yield from (f"{line}." for line in foretold(verdict))
    campaign = verdict.evidence.campaign
    runs = _runs("training", campaign.training)
    runs += f" and {_runs('test', campaign.testing)}" if campaign.testing else ", no test runs"
    driven, measured = ", ".join(campaign.inputs) or "nothing", ", ".join(campaign.outputs)
    yield f"From {runs}; driven by {driven}, measured {measured}."


def _runs(kind: str, experiments: Sequence[Experiment]) -> str:
    seconds = sum(float(np.ptp(e.record.time)) for e in experiments)
    return f"{len(experiments)} {kind} run{'s' * (len(experiments) > 1)} ({seconds:.4g} s)"


def ruled_out(verdict: Verdict) -> Iterator[tuple[str, str, float, float, str]]:
    """Yield kind, site, test gain, p and the reason of each fitted effect that is not the verdict.

    What was fitted on top of the verdict's effects comes last, its gain counted from there.
    """
    chosen = [placed.key for placed in verdict.effects]
    kept = {*chosen, *verdict.equivalent}
    gains = [r.test_gain for r in verdict.ranking if (r.kind, r.site) in chosen]
    for ranked in verdict.ranking:
        if (ranked.kind, ranked.site) not in kept:
            why = _reason(ranked, max(gains, default=None))
            yield ranked.kind, ranked.site, ranked.test_gain, ranked.p, why
    for ranked in verdict.further:
        why = f"on top of the verdict: {ranked.refused}"
        yield ranked.kind, ranked.site, ranked.test_gain, ranked.p, why


def _reason(ranked: Ranked, best: float | None) -> str:
    gain = ranked.test_gain
    if gain > 0 and ranked.p > criteria.CHANCE_PROBABILITY:
        return "no more than chance would do"
    if gain <= 0 or best is None:
        return ranked.refused
    if gain >= best:
        return "better than the verdict by no more than the scatter of the test runs"
    less = f"{best - gain:.2%}"
    return f"takes {less} less off than the verdict" if less != "0.00%" else "does no better than the verdict"


def screened_out(verdict: Verdict) -> Iterator[tuple[str, str, str, str]]:
    """Yield kind, site, predicted gain and the reason of each fit that failed and each kind not worth one."""
    screened, failed = verdict.evidence.screened, verdict.evidence.failed
    fitted = {ranked.kind for ranked in verdict.ranking} | {
        c.effect.kind for c in screened if c.label in failed
    }
    places = {(ranked.kind, ranked.site) for ranked in verdict.ranking}
    gains = [candidate.gain for candidate in screened if candidate.key in places]
    least = min(gains, default=float("inf"))
    total = sum(float(r @ r) for record in verdict.evidence.refit.train for r in record.values())
    best: dict[str, Candidate] = {}
    for c in screened:
        if c.label in failed:
            yield *c.key, f"{max(c.gain / total, 0.0):.2%}", failed[c.label]
        known = best.setdefault(c.effect.kind, c)
        best[c.effect.kind] = max(c, known, key=lambda candidate: candidate.gain)
    for kind, c in sorted(best.items(), key=lambda entry: -entry[1].gain):
        if kind in fitted:
            continue
        why = "explains less than those fitted" if c.gain < least else "not among those fitted"
        if c.share < criteria.OWN_SIGNATURE_SHARE:
            why = f"the parameters mimic it: {c.share:.1%} of its signature is its own"
        elif c.gain / total < criteria.NEGLIGIBLE_GAIN_SHARE:
            why = "explains next to nothing with its physical sign"
        yield kind, c.site.path, f"{max(c.gain / total, 0.0):.2%}", why
    for kind in EFFECTS if best else ():
        if kind not in best and kind not in fitted:
            yield kind, "", "", "there is no site for it, or nothing moves there"


def code(verdict: Verdict) -> list[str]:
    """Return Python lines that make the correction for good, imports and fitted parameters included."""
    lines = verdict.lines
    called = {name for line in lines for name in re.findall(r"(?<![\w.])([A-Za-z]\w*)(?=[.(])", line)}
    names = sorted(called - {"net"}) if any(line.startswith("net.") for line in lines) else []
    made = [f"from inertance import {', '.join(names)}", ""] if names else []
    fitted = [f"    {name!r}: {value:.6g}," for name, value in verdict.parameters.items()]
    made += [*lines, ""] if lines else []
    return [*made, "parameters = {", *fitted, "}  # as in net.simulate(..., parameters=parameters)"]


def advice(verdict: Verdict) -> str:
    """Return what to measure next."""
    if verdict.verdict == "interrupted":
        return "Nothing yet: the diagnosis was stopped before its end; run it to its end."
    if verdict.next_experiment:
        return verdict.next_experiment
    if verdict.verdict in ("partial", "unknown"):
        place = f" at {next(iter(verdict.where))}" if verdict.where else ""
        span = verdict.windows.get("band")
        band = " from {:.3g} to {:.3g} Hz".format(*span) if span else ""
        return (
            f"The force and the relative motion{place}, each with a sensor of its own, in runs that "
            f"dwell{band} at several amplitudes: then the law can be read off."
        )
    if verdict.verdict == "ambiguous":
        return (
            "Runs at other amplitudes, with rests and slow reversals, which these effects answer differently."
        )
    if verdict.verdict == "law":
        return (
            "Runs that go beyond the positions and speeds of these records, where the law is a straight "
            "guess; a run of yet another excitation would confirm it."
        )
    if verdict.verdict == "effect" and verdict.equivalent:
        others = ", ".join(told(*key) for key in verdict.equivalent)
        return (
            "The motion or the force of one of these places alone: these channels cannot part what was found "
            f"from {others}. A run of yet another excitation would confirm all else."
        )
    if verdict.verdict == "effect":
        return "Nothing is needed to name the cause. A run of yet another excitation would confirm it."
    return "Nothing. The verdict holds for amplitudes and frequencies such as those of these records."


def methods(verdict: Verdict) -> Iterator[str]:
    """Yield how the figures came about."""
    campaign = verdict.evidence.campaign
    for name, floor in campaign.floors.items():
        unit, source = pretty_unit(campaign.measured[name].si), f"from {floor.source}"
        size = f"{number(floor.sigma)} {unit}".rstrip()
        yield f"Noise of {name}: {size}, {SOURCES.get(floor.source, source)}."
    yield "Test runs are never fitted, except for start values where these are unknown."
    if not campaign.testing:
        yield "There are no test runs: all figures are those of the training runs and favour richer effects."
