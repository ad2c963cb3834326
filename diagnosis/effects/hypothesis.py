"""Effects in their places, and the model that has them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from ...base import Array, rate_unit
from ...components import signals
from ...identification import Campaign, Experiment, Prior
from ...networks import Network
from ..criteria import LEAST_SIZE_RATIO, PARAMETER_STEP_RATIO
from .edits import AddPart, Edit, edited
from .effect import EFFECTS, Effect, Quantity, Values
from .sites import Site

DRY_FRICTION = "coulomb_friction"


@dataclass(frozen=True, eq=False)
class SitedEffect:
    """An effect at a site."""

    effect: Effect
    site: Site

    @property
    def key(self) -> tuple[str, str]:
        """Kind and path of the site."""
        return self.effect.kind, self.site.path

    @property
    def label(self) -> str:
        """Kind and site, and through which flange the force comes that loads it, if not its own."""
        by = f" by {self.site.load}" if self.site.load else ""
        return f"{self.effect.kind} at {self.site.path}{by}"

    def generalises(self, other: SitedEffect) -> bool:
        """Tell whether another one is a special case of this one, at the same site."""
        return self.effect.generalises(other.effect.kind) and self.site.path == other.site.path


@dataclass(frozen=True)
class Hypothesis(SitedEffect):
    """An effect at a site with values, and the name of what is inserted for it."""

    name: str
    values: Mapping[str, float]

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """The parameters of the effect."""
        return self.effect.quantities[self.site.domain]

    def units(self, campaign: Campaign) -> dict[str, str]:
        """Return the units of its parameters; of an effect on a channel, in that channel's."""
        si = campaign.measured[self.site.path].si if self.site.domain == "channel" else ""
        own = {"unit": si, "unit/s": rate_unit(si), "unit/s2": rate_unit(si, 2)}
        return {quantity.name: own.get(quantity.unit, quantity.unit) for quantity in self.quantities}

    @property
    def is_dry_friction(self) -> bool:
        """Whether it holds what does not slide."""
        return self.effect.kind == DRY_FRICTION or self.effect.generalises(DRY_FRICTION)

    def beside(self, others: Sequence[Hypothesis], sites: Sequence[Site]) -> Hypothesis:
        """Return it at its site as that is in a model, of such `sites`, with other effects."""
        bare = next((site for site in sites if site.path == self.site.path), self.site)
        return replace(self, site=replace(self.site, rubs=rubbed(bare, others).rubs))

    def joined(self, other: Hypothesis) -> dict[str, float] | None:
        """Return values with which it does what it does together with another one at the same site.

        The other is a special case of it, or has one in common with it, of which it is the rest; else None.
        """
        shared = [other] if self.generalises(other) else other.specials
        special = next((one for one in shared if self.generalises(one)), None)
        if special is None:
            return None
        sizes = self.effect.widened(self.site.domain, self.site, special.effect, special.values)[0]
        return {q.name: self.values[q.name] + (0.0 if q.shape else sizes[q.name]) for q in self.quantities}

    @property
    def specials(self) -> list[Hypothesis]:
        """Its special cases that are nearest to it, one of each kind."""
        kinds, domain = (EFFECTS[kind] for kind in self.effect.plain), self.site.domain
        return [replace(self, effect=k, values=self.effect.narrowed(domain, k, self.values)) for k in kinds]

    @property
    def edits(self) -> list[Edit]:
        """What inserts it; nothing for a channel."""
        return self.effect.edits(self.site, self.name, self.values) if self.effect.edits else []

    @property
    def begins(self) -> dict[str, Prior]:
        """Where it may have stood when a record in motion began, by full name."""
        return {f"{self.name}.{name}": prior for name, prior in self.effect.begins.items()}

    @property
    def clocks(self) -> list[str]:
        """The names of clocks that are inserted."""
        return [
            e.name for e in self.edits if isinstance(e, AddPart) and isinstance(e.component, signals.Clock)
        ]

    @property
    def network_parameters(self) -> dict[str, float]:
        """The parameters of what is inserted, by full name."""
        if self.effect.edits is None:
            return {}
        return self.effect.network_parameters(self.site, self.name, self.values)

    @property
    def scales(self) -> Array:
        """What each quantity may be expected to be: its value, at least a tenth of its like."""
        values = {q: abs(v) if (v := self.values[q.name]) > q.low else 0.0 for q in self.quantities}
        largest = {q.unit: max(v for p, v in values.items() if p.unit == q.unit) for q in values}
        return np.array([max(v, LEAST_SIZE_RATIO * largest[q.unit]) or 1.0 for q, v in values.items()])

    def with_values(self, values: Array) -> Hypothesis:
        """Return it with other values, in the order of its quantities."""
        names = [quantity.name for quantity in self.quantities]
        return replace(self, values=dict(zip(names, values.tolist(), strict=True)))

    def slopes(self, scales: Array) -> Array:
        """Return d(network parameters)/d(quantities), by central differences of the scales given."""
        base = np.array([self.values[q.name] for q in self.quantities])

        def parameters(values: Array) -> Array:
            return np.array([*self.with_values(values).network_parameters.values()])

        steps = np.diag(PARAMETER_STEP_RATIO * scales)
        return np.column_stack([(parameters(base + s) - parameters(base - s)) / (2 * s.sum()) for s in steps])


def rubbed(site: Site, effects: Sequence[Hypothesis]) -> Site:
    """Return a site that knows of dry friction that effects bring across it."""
    brought = any(placed.is_dry_friction and placed.site.path == site.path for placed in effects)
    return replace(site, rubs=site.rubs or brought)


def told(kind: str, site: str) -> str:
    """Return a kind of effect and a site in words."""
    return f"{kind.replace('_', ' ')} at {site}"


def inserted(effects: Sequence[Hypothesis]) -> dict[str, float]:
    """Return the parameters of all that effects insert, by full name."""
    return {name: value for placed in effects for name, value in placed.network_parameters.items()}


def with_effects(network: Network, effects: Sequence[Hypothesis]) -> Network:
    """Return a copy of a network with effects inserted."""
    return edited(network, [edit for placed in effects for edit in placed.edits])


def driven(
    experiment: Experiment, effects: Sequence[Hypothesis], begun: Values = MappingProxyType({})
) -> Experiment:
    """Return an experiment with its inputs as the actuators pass them on; itself if none changes any.

    What is known of where they had `begun` is by full name.
    """
    acting = [placed for placed in effects if placed.effect.change and placed.effect.drives]
    if not acting:
        return experiment
    record, values = experiment.record, dict(experiment.record.values)
    elapsed = experiment.elapsed(record.time)
    for placed in acting:
        name = placed.site.path
        stood = {full.rpartition(".")[2]: begun[full] for full in placed.begins if full in begun}
        values[name] = acted(placed.effect, experiment, elapsed, values[name], {**placed.values, **stood})
    return replace(experiment, record=replace(record, values=values))


def acted(effect: Effect, experiment: Experiment, elapsed: Array, signal: Array, values: Values) -> Array:
    """Return an input as an actuator passes it on.

    What a record in motion cannot tell, how the input moved before it, is taken for the parabola through its
    first sample and those once and twice as late, unless values tell where the actuator stood.
    """
    assert effect.change is not None
    if experiment.initial == "rest" or effect.begins.keys() & values.keys():
        return effect.change(elapsed, signal, values)
    count = (len(signal) - 1) // 2
    past = 3 * signal[0] - 3 * signal[1 : count + 1] + signal[2 : 2 * count + 1 : 2]
    before = 2 * elapsed[0] - elapsed[1 : count + 1]
    passed: Array = effect.change(np.append(before[::-1], elapsed), np.append(past[::-1], signal), values)
    return passed[count:]


def sensed(elapsed: Array, channel: str, values: Array, effects: Sequence[Hypothesis]) -> Array:
    """Return a channel as its sensor passes it on, at instants of a run."""
    for placed in effects:
        effect = placed.effect
        if placed.site.path == channel and effect.change and not effect.drives:
            values = effect.change(elapsed, values, placed.values)
    return values
