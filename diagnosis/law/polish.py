"""A law as a component of the model: fitted to free runs, and held against the test records."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from ...base import Array, computing
from ...components import SimulationError
from ..criteria import FORCE_LAW_STIFFNESS, LAW_HELD_SHARE, LAW_POLISHES, START_DROP_RATIO
from ..effects.edits import Edit, between
from ..effects.effect import Effect, Values
from ..effects.hypothesis import Hypothesis
from ..effects.sites import Site
from ..models.study import Study
from ..search.joint_fit import JointFit
from ..search.model_comparison import Refit
from ..search.record_start import projected
from .along import Begin, Bench, Beside
from .law import Law, element_of
from .regression import Tallies, apart, beside, fitted, moved, own_of, through

KIND, NAME = "law", "missing"  # of a law among effects, and of its component


def placed(law: Law, name: str = NAME) -> Hypothesis:
    """Return a law as what a model may be missing, by the name that it is to have there."""
    element = element_of(law.site, law.grid, law.values, law.origin)

    def edits(site: Site, name: str, _: Values) -> list[Edit]:
        return between(name, element, site.fixed, site.moving)

    effect = Effect(KIND, "across", {law.site.domain: ()}, edits)
    return Hypothesis(effect, law.site, name, {})


@dataclass(frozen=True, eq=False)
class Trial:
    """A model with a law, and its free runs."""

    values: Array
    given: Mapping[str, float]
    runs: list[Beside]

    @property
    def squares(self) -> float:
        """What they miss, squared."""
        return float(sum((run.left**2).sum() for run in self.runs))

    @property
    def left(self) -> float:
        """The root mean square of it, in units of noise."""
        return float(np.sqrt(self.squares / sum(run.left.size for run in self.runs)))

    @property
    def followed(self) -> list[int]:
        """For how many samples each run follows its record."""
        return [run.followed(run.experiment) for run in self.runs]

    def until(self, samples: Sequence[int]) -> Trial:
        """Return the trial with runs that count until a sample each."""
        runs = [replace(run, until=count) for run, count in zip(self.runs, samples, strict=True)]
        return replace(self, runs=runs)


@dataclass(frozen=True, eq=False)
class Polished:
    """A law fitted to free runs of the model that has it.

    Attributes:
        model: with the law, held against all records.
        changing: share of the square of what is left that it would take if it grew or faded with time.
        left: root mean square of what it misses of the training records [noise].
    """

    law: Law
    model: Refit
    changing: float
    left: float


@computing("a law in free runs")
def polished(study: Study, law: Law) -> Polished:
    """Return a law fitted to free runs of the model that has it beside the effects that it was drawn with.

    Raises:
        SimulationError: if it cannot be run.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # of models that a law makes unstable, told below
        return _held(study, law, _nearest(study, law, first_trial(study, law)))


def as_it_is(study: Study, law: Law) -> Polished:
    """Return a law as it was fitted to other records, or to these in other parts, held against a study.

    Raises:
        SimulationError: if it cannot be run.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        return _held(study, law, first_trial(study, law))


def first_trial(study: Study, law: Law) -> Trial:
    """Return the model with a law as it was drawn, from where it was, in free runs."""
    given, begins = law.given, [run.begin for run in law.runs]
    if study.pieces:
        first = law.runs[0].bench
        bench = Bench(study, first.names, [*first.effects, placed(law)])
        begins = [bench.begin(experiment, given, {}) for experiment in study.campaign.training]
    drawn = through(law.grid, law.motions, law.forces, FORCE_LAW_STIFFNESS)
    tried = (_run(study, law, values, given, begins) for values in (law.values, drawn))
    return min(tried, key=lambda one: (-sum(one.followed), one.squares))


def _nearest(study: Study, law: Law, here: Trial) -> Trial:
    """Return the trial to which steps lead from one."""
    whole = [len(run.found.time) for run in here.runs]
    for number in range(LAW_POLISHES):
        counted = followed = here.followed
        there = _stepped(study, law, here, counted)
        if there is None and not number:
            counted = whole
            there = _stepped(study, law, here, counted)
        if there is None:
            break
        drop = 1 - there.until(counted).squares / here.until(counted).squares
        here, farther = there, sum(there.followed) > sum(followed)
        if drop < START_DROP_RATIO and not farther:
            break
    return here


def _held(study: Study, law: Law, here: Trial) -> Polished:
    """Return a law as it is in a trial, held against all records."""
    found = replace(law, values=here.values, fit=replace(law.fit, moved=_moved(study, here.given)))
    joint = JointFit(study, here.given, [*law.runs[0].bench.effects, placed(found)])
    return Polished(found, joint.seen(joint.start), _changing(found, here), here.left)


def _stepped(study: Study, law: Law, here: Trial, until: Sequence[int]) -> Trial | None:
    """Return a better trial along runs that count until a sample each; None if no share of the step is."""
    before = here.until(until)
    step = _step(study, law, before)
    for share in (1.0, 0.5, 0.25, 0.1):
        with suppress(SimulationError):
            there = step(share)
            if there.until(until).squares < before.squares:
                return there
    return None


def _moved(study: Study, given: Mapping[str, float]) -> Array:
    """Return how far parameters are from the centers of their priors."""
    priors = [study.campaign.priors[name] for name in given]
    return np.array([(value - p.center) / p.scale for value, p in zip(given.values(), priors, strict=True)])


def _run(study: Study, law: Law, values: Array, given: Mapping[str, float], begins: Sequence[Begin]) -> Trial:
    effects = law.runs[0].bench.effects
    bench = Bench(study, [*given], [*effects, placed(replace(law, values=values))])
    pairs = zip(study.campaign.training, begins, strict=True)
    runs = [bench.run(experiment, given, begin) for experiment, begin in pairs]
    return Trial(values, given, runs)


def _step(study: Study, law: Law, here: Trial) -> Callable[[float], Trial]:
    """Return what makes a trial a share of the way to what is best along the runs so far."""
    before = _moved(study, here.given)
    parts = [beside(run, law.number, law.grid, law.origin, here.values) for run in here.runs]
    tallies = Tallies.of_parts(here.runs, law.number, parts)
    stiffness = None if law.shown else law.fit.stiffness  # what the force bore says nothing of what runs do
    found = fitted(tallies.held(before, LAW_HELD_SHARE), law.grid, stiffness=stiffness)
    unknown = np.concatenate([found.moved, found.values])
    begun = [
        own_of(stacked[:, :, 0] - stacked[:, :, 1:] @ unknown, own, priors)
        for stacked, own, priors, _ in parts
    ]

    def trial(share: float) -> Trial:
        values = here.values + share * (found.values - here.values)
        parameters = before + share * (found.moved - before)
        given = law.beside(parameters)
        begins = [run.began(share * own, 0) for run, own in zip(here.runs, begun, strict=True)]
        return _run(study, law, values, given, begins)

    return trial


def _changing(law: Law, trial: Trial) -> float:
    """Return the share of the square of what is left that a law would take if it changed with time.

    Like effects, see `verdict.steadiness`: by a share of itself that grows from the beginning of each record
    to its end, beside all that the law and the parameters can do.
    """
    rows = []
    for run in trial.runs:
        stacked, own, priors, _ = beside(run, law.number, law.grid, law.origin, law.values)
        motion = moved(run, law.number, law.origin)
        elapsed = np.interp(run.t, run.t[[0, -1]], [-1.0, 1.0])
        grown = run.answers(law.number, (elapsed * (law.grid.basis(motion) @ law.values))[:, None])
        whole = apart(np.concatenate([stacked, grown], axis=2), own, priors)
        rows.append(whole.reshape(-1, whole.shape[2]))
    flat = np.vstack(rows)
    if not np.isfinite(flat).all():
        raise SimulationError(f"the law at {law.site.path} makes the model unstable")
    inner = slice(1, flat.shape[1] - 1)
    left, grown = projected(flat[:, [0, -1]] / np.linalg.norm(flat[:, [0, -1]], axis=0), flat[:, inner]).T
    length = float(grown @ grown) * float(left @ left)
    return float(grown @ left) ** 2 / length if length else 0.0
