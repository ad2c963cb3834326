"""Hold the thresholds of the diagnosis that are fixed by null cases against records where nothing is missing.

python benchmarks/blind/nulls.py FOLDER [--cases 8] [--seed 1]

The cases of FOLDER (see generate.py) give models, inputs and noise; their outputs are what the nominal model
predicts, with white noise. Effects are fitted all the same, those that promise most. The table tells what the
cases reach beside each threshold; the exit code is 1 if one of them crosses it.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import replace
from pathlib import Path

import numpy as np
from inertance.components import InertanceError
from inertance.diagnosis import criteria
from inertance.diagnosis.diagnose import relative_tolerance
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.models.study import study_of, thinned
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit, clearness
from inertance.diagnosis.search.score_test import screen
from inertance.identification import Accuracy, Campaign, CampaignModel, Experiment

FITTED = 3
THRESHOLDS = ("NOISE_MISFIT", "COLOURED_MISFIT", "MOVED_STANDARD_DEVIATIONS", "LEAST_CHI_SQUARED_GAIN")
FITS = ("CLEAR_STANDARD_ERRORS", "FIRST_EFFECT_SHARE")


def null(folder: Path, rng: np.random.Generator) -> Campaign:
    """Return a campaign whose outputs are those of its nominal model, with noise."""
    campaign = copy(Campaign.of(folder / "campaign.toml"))

    def predicted(experiments: Sequence[Experiment]) -> Iterator[Experiment]:
        bench = CampaignModel(campaign.dae, campaign.measured, experiments)
        runs = bench.simulate(campaign.start)
        for experiment, run in zip(experiments, runs, strict=True):
            seen = {n: v + campaign.sigma[n] * rng.standard_normal(len(v)) for n, v in run.values.items()}
            yield replace(
                experiment, record=replace(experiment.record, values=experiment.record.values | seen)
            )

    campaign.training, campaign.testing = (
        list(predicted(campaign.training)),
        list(predicted(campaign.testing)),
    )
    return thinned(campaign)


def reached(campaign: Campaign) -> dict[str, float]:
    """Return what a null case reaches, by the threshold that it is held against."""
    study = study_of(campaign, Accuracy(rtol=relative_tolerance(campaign)))
    base = JointFit(study, campaign.start).fitted()
    candidates = screen(study, base.parameters)
    fitted: list[Refit] = []
    for candidate in candidates[:FITTED]:
        placed = Hypothesis(candidate.effect, candidate.site, "null", candidate.values)
        try:
            fitted.append(JointFit(study, base.parameters, [placed]).fitted())
        except InertanceError as error:
            print(f"{candidate.label}: {error}", file=sys.stderr)
    priors, left = campaign.priors, base.blocks.sum()
    moved = [abs(value - priors[name].center) / priors[name].sd for name, value in base.parameters.items()]
    found = (base.misfit, base.misfit, max(moved), candidates[0].gain)
    clear = max((clearness(base, other) for other in fitted), default=0.0)
    taken = max((1 - float(other.blocks.sum() / left) for other in fitted), default=0.0)
    return dict(zip((*THRESHOLDS, *FITS), (*found, clear, taken), strict=True))


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cases", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args(arguments)
    rng = np.random.default_rng(given.seed)
    folders = sorted(path for path in (given.folder / "cases").iterdir() if path.is_dir())[: given.cases]
    cases = []
    for folder in folders:
        cases.append(reached(null(folder, rng)))
        print(f"\r{len(cases)}/{len(folders)} cases", end="", file=sys.stderr, flush=True)
    print(f"\n| threshold | value | median of {len(cases)} null cases | most |\n|---|---|---|---|")
    crossed = []
    for name in (*THRESHOLDS, *FITS):
        values, threshold = [case[name] for case in cases], getattr(criteria, name)
        print(f"| {name} | {threshold:g} | {np.median(values):.3g} | {max(values):.3g} |")
        crossed += [name] if max(values) > threshold else []
    if crossed:
        sys.exit(f"null cases cross {', '.join(crossed)}")


if __name__ == "__main__":
    main()
