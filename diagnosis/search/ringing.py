"""Impacts that ring faster than records are compared: models held against what passes a low pass."""

from __future__ import annotations

from dataclasses import replace
from math import inf

from ...components import InertanceError
from ..effects.plausibility import refused
from ..models.low_pass import low_passed
from ..models.study import FMUStudy, Study
from .fit import in_several_sizes
from .model_comparison import Refit
from .recast import Recast
from .round import Round, nearest_in_series


def behind_low_pass(study: Study, start: Refit, done: Round) -> Recast | None:
    """Return models behind a low pass, with the best effect in series of a first round.

    None for an FMU, where nothing rings that is measured, if no such effect came near, or if it cannot be run
    or be a machine's.
    """
    chosen = nearest_in_series(done)
    campaign = None if chosen is None or isinstance(study, FMUStudy) else low_passed(study.campaign)
    if chosen is None or campaign is None:
        return None
    cutoffs = {name: c.cutoff for name, c in campaign.measured.items() if c.cutoff < inf}
    names = " and ".join(cutoffs)
    study.tell(f"fitting {chosen.labels[-1]} to what is slow of {names}")
    screened = next(c for c in done.candidates if c.label == chosen.labels[-1])
    sizes = in_several_sizes(screened.values)
    starts = [chosen.values, *((done.base.parameters, v) for v in sizes)]
    told = (
        f"{names}: model and record are compared behind a low pass of {next(iter(cutoffs.values())):.3g} Hz; "
        f"what rings faster, as beside {chosen.labels[-1]}, hangs on a logger's filter that nobody told"
    )
    try:
        found = Recast.of(replace(study, campaign=campaign), start, done.base, chosen, told, starts)
    except InertanceError:
        return None
    return None if refused(found.model.effects[-1], campaign) else found
