"""Stages of a fit: each fits some parameters to some channels of some records, from where the last ended."""

from __future__ import annotations

from collections.abc import Callable

from ..campaign.stages import Stage
from .campaign_model import Accuracy, CampaignModel
from .least_squares import Iterate
from .outcome import Fit, FittedStage
from .problem import FitProblem
from .residual_block import ResidualBlock
from .uncertainty import uncertainty


def fit_stages(
    found: Fit, accuracy: Accuracy, tell: Callable[[str], None] = lambda line: None
) -> CampaignModel:
    """Fit stage after stage, each kept in `found` as soon as it is done; return the model on the records."""
    campaign = found.campaign
    bench = CampaignModel(campaign.dae, campaign.measured, campaign.training, list(campaign.priors))
    for number, stage in enumerate(campaign.stages, start=1):
        label = f"stage {number} of {len(campaign.stages)}, " if len(campaign.stages) > 1 else ""

        def progress(at: Iterate, label: str = label) -> None:
            tell(f"{label}iteration {at.number}, misfit {at.cost:.5g}")

        done = _fit_stage(found, bench, stage, accuracy, progress)
        found.stages.append(done)
        found.values.update(done.optimum.values)
        if done.optimum.ended == "interrupted":
            raise KeyboardInterrupt
    return bench


def _fit_stage(
    found: Fit, bench: CampaignModel, stage: Stage, accuracy: Accuracy, report: Callable[[Iterate], None]
) -> FittedStage:
    """Fit some parameters to some channels of some records, starting from the values in `found`."""
    campaign = found.campaign
    sigma = campaign.sigma
    blocks = [ResidualBlock(bench.stands[n], stage.channels, sigma, stage.filter) for n in stage.train]
    priors = {name: campaign.priors[name] for name in stage.parameters}
    optimum = FitProblem(blocks, priors, found.values, accuracy).minimise(report, interruptible=True)
    return FittedStage(stage, optimum, uncertainty(optimum, blocks, priors), blocks)
