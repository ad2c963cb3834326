"""Chaotic motion: records compared as far as a model foresees them, the loudest of them fitted first."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from ...components import InertanceError
from ...identification import Experiment
from .. import criteria
from ..effects.plausibility import refused
from ..models.study import FMUStudy, Study
from .fit import in_several_sizes
from .joint_fit import JointFit
from .model_comparison import Refit
from .recast import Recast
from .round import Round, nearest_in_series


def fitted_to_loudest(study: Study, done: Round) -> Refit | None:
    """Return the best effect in series of a first round, fitted to the loudest training record alone.

    Beside that motion a play is least, and runs stay together longest. It is held against all records as it
    is, begun where those of the best effect or of the model without it begin. None for an FMU, if no such
    effect came near, or if it cannot be run or be a machine's.
    """
    chosen = nearest_in_series(done)
    if chosen is None or isinstance(study, FMUStudy):
        return None
    study.tell(f"fitting {chosen.labels[-1]} to the loudest record alone")
    screened = next(c for c in done.candidates if c.label == chosen.labels[-1])
    loudest = max(study.campaign.training, key=_loudness)
    alone, fits = replace(study, campaign=study.campaign.with_records([loudest])), list[Refit]()
    try:
        parameters = JointFit(alone, done.base.parameters).fitted().parameters, done.base.parameters
        for values, given in product(in_several_sizes(screened.values), parameters):
            placed = replace(chosen.effects[-1], values=values)
            fits.append(JointFit(alone, given, [placed]).fitted())
            if fits[-1].cost < criteria.NOISE_MISFIT**2 * loudest.independent or study.late():
                break
        best = min(fits, key=lambda model: model.cost)
        joints = (JointFit(study, best.parameters, best.effects, near) for near in (chosen, done.base))
        ways = [joint.seen(joint.start) for joint in joints]
        found = min(ways, key=lambda way: way.cost + float(way.blocks.sum()))
    except InertanceError:
        return None
    return None if refused(found.effects[-1], study.campaign) else found


def foreseen(study: Study, start: Refit, base: Refit, model: Refit) -> Recast | None:
    """Return models in records that are compared as far as one with an effect foresees them.

    Where free runs part from each other, what a fit sees of a record is as rough as a comb, and what is left
    of it tells of no cause. None if it foresees all of them, or one cannot be run.

    Source: H. U. Voss, J. Timmer, J. Kurths, Nonlinear dynamical system identification from uncertain and
    indirect measurements, International Journal of Bifurcation and Chaos 14 (2004) 1905-1933.
    """
    try:
        short = _within_horizon(study, model)
        return None if short is study else Recast.of(short, start, base, model, _told(study, short, model))
    except InertanceError:
        return None


def _loudness(experiment: Experiment) -> float:
    """Return how far the outputs of a record move [noise]."""
    return max(float(np.std(experiment.passed(name))) / sigma for name, sigma in experiment.sigma.items())


def _within_horizon(study: Study, model: Refit) -> Study:
    """Return the study with records as far as a model foresees them; itself if that is to their ends."""
    joint, campaign = JointFit(study, model.parameters, model.effects, model), study.campaign
    known = campaign.training, campaign.testing
    short = campaign.with_records(*([_seen_within(joint, e) for e in records] for records in known))
    cut = any(a is not b for a, b in zip(short.experiments, campaign.experiments, strict=True))
    return replace(study, campaign=short) if cut else study


def _seen_within(joint: JointFit, experiment: Experiment) -> Experiment:
    """Return a record as far as a model foresees it; itself if that is to its end.

    That is for half of the time in which an error of the parameters, far below what is known of them, grows
    to the range of an output: then it is the square root of that.
    """
    run, away = joint.run_on(experiment), np.zeros(len(experiment.compared.time), dtype=bool)
    for name, seen in run.seen.items():
        with np.errstate(over="ignore", invalid="ignore"):
            moved = np.abs(run.slopes(name)[:, : len(joint.names)] * joint.scale).max(axis=1, initial=0.0)
        away |= criteria.HORIZON_STEP * moved > np.ptp(seen) + experiment.sigma[name]
    if not away.any():
        return experiment
    return experiment.until(max(int(away.argmax()) // 2, criteria.PIECE_SAMPLES))


def _told(study: Study, short: Study, model: Refit) -> str:
    """Say which records are compared for how long, and why."""
    pairs = zip(study.campaign.experiments, short.campaign.experiments, strict=True)
    cut = [f"{whole.name} {np.ptp(part.compared.time):.3g} s" for whole, part in pairs if part is not whole]
    return (
        f"records are compared as far as {model.labels[-1]} lets runs foresee them: {', '.join(cut)}; what "
        "follows hangs on less than a thousandth of what is known of the parameters"
    )
