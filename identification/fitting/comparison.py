"""Every record predicted with the model's own and with the fitted parameters."""

from __future__ import annotations

from collections.abc import Mapping

from ...base import Array
from ...components import SimulationError
from .campaign_model import Accuracy, CampaignModel
from .outcome import Comparison, Fit
from .problem import FitProblem
from .residual_block import ResidualBlock

STEPS_TO_A_START = 4  # of the least squares that find start and offsets of a test record


def compared(found: Fit, bench: CampaignModel, accuracy: Accuracy) -> list[Comparison]:
    """Predict every record with the model's own and with the fitted parameters.

    Starts and offsets are those of the fit; for test records they are estimated, nothing else.
    """
    campaign = found.campaign
    fitted = {
        block.stand.experiment: (block, nuisances)
        for done in found.stages
        for block, nuisances in zip(done.blocks, done.optimum.nuisances, strict=True)
    }
    testing = CampaignModel(campaign.dae, campaign.measured, campaign.testing)
    comparisons = []
    for tested, model in ((False, bench), (True, testing)):
        for stand in model.stands:
            block = ResidualBlock(stand, campaign.outputs, campaign.sigma, None)
            before: dict[str, Array] = {}
            after: dict[str, Array] = {}
            problem = ""
            try:
                nuisances = _nuisances(block, fitted.get(stand.experiment), found.values, accuracy)
                after = _predicted(block, found.values, nuisances, accuracy)
                before = _predicted(block, campaign.start, nuisances, accuracy)
            except SimulationError as error:
                problem = str(error)
            comparisons.append(Comparison(stand.experiment, tested, before, after, problem))
    return comparisons


def _nuisances(
    block: ResidualBlock,
    known: tuple[ResidualBlock, Array] | None,
    values: Mapping[str, float],
    accuracy: Accuracy,
) -> Array:
    """Return start and offsets of a record: those of the fit, or those that suit the fitted parameters."""
    if known is None or known[0].offsets != block.offsets:
        return FitProblem([block], {}, values, accuracy).minimise(most=STEPS_TO_A_START).nuisances[0]
    block.center, block.width = known[0].center, known[0].width
    return known[1]


def _predicted(
    block: ResidualBlock, parameters: Mapping[str, float], nuisances: Array, accuracy: Accuracy
) -> dict[str, Array]:
    predictions = block.linearise(parameters, nuisances, accuracy, slopes=False).predictions
    measured = block.record.values
    return {name: measured[name] - block.residual(name, predictions, nuisances) for name in block.channels}
