"""Effects: what a model may be missing, each a library component and a way to insert it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...base import Array
from ...base.checks import demand, instance
from ...components import Domain, ModelError, nearest
from ...identification import Prior
from ...networks import Pieces
from ..criteria import REVERSAL_SPEED_RATIO
from .edits import Edit
from .sites import Site

Values = Mapping[str, float]


@dataclass(frozen=True)
class Motion:
    """How a site moves in the nominal model: time [s], distance, speed, force through it, acceleration.

    The run `began` at that instant [s].

    `missed`, where it is known, are the distances in all records, and how much of the residual a unit of
    force would explain at each.
    """

    t: Array
    s: Array
    v: Array
    f: Array
    a: Array
    began: float = 0.0
    missed: tuple[Array, Array] | None = None

    @property
    def elapsed(self) -> Array:
        """How long the run has lasted [s]."""
        return self.t - self.began

    @property
    def travel(self) -> float:
        """Half of the range of the distance."""
        return float(np.ptp(self.s)) / 2

    @property
    def distance(self) -> float:
        """Mean of the distance over time."""
        begin, end = float(self.t[0]), float(self.t[-1])
        return Pieces.lines(self.t, self.s).integral(np.positive, begin, end) / (end - begin)

    @property
    def speed(self) -> float:
        """Root mean square of the speed over time."""
        return float(np.sqrt(self.squared / (self.t[-1] - self.t[0])))

    @property
    def squared(self) -> float:
        """Integral of the squared speed over time."""
        return Pieces.lines(self.t, self.v).integral(np.square, float(self.t[0]), float(self.t[-1]))

    @property
    def direction(self) -> Array:
        """Sign of the speed, smooth within a hundredth of its usual size."""
        return np.tanh(self.v / max(REVERSAL_SPEED_RATIO * self.speed, 1e-12))


Extent = Motion | Site  # what has a travel and a speed


@dataclass(frozen=True)
class Quantity:
    """A parameter of an effect.

    Attributes:
        name: as in the component or, for channels, in the report.
        low: least value; an effect is absent where all its sizes are 0.
        shape: whether it shapes the effect rather than being its size; shapes have no meaning without a size.
    """

    name: str
    unit: str
    low: float = 0.0
    shape: bool = False


@dataclass(frozen=True)
class Effect:
    """A kind of effect.

    Attributes:
        kind: its name, in code, JSON and report.
        place: "across", "loaded", "series", "node" (as of `Site`), or "channel".
        quantities: its parameters, by domain ("translational", "rotational") or for a "channel".
        edits: what inserts it: (site, name, values) -> edits of the network.
        basis: (motion, shape) -> what each size adds for its unit: a force across, a stretch in series.
        shapes: (motion or site) -> values of the shape parameters worth trying.
        eased: series only: (motion of a spring and what is in series with it, that spring's stiffness,
            values) -> the force that the spring bears less with it; its distance counts from where it is
            at rest, its force is that of the spring alone.
        change: channel only: (time, signal, values) -> the signal as the channel passes it on.
        drives: channel only: whether it is an actuator, which changes an input, not a sensor.
        begins: channel only: where it may have stood when a record in motion began, by names that `change`
            finds among the values where that is known.
        parameters: (name, values) -> the network's parameters, if they are not `name.quantity`.
        step: share of a quantity over which its slopes are differences; 0 for slopes along the run, which
            channels do not have, and which say little of where impacts end up.
        memory: whether its force depends on how the site moved before.
        ages: whether it changes as time goes on.
        origin: from where on its site the distance counts, on which its force depends: where it rests.
        grounded: whether it acts from the ground alone, as gravity does, not between two moving parts.
        unsprung: whether it acts only where no part has a stiffness, which would yield itself.
        rough: whether an error of its values shifts all that follows, as of where parts hit or are held.
        displaces: whether it acts on what stands still, so that a machine rests elsewhere than without it.
        credible: whether values are those of such an effect, and do not only bend its law into another.
        plain: special cases, the nearest first: by kind, what each size is then, over its one size, or over
            each of them.
        likewise: values -> others to begin at, where it is, or nearly, the special case it is with these.
    """

    kind: str
    place: str
    quantities: Mapping[str, tuple[Quantity, ...]]
    edits: Callable[[Site, str, Values], list[Edit]] | None = None
    basis: Callable[[Motion, Values], list[Array]] | None = None
    shapes: Callable[[Extent], list[dict[str, float]]] = field(default=lambda motion: [dict[str, float]()])
    eased: Callable[[Motion, float, Values], Array] | None = None
    change: Callable[[Array, Array, Values], Array] | None = None
    drives: bool = False
    begins: Mapping[str, Prior] = field(default_factory=dict)
    parameters: Callable[[Site, str, Values], dict[str, float]] | None = None
    step: float = 0.0
    memory: bool = False
    ages: bool = False
    origin: Callable[[Site], float] = field(default=lambda site: site.rest)
    grounded: bool = False
    unsprung: bool = False
    rough: bool = False
    displaces: bool = False
    credible: Callable[[Values], bool] = field(default=lambda values: True)
    plain: Mapping[str, tuple[float, ...] | tuple[tuple[float, ...], ...]] = field(default_factory=dict)
    likewise: Callable[[Values], list[dict[str, float]]] = field(default=lambda values: [])

    @property
    def is_static(self) -> bool:
        """Whether it is a force across a site that position and speed alone decide."""
        return self.place == "across" and not self.memory and not self.ages

    def may_act(self, site: Site) -> bool:
        """Tell whether it is a force or stretch of a kind that may act at a site."""
        here = self.place in site.places and site.domain in self.quantities
        yields = self.unsprung and site.yields
        unfit = yields or (self.memory and site.instant) or (self.grounded and not site.grounded)
        return self.basis is not None and here and not unfit

    def about(self, motion: Motion, site: Site) -> Motion:
        """Return a motion of a site with its distances as they count for the effect."""
        return replace(motion, s=motion.s - self.origin(site))

    def generalises(self, kind: str) -> bool:
        """Tell whether a kind is a special case of this one."""
        return kind in self.plain

    def shaped(self, domain: str, extent: Extent) -> list[dict[str, float]]:
        """Return values of the shape parameters worth trying, by their names in a domain."""
        names = [q.name for q in self.quantities[domain] if q.shape]
        return [dict(zip(names, shape.values(), strict=True)) for shape in self.shapes(extent)]

    def sizes(self, domain: str) -> list[Quantity]:
        """Return the parameters that vanish with the effect."""
        return [q for q in self.quantities[domain] if not q.shape]

    def widened(self, domain: str, extent: Extent, plain: Effect, values: Values) -> list[dict[str, float]]:
        """Return values at which it is its special case with the values given: by shape, then likewise."""
        own = np.array([values[q.name] for q in plain.sizes(domain)])
        sizes = np.reshape(self.plain[plain.kind], (-1, len(own))) @ own
        named = dict(zip([q.name for q in self.sizes(domain)], sizes.tolist(), strict=True))
        kept = {q.name: values[q.name] for q in plain.quantities[domain] if q.shape}
        shapes = [shape | kept for shape in self.shaped(domain, extent)] or [kept]
        found = [named | shape for n, shape in enumerate(shapes) if shape not in shapes[:n]]
        return [*found, *(other for values in found for other in self.likewise(values))]

    def narrowed(self, domain: str, plain: Effect, values: Values) -> dict[str, float]:
        """Return values of its special case, of the sizes that are nearest to its own."""
        own, sizes = self.sizes(domain), plain.sizes(domain)
        widening = np.reshape(self.plain[plain.kind], (len(own), len(sizes)))
        nearest = np.linalg.lstsq(widening, np.array([values[q.name] for q in own]), rcond=None)[0]
        shape = {q.name: values[q.name] for q in plain.quantities[domain] if q.shape}
        return dict(zip([q.name for q in sizes], nearest.tolist(), strict=True)) | shape

    def network_parameters(self, site: Site, name: str, values: Values) -> dict[str, float]:
        """Return the parameters of the inserted component, by full name."""
        if self.parameters is not None:
            return self.parameters(site, name, values)
        return {f"{name}.{quantity}": value for quantity, value in values.items()}

    def __reduce__(self) -> tuple[Callable[[str], Effect], tuple[str]]:
        """Go to other processes by name: functions do not travel."""
        return effect_of, (self.kind,)


EFFECTS: dict[str, Effect] = {}


def register(effect: Effect) -> Effect:
    """Make an effect known to every diagnosis.

    Raises:
        ModelError: if its kind is taken, or if it is no `Effect`.
    """
    demand("register()", effect=(effect, instance(Effect)))
    if effect.kind in EFFECTS:
        raise ModelError(f"there is an effect '{effect.kind}' already; choose another kind")
    EFFECTS[effect.kind] = effect
    return effect


def effect_of(kind: str) -> Effect:
    """Return an effect by its kind.

    Raises:
        ModelError: for an unknown kind, with the nearest one.
    """
    if kind not in EFFECTS:
        raise ModelError(f"there is no effect '{kind}'{nearest(kind, EFFECTS)}")
    return EFFECTS[kind]


def both(**names: Any) -> dict[str, tuple[Quantity, ...]]:
    """Return quantities, each ((translational name, unit), (rotational name, unit), low, shape)."""
    return {
        domain: tuple(Quantity(*entry[number], *entry[2:]) for entry in names.values())
        for number, domain in enumerate(Domain)
    }
