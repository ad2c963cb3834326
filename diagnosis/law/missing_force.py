"""`MissingForce`: the force at a site that explains what a model misses of its records, over time."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from ...base import Array, computing
from ...components import ModelError, SimulationError, nearest
from ..criteria import FORCE_SUFFICES, PART_CHI_SQUARED
from ..effects.effect import Motion
from ..effects.sites import Site
from ..models.study import Study
from ..search.model_comparison import Refit
from .aligned import aligned
from .axes import VARIABLES
from .drawing import Drawing
from .law import STATIC, Law
from .polish import polished
from .search import Search, Settled
from .shown import Showing
from .spans import spans


@dataclass(frozen=True, eq=False)
class ForceOverTime:
    """The missing force in one record.

    Attributes:
        record: its name.
        time: instants [s].
        force, standard_error: at them; like that of a spring positive when it pulls the flanges together.
        motion: of the site with that force.
    """

    record: str
    time: Array
    force: Array
    standard_error: Array
    motion: Motion


@dataclass(frozen=True)
class SiteOfForce:
    """A site as the place of the missing force.

    Attributes:
        site: its path.
        evidence: logarithm of the likelihood of the records with the likeliest force there, 0 for the best.
    """

    site: str
    evidence: float


@dataclass(frozen=True, eq=False)
class MissingForce:
    """The force at a site that explains what a model misses of its records.

    Attributes:
        site: where it acts.
        ranking: sites, the one first at which the least force suffices.
        records: the force in each training record.
        parameters: the uncertain parameters beside it.
        misfit: root mean square of what a run with it misses, in units of noise.
        before: the same of the model without it, its parameters fitted.
    """

    site: Site
    ranking: tuple[SiteOfForce, ...]
    records: tuple[ForceOverTime, ...]
    parameters: dict[str, float]
    misfit: float
    before: float
    search: Search = field(repr=False)
    settled: Settled = field(repr=False)

    @property
    def unit(self) -> str:
        """That of the force."""
        return "N.m" if self.site.domain == "rotational" else "N"

    @property
    def told(self) -> str:
        """Its root mean square with the unit."""
        return f"{self.settled.rms:.3g} {self.unit}"

    @property
    def force(self) -> dict[str, Array]:
        """The force by record."""
        return {one.record: one.force for one in self.records}

    @property
    def standard_error(self) -> dict[str, Array]:
        """Its standard error by record."""
        return {one.record: one.standard_error for one in self.records}

    @property
    def alike(self) -> list[str]:
        """The other sites that the records do not part from its own, as they are of one motion."""
        sites = {site.path: site for site in self.search.bench.sites}
        near = [one.site for one in self.ranking if one.evidence > -PART_CHI_SQUARED / 2]
        found = [path for one in (self.site.path, *near) for path in (one, *sites[one].same)]
        return [path for path in dict.fromkeys(found) if path != self.site.path]

    @property
    def active(self) -> list[dict[str, float | str]]:
        """The stretches that hold most of its square; all of each record where it is spread out.

        Each is {"record", "from", "to", "share"}, its instants in s.
        """
        even = [(one, np.linspace(one.time[0], one.time[-1], len(one.time))) for one in self.records]
        return spans([(one.record, t, np.interp(t, one.time, one.force) ** 2) for one, t in even])

    @cached_property
    def by_position(self) -> Law:
        """The law of it over position."""
        return self.law(("position",))

    def law(self, variables: Sequence[str] | None = None) -> Law:
        """Return what the force depends on, and how.

        Args:
            variables: one or two of "position", "speed", "acceleration", "load", "time"; those that foresee
                most of what is missing in stretches that the law was not fitted to, if not given.
        """
        chosen = None if variables is None else _variables(variables)
        return Drawing(self.site, self.settled).law(chosen)

    def shown(self, variables: Sequence[str] | None = None) -> Law:
        """Return the law that the force itself shows along the motion, by what it foresees of its own course.

        What records say of a law that holds the speed of its joint, or that sends a machine elsewhere for a
        small error, is not linear, and `law` foresees little of them.

        Args:
            variables: "position", "speed" or both; the one that foresees most if not given, both if that is
                too little.
        """
        showing = Showing(self.site, self.settled)
        return showing.plainest() if variables is None else showing.law(_variables(variables))

    def polished(self, variables: Sequence[str] | None = None) -> tuple[Law, float]:
        """Return a law of position, speed or both that is fitted to free runs, and what these miss.

        That is the root mean square over the test records, or the training ones if there are none [noise].

        Args:
            variables: "position", "speed" or both; those that foresee most if not given.
        """
        drawing = Drawing(self.site, self.settled)
        law = drawing.law(among=STATIC) if variables is None else drawing.law(_variables(variables))
        found = polished(self.search.study, law)
        return found.law, found.model.misfit

    def plot(self, path: Any = None) -> Any:
        """Draw it over time and over position and speed, and return the figure; given a path, save it."""
        from .pictures import drawn_force

        return drawn_force(self, path)

    def __str__(self) -> str:
        """Say where, how large, and how much it explains."""
        told = f"missing force at {self.site.path}: {self.told} rms"
        return f"{told}; leaves {self.misfit:.3g} times the noise, {self.before:.3g} times without"


@computing("the search for the missing force")
def force_of(study: Study, refit: Refit, site: str | None = None) -> MissingForce:
    """Return the missing force in a study, sought from where its parameters alone lead.

    Where more than noise is left so, it is also sought from where they were given: parameters that stood in
    for a force may have gone far.
    """
    first = Search(study, refit)
    number = _number(first, site)
    search, ranked, settled = first, *first.best(number)
    given = study.campaign.start
    if settled.misfit > FORCE_SUFFICES and refit.parameters != given:
        with suppress(ModelError, SimulationError):
            other = Search(study, replace(refit, parameters=given, starts=[{} for _ in refit.starts]))
            again = other.best(number)
            if again[1].misfit < settled.misfit:
                search, ranked, settled = other, *again
    settled = aligned(settled)
    most = max(evidence for _, evidence, _ in ranked)
    records = tuple(
        ForceOverTime(run.experiment.name, force.t, force.values, error.values, run.motion(settled.number))
        for run, force, error in zip(settled.runs, settled.forces, settled.errors, strict=True)
    )
    sites = search.bench.sites
    return MissingForce(
        sites[settled.number],
        tuple(SiteOfForce(sites[n].path, evidence - most) for n, evidence, _ in ranked),
        records,
        dict(settled.given),
        settled.misfit,
        first.misfit,
        search,
        settled,
    )


def _number(search: Search, site: str | None) -> int | None:
    """Return the number of a site that is named, or of which a component between the same nodes is."""
    if site is None:
        return None
    names = {name: n for n, one in enumerate(search.bench.sites) for name in (one.path, *one.same)}
    if site not in names:
        raise ModelError(f"there is no site '{site}'{nearest(site, names)}; the sites are {', '.join(names)}")
    return names[site]


def _variables(given: Sequence[str]) -> tuple[str, ...]:
    names = (given,) if isinstance(given, str) else tuple(given)
    wrong = [name for name in names if name not in VARIABLES]
    if wrong:
        known = ", ".join(VARIABLES)
        raise ModelError(
            f"a law is over one or two of {known}; got '{wrong[0]}'{nearest(wrong[0], VARIABLES)}"
        )
    if len(names) not in (1, 2) or len(set(names)) < len(names):
        raise ModelError(f"a law is over one or two different variables, got {names}")
    return tuple(name for name in VARIABLES if name in names)
