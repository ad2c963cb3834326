"""`Verdict`: what parts data and model, with the evidence, the correction and what to measure next."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from ...base import Array, InertanceError, between, check_output, demand, function, optional, write_text
from ...identification import Campaign, Interval
from ...networks import Network
from ..criteria import MOVED_STANDARD_DEVIATIONS
from ..effects.hypothesis import Hypothesis, told, with_effects
from ..law.law import Law
from ..law.polish import placed as law_placed
from ..law.sought import Sought
from ..models.study import Study
from ..search.known import Known
from ..search.model_comparison import Refit
from ..search.score_test import Candidate
from .counterfactual import Counterfactual as Counterfactual
from .counterfactual import Parted as Parted
from .gap import Gap as Gap
from .ranked import Ranked as Ranked
from .wording import remainder_of, sentence_of


@dataclass(frozen=True, eq=False)
class Evidence:
    """The records, and the models held against them.

    Attributes:
        study: the campaign, and how its runs are computed.
        nominal: the model as given.
        refit: its parameters fitted.
        after: with the effects as well; the same as `refit` if none was accepted.
        screened: every effect at every site, with what it would explain.
        failed: by kind and site in words, why a fit came to nothing.
    """

    study: Study
    nominal: Refit
    refit: Refit
    after: Refit
    screened: tuple[Candidate, ...] = ()
    failed: Mapping[str, str] = field(default_factory=dict)

    @property
    def campaign(self) -> Campaign:
        """Records, channels, priors."""
        return self.study.campaign

    @property
    def judged(self) -> str:
        """Which runs the figures are of: without test runs, those that were fitted."""
        return "test runs" if self.campaign.testing else "training runs"

    def missed(self, model: Refit, channel: str) -> list[Array]:
        """Return what a model misses of a channel in each of these runs, in SI units."""
        return model.missed(self.study.judged, channel)

    @property
    def own_values(self) -> list[OwnValue]:
        """The values of parameters that records have of their own, with the effects in the model."""
        machine, pairs = self.campaign.machine, zip(self.campaign.experiments, self.after.own, strict=True)
        return [
            OwnValue(experiment.name, name, value, machine.unit(name))
            for experiment, own in pairs
            for name, value in own.items()
        ]


@dataclass(frozen=True)
class OwnValue:
    """The value of a parameter in one record, in SI units."""

    record: str
    parameter: str
    value: float
    unit: str

    def to_dict(self) -> dict[str, Any]:
        """Return it as in the JSON file."""
        return asdict(self)


class DiagnosisInterruptedError(KeyboardInterrupt):
    """Ctrl-C during a diagnosis; `verdict` tells what is known so far."""

    def __init__(self, message: str, verdict: Verdict) -> None:
        self.verdict = verdict
        super().__init__(message)


@dataclass(frozen=True, eq=False)
class Verdict:
    """What a diagnosis found.

    Attributes:
        verdict: "effect", "parameters", "none", "ambiguous", "partial", "law", "unknown" or "interrupted".
        effects: what is missing, with its parameters; for "partial", what certainly explains a part of it,
            for "law" what is missing beside the law.
        confidence: of each effect, how often one is there that is named so clearly.
        equivalent: (kind, site) of what these data cannot tell from one of them.
        next_experiment: the excitation that would tell them apart, in words.
        where: shares of the gap by site.
        windows: for "partial" and "unknown": when, in which band, in which motion the gap is that is left.
        ranking: all candidates that were fitted, the one first that does most for the test runs.
        gap: misfit by channel.
        closed: (refit - after)/(refit - floor) over all channels of the test runs.
        parameters: the network's uncertain parameters, fitted.
        network: the corrected network.
        evidence: the records, the fitted models and what was screened, for the report.
        notes: what limits the verdict.
        further: those that were fitted on top of the effects, and not accepted.
        sought: for "law", "partial" and "unknown", what came of looking for a static law of its own.
        counterfactual: how well the machine is predicted after its changes, by record and channel.
        parted: effects that test runs cannot tell from one of those found, and a counterfactual can.
    """

    verdict: str
    effects: tuple[Hypothesis, ...]
    confidence: tuple[float, ...]
    equivalent: tuple[tuple[str, str], ...]
    next_experiment: str | None
    where: Mapping[str, float]
    windows: Mapping[str, Any]
    ranking: tuple[Ranked, ...]
    gap: Mapping[str, Gap]
    closed: float
    parameters: Mapping[str, float]
    network: Network = field(repr=False)
    evidence: Evidence = field(repr=False)
    notes: tuple[str, ...] = ()
    further: tuple[Ranked, ...] = ()
    sought: Sought | None = field(default=None, repr=False)
    counterfactual: tuple[Counterfactual, ...] = ()
    parted: tuple[Parted, ...] = ()

    @property
    def law(self) -> Law | None:
        """The law that is missing, for "law"."""
        return self.sought.law if self.sought is not None else None

    @property
    def missing(self) -> tuple[Hypothesis, ...]:
        """What is to be inserted: the effects, and the law."""
        law = self.law
        return self.effects if law is None else (*self.effects, law_placed(law))

    @property
    def sentence(self) -> str:
        """The verdict in a sentence or two."""
        return sentence_of(self)

    def __str__(self) -> str:
        """Say what was found, and what limits it."""
        return "\n".join([f"{self.verdict}: {self.sentence}", *self.notes])

    @cached_property
    def _known(self) -> Known:
        """How well the parameters, and those of the effects, are known."""
        return Known(self.evidence.study, self.evidence.after)

    @cached_property
    def standard_errors(self) -> dict[str, float]:
        """Of parameters by path and of effects as "coulomb_friction_1.f_c" [SI units].

        If the model is right; none of a verdict that was interrupted, and none beside a law of its own, whose
        table may do what a parameter does.
        """
        if self.verdict == "interrupted" or self.law is not None:
            return {}
        try:
            return self._known.errors
        except InertanceError:
            return {}

    @property
    def ties(self) -> list[str]:
        """What the records hardly tell apart of parameters and effects, in words."""
        return self._known.ties if self.standard_errors else []

    def intervals(
        self, level: float = 0.95, report: Callable[[str], None] | None = None
    ) -> dict[str, Interval]:
        """Return how far the parameters, and those of the effects, may go while all others make up for it.

        Profiles of the misfit of the training records, some ten fits for each; see `inertance.fit`. There are
        none where there are no `standard_errors`.

        Args:
            level: the share of such intervals that hold the truth, if the model is right.
            report: called with a line of progress.

        Raises:
            SimulationError: if the model cannot be run beside what it was fitted to.
        """
        demand("intervals()", level=(level, between(0.01, 0.9999)), report=(report, optional(function)))
        if not self.standard_errors:
            return {}
        return self._known.intervals(level, report or (lambda line: None))

    @property
    def assurance(self) -> str:
        """The confidence in each effect, in words."""
        pairs = zip(self.effects, self.confidence, strict=True)
        return "; ".join(f"{told(*placed.key)}: {confidence:.0%}" for placed, confidence in pairs)

    @property
    def remainder(self) -> str:
        """When, in which band and in which motion most of what is left lies, in words."""
        return remainder_of(self.windows)

    @property
    def closest(self) -> Ranked | None:
        """What was fitted beside the effects and does most for the test runs, clearly if any does."""
        rest = [one for one in (self.further if self.effects else self.ranking) if one.test_gain > 0]
        return max(rest, key=lambda one: (one.is_clear, one.test_gain), default=None)

    @property
    def lines(self) -> list[str]:
        """Python lines that add the effects and the law to the network `net` for good."""
        made = [str(edit) for placed in self.missing for edit in placed.edits]
        for placed in self.effects:
            if not placed.edits:
                values = ", ".join(f"{name} = {value:.6g}" for name, value in placed.values.items())
                made.append(f"# {placed.effect.kind} on channel {placed.site.path}: {values}")
        return made

    def to_dict(self) -> dict[str, Any]:
        """Return the verdict as plain values, as in the JSON file."""
        errors = self.standard_errors
        effects = [
            {
                "kind": p.effect.kind,
                "site": p.site.path,
                "parameters": dict(p.values),
                "standard_errors": {n: errors[f"{p.name}.{n}"] for n in p.values if errors},
                "confidence": round(c, 4),
                "same_motion": list(p.site.same),
                **({"load": p.site.load or p.site.moving} if p.effect.place == "loaded" else {}),
            }
            for p, c in zip(self.effects, self.confidence, strict=True)
        ]
        return {
            "verdict": self.verdict,
            "effects": effects,
            "equivalent": [{"kind": kind, "site": site} for kind, site in self.equivalent],
            "next_experiment": self.next_experiment,
            "where": [
                {"site": site, "share": share, **({} if number else self.windows)}
                for number, (site, share) in enumerate(self.where.items())
            ],
            "ranking": [ranked.to_dict() for ranked in self.ranking],
            "further": [ranked.to_dict() for ranked in self.further],
            "remainder": {"share": 1 - self.closed, **self.windows} if self.windows else None,
            **self._law,
            "gap": {name: gap.to_dict() for name, gap in self.gap.items()},
            "closed": self.closed,
            "pieces": self.evidence.study.pieces,
            "counterfactual": [one.to_dict() for one in self.counterfactual],
            "parted": [one.to_dict() for one in self.parted],
            "parameters": dict(self.parameters),
            "standard_errors": {name: errors[name] for name in self.parameters if errors},
            "record_values": [one.to_dict() for one in self.evidence.own_values],
            "notes": list(self.notes),
        }

    @property
    def _law(self) -> dict[str, Any]:
        """What came of looking for a law, as in the JSON file."""
        if self.sought is None:
            return {"law": None, "no_law": None}
        law, alike = self.law, self.sought.missing.alike
        if law is None:
            return {"law": None, "no_law": self.sought.to_dict()}
        return {"law": {**law.to_dict(), "same_motion": alike, "closed": self.closed}, "no_law": None}

    def save(self, path: str | Path) -> Path:
        """Write the JSON file."""
        check_output(path, [".json"])
        return write_text(path, json.dumps(self.to_dict(), indent=1) + "\n")

    def corrected(self) -> Network:
        """Return the network with the effects and the law inserted."""
        return with_effects(self.network, self.missing)


def moved_parameters(campaign: Campaign, parameters: Mapping[str, float]) -> list[str]:
    """Return the parameters that are further from what was assumed than a true one is likely to be."""
    return [
        name
        for name, value in parameters.items()
        if abs(value - campaign.priors[name].center) > MOVED_STANDARD_DEVIATIONS * campaign.priors[name].sd
    ]
