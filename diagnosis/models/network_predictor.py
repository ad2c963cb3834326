"""`NetworkPredictor`: what a network with effects in it predicts of records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ...base import Array
from ...components import ModelError
from ...identification import Campaign, Change, Experiment, RecordModel
from ...networks import Network, Variations
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis, with_effects
from ..effects.sites import Site
from .force import Force, push_of
from .low_pass import behind_low_passes
from .probes import motion_at, probed


class NetworkPredictor:
    """A network with effects in it, probed at sites; slopes come from the variational equations."""

    def __init__(
        self,
        campaign: Campaign,
        effects: Sequence[Hypothesis],
        parameters: Sequence[str],
        sites: Sequence[Site],
    ) -> None:
        changed = with_effects(campaign.network, effects)
        self.effects, self.network, self.parameters = effects, changed, list(parameters)
        self.channels = campaign.measured
        wired, outputs = behind_low_passes(probed(changed, sites) if sites else changed, self.channels)
        self.dae = wired.dae()
        self.own = list(campaign.per_record)
        self.clocks = [name for placed in effects for name in placed.clocks]
        self.variations = Variations(self.dae, outputs, [*parameters, *self.own])

    def stand(
        self, experiment: Experiment, number: int | None = None, force: Force | None = None
    ) -> RecordModel:
        """Return the network on a record, if it is given with a force at one of the sites."""
        pushed = {}
        if number is not None and force is not None:
            pushed[push_of(number)] = force.signal(experiment.compared.time)
        offsets = {f"{clock}.offset": -experiment.began for clock in self.clocks}
        set_back = replace(experiment, values={**experiment.values, **offsets})
        if experiment.change is None or not experiment.change.rebuilds:
            return RecordModel(self.dae, set_back, self.channels, self.variations, self.own, pushed)
        wired, outputs = behind_low_passes(self._rebuilt(experiment.change), self.channels)
        dae = wired.dae()
        parameters = [path for path in self.parameters if not experiment.change.replaces(path)]
        own = [path for path in self.own if not experiment.change.replaces(path)]
        variations = Variations(dae, outputs, [*parameters, *own])
        return RecordModel(dae, set_back, self.channels, variations, own, pushed)

    def _rebuilt(self, change: Change) -> Network:
        """Return the network with the components changed, once no effect is seen to go with them."""
        for placed in self.effects:
            gone = change.replaces(placed.site.path)
            stays = placed.effect.place != "series" and any(not change.replaces(p) for p in placed.site.same)
            if placed.site.domain != "channel" and gone and not stays:
                raise ModelError(
                    f"whether {placed.label} goes with '{gone}', which the change takes away, no model tells"
                )
        return change.applied(self.network)

    def instants(self, found: Any) -> Array:
        """Return at which instants of a run changes are to be given: its points [s]."""
        time: Array = found.run.time
        return time

    def motion(self, found: Any, number: int, site: Site) -> Motion:
        """Return how a probed site moves."""
        return motion_at(found.run, number, site)
