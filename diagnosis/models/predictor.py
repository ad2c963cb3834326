"""What predicts the outputs of a campaign: a network by its equations, or an FMU by its runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ...base import Array
from ...identification import Accuracy, Campaign, Experiment, RecordModel
from ...networks import Network, Variations
from ..criteria import ACTIVE_POWER_SHARE
from ..effects.effect import Motion
from ..effects.hypothesis import Hypothesis, with_effects
from ..effects.sites import Site, sites_of
from .fmu_model import FMUModel
from .fmu_predictor import FMUPredictor
from .probes import motion_at, probed


class Predicted(Protocol):
    """The outputs in a run, by channel, and their slopes in parameters and start values."""

    time: Array
    values: dict[str, Array]
    slopes: dict[str, Array]
    start_slopes: dict[str, Array]


class Standing(Protocol):
    """A model on one record."""

    def rest(self, parameters: Mapping[str, float], accuracy: Accuracy) -> Array:
        """Return the states from which it starts."""
        ...

    def run(
        self, parameters: Mapping[str, float], start: Array | None, accuracy: Accuracy, slopes: bool = True
    ) -> Any:
        """Run the record and return what is `Predicted`."""
        ...

    def pushed(self, found: Any, changes: Mapping[str, Array]) -> Array:
        """Return what small changes of inputs, or at sites, change: (instants, outputs, changes)."""
        ...


class Predictor(Protocol):
    """A model with effects in it, and probes at sites."""

    def stand(self, experiment: Experiment) -> Standing:
        """Return the model on a record."""
        ...

    def instants(self, found: Any) -> Array:
        """Return at which instants of a run changes are to be given [s]."""
        ...

    def motion(self, found: Any, number: int, site: Site) -> Motion:
        """Return how a site moves in a run."""
        ...


class Equations:
    """A network; slopes come from the variational equations along its runs."""

    def __init__(
        self,
        campaign: Campaign,
        network: Network,
        effects: Sequence[Hypothesis],
        parameters: Sequence[str],
        sites: Sequence[Site],
    ) -> None:
        changed = with_effects(network, effects)
        self.dae = (probed(changed, sites) if sites else changed).dae()
        self.channels = campaign.measured
        outputs = [c.path for c in self.channels.values() if not c.driven]
        self.variations = Variations(self.dae, outputs, parameters)

    def stand(self, experiment: Experiment) -> RecordModel:
        """Return the network on a record."""
        return RecordModel(self.dae, experiment, self.channels, self.variations)

    def instants(self, found: Any) -> Array:
        """Return the points of a run [s]."""
        time: Array = found.run.time
        return time

    def motion(self, found: Any, number: int, site: Site) -> Motion:
        """Return how a probed site moves."""
        return motion_at(found.run, number, site)


@dataclass(frozen=True)
class Subject:
    """The model of a campaign, a network, as a diagnosis sees it."""

    campaign: Campaign

    def predictor(
        self,
        network: Network,
        effects: Sequence[Hypothesis],
        parameters: Sequence[str],
        sites: Sequence[Site] = (),
    ) -> Predictor:
        """Return what predicts the outputs.

        Args:
            network: the network without effects, if the model is one.
            effects: what is in it besides.
            parameters: names of the parameters, those of effects included, in which slopes are wanted.
            sites: where it will be pushed.
        """
        return Equations(self.campaign, network, effects, parameters, sites)

    def sites(self, network: Network) -> list[Site]:
        """Return where in the model effects may hide."""
        return sites_of(network)

    def screened(self) -> tuple[list[Experiment], dict[str, float]]:
        """Return the records by which effects are screened, and the noise that makes them count for all."""
        return self.campaign.training, self.campaign.sigma

    def part(self, path: str) -> str:
        """Return the component of the network that a variable or parameter belongs to."""
        return path.rpartition(".")[0]

    def limits(self) -> list[str]:
        """Return what the kind of model keeps a diagnosis from seeing, in words."""
        return []


@dataclass(frozen=True)
class FMUSubject(Subject):
    """A model that is an FMU, alone or between sources and sensors; each signature takes a run of it."""

    box: FMUModel

    def predictor(
        self,
        network: Network,
        effects: Sequence[Hypothesis],
        parameters: Sequence[str],
        sites: Sequence[Site] = (),
    ) -> FMUPredictor:
        """Return its runs."""
        return FMUPredictor(self.box, self.campaign, effects, parameters)

    def sites(self, network: Network) -> list[Site]:
        """Return its port."""
        return self.box.sites

    def screened(self) -> tuple[list[Experiment], dict[str, float]]:
        """Return the first record, which has to do."""
        campaign, weight = self.campaign, len(self.campaign.training) ** -0.5
        return campaign.training[:1], {name: weight * sigma for name, sigma in campaign.sigma.items()}

    def part(self, path: str) -> str:
        """Return the FMU's component, or the one beside it."""
        return self.box.part(path)

    def limits(self) -> list[str]:
        """Tell that its inside is not looked at, and when its port gives energy off."""
        box, campaign = self.box, self.campaign
        model = self.predictor(campaign.network, (), ())
        told = box.limits(model.taken)
        port = model.stand(campaign.training[0]).run(campaign.start, None, Accuracy(), False).port
        if box.port is None or port is None:
            return told
        power = float(np.trapezoid(port.f * port.v, port.t))
        if power < -ACTIVE_POWER_SHARE * float(np.trapezoid(np.abs(port.f * port.v), port.t)):
            told.append(
                f"at the port the FMU gives energy off; if it should take it, '{box.port.force}' counts the "
                "other way: put a minus before it"
            )
        return told


def subject(campaign: Campaign) -> Subject:
    """Return the model of a campaign as a diagnosis sees it."""
    machine = campaign.machine
    return FMUSubject(campaign, machine) if isinstance(machine, FMUModel) else Subject(campaign)
