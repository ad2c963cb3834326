"""The excitation by which two models that fit alike would part most."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...base import Array
from ...components import SimulationError
from ...identification import Campaign
from .. import criteria
from ..effects.hypothesis import told
from ..experiments.envelope import envelopes, given_beside_inputs
from ..experiments.trial import taken, trial
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit, rms


class _Sine(NamedTuple):
    """A sine on one input, the others at rest."""

    channel: str
    frequency: float
    amplitude: float


def separating(study: Study, one: Refit, other: Refit) -> str | None:
    """Return, in words, the sine within the limits, or what was measured, that parts two fitted models most.

    None if no sine parts them by more than twice the noise, or if one of them cannot be run.
    """
    campaign, empty = study.campaign, study.campaign.with_records([], [])
    try:
        joints = [JointFit(replace(study, campaign=empty), f.parameters, f.effects) for f in (one, other)]
        apart = [(_apart(campaign, joints, sine), sine) for sine in _trials(campaign)]
    except SimulationError:
        return None
    most, best = max(apart, default=(0.0, None))
    if best is None or most < criteria.SEPARATING_MISFIT:
        return None
    unit, both = campaign.measured[best.channel].si, (told(*f.effects[-1].key) for f in (one, other))
    return (
        f"A sine of {best.amplitude:.3g} {unit} at {best.frequency:.3g} Hz on '{best.channel}': there "
        f"{' and '.join(both)} part by {most:.2g} times the noise."
    )


def _apart(campaign: Campaign, joints: list[JointFit], sine: _Sine) -> float:
    """Return by how much models part under a sine, in units of noise; 0 if it would exceed a limit."""
    experiment = trial(campaign, {sine.channel: _samples(campaign, sine)}, criteria.TRIAL_RATE_HZ)
    limits, runs = given_beside_inputs(campaign), [joint.foreseen(experiment, False)[0] for joint in joints]
    if any(taken(limits, run) > 1 for run in runs):
        return 0.0
    weights, (mine, theirs) = experiment.weights, (run.seen for run in runs)
    return rms([weights[name](mine[name] - theirs[name]) for name in mine])


def _lasting(campaign: Campaign) -> float:
    """Return how long a trial takes [s]."""
    return campaign.allowed.duration or criteria.TRIAL_SECONDS


def _trials(campaign: Campaign) -> Iterator[_Sine]:
    """Yield sines in the band of each input, no larger, faster or harder than is allowed."""
    for one in envelopes(campaign, _lasting(campaign)):
        for frequency in np.geomspace(*one.band, criteria.TRIAL_FREQUENCIES).tolist():
            for share in criteria.TRIAL_AMPLITUDE_SHARES:
                yield _Sine(one.channel, frequency, share * one.amplitude(frequency))


def _samples(campaign: Campaign, sine: _Sine) -> Array:
    count = round(_lasting(campaign) * criteria.TRIAL_RATE_HZ)
    time = np.arange(count + 1) / criteria.TRIAL_RATE_HZ
    rise = np.clip(time / criteria.TRIAL_FADE_SECONDS, 0, 1)
    fade = rise**3 * (10 - 15 * rise + 6 * rise**2)
    return np.asarray(sine.amplitude * fade * np.sin(2 * np.pi * sine.frequency * time))
