"""`missing_force`: the force that explains what a model misses of its records."""

from __future__ import annotations

from pathlib import Path

from ..base import above, computing, demand, optional, text
from ..components import ModelError
from ..identification import Accuracy, Campaign
from .criteria import COMPARISON_RATE_HZ, RUNS_PER_MODEL
from .diagnose import relative_tolerance
from .investigation import refitted_as_heard
from .law.missing_force import MissingForce, force_of
from .models.fmu_network import read_model
from .models.study import FMUStudy, Study, study_of, thinned


@computing("the missing force")
def missing_force(
    campaign: Campaign | str | Path, site: str | None = None, *, rate: float = COMPARISON_RATE_HZ
) -> MissingForce:
    """Return the force at a site that explains what a model misses of its training records.

    A fixed-interval smoother along the model's run, iterated on the motion that it makes. How fast the force
    may change is what makes the records likeliest, so that noise remains; where force and motion are both
    measured it is inverse dynamics.

    Args:
        campaign: records, channels, priors and model, a network; or the path of the TOML file.
        site: path of a component; where the least force suffices, if not given.
        rate: at which outputs are compared and the force is sought, several times that of its waves [Hz].

    Raises:
        ModelError: for an FMU, or an unknown site, with the nearest one.

    Source: A. E. Bryson, M. Frazier, Smoothing for linear and nonlinear dynamic systems, 1963.
    """
    demand("missing_force()", site=(site, optional(text)), rate=(rate, above(0, "Hz")))
    study, _, fitted = refitted_as_heard(_study_for(campaign, rate))
    return force_of(study, fitted, site)


def _study_for(campaign: Campaign | str | Path, rate: float) -> Study:
    """Return the study of a campaign's network."""
    campaign = thinned(Campaign.of(campaign, read_model), rate)
    samples = sum(len(experiment.record.time) for experiment in campaign.training)
    accuracy = Accuracy(rtol=relative_tolerance(campaign), foreseen=samples * RUNS_PER_MODEL)
    study = study_of(campaign, accuracy)
    if isinstance(study, FMUStudy):
        raise ModelError("the missing force needs the equations of the model; give a network, not an FMU")
    return study.granting_steps()
