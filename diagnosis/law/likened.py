"""Effects of the list that a law is like: fitted to it along the motion of the machine, before any run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import inf
from typing import Any

import numpy as np

from ...base import Array
from ..criteria import LIKENED_POINTS, LIKENED_SHAPE_SPREAD, LIKENED_SHARE, LIKENED_VALUES
from ..effects.effect import EFFECTS, Effect, Motion, Values
from ..effects.sites import Site
from ..models.probes import scaled
from ..search.model_comparison import Refit
from ..search.record_start import projected
from ..search.score_test import Candidate
from .law import Law
from .missing_force import MissingForce
from .regression import apart

MOVING = "t", "s", "v", "f", "a"  # what a motion tells at its points


def likened(missing: MissingForce, law: Law, base: Refit) -> list[Candidate]:
    """Return effects that do what a law does at its site, or what the missing force takes off a spring there.

    The likest comes first, with the values that make it so; its gain is so much of what a model misses as it
    has of the force. Those that do much less are left out.
    """
    return _sorted([*_across(law, base), *_in_series(missing, base)])


def likened_across(law: Law, base: Refit) -> list[Candidate]:
    """Return static effects, as `likened`, whatever constants of stiffness and damping are off."""
    return _sorted(_across(law, base))


def likened_in_series(missing: MissingForce, base: Refit) -> list[Candidate]:
    """Return effects in series with a spring, as `likened`."""
    return _sorted(_in_series(missing, base))


def _sorted(found: Iterable[Candidate]) -> list[Candidate]:
    return sorted(found, key=lambda candidate: -candidate.gain)


def _across(law: Law, base: Refit) -> Iterator[Candidate]:
    """Yield static effects at the site of a law."""
    pairs = [(run.motion(law.number), law.along(m)) for run, m in zip(law.runs, law.motions, strict=True)]
    every = _few([motion for motion, _ in pairs])
    motions, forces = [_at(m, every) for m, _ in pairs], [force[every] for _, force in pairs]
    site = scaled(law.site, motions, None)
    for effect in EFFECTS.values():
        if not effect.is_static or not effect.may_act(site):
            continue
        fit = _Fit(effect, site, motions, forces)
        widest = max(fit.motions, key=lambda m: m.travel)
        tried = [fit.of(shape) for shape in effect.shaped(site.domain, widest)]
        values, share = fit.refined(max(tried, key=lambda one: one[1]))
        if share > LIKENED_SHARE:
            yield Candidate(effect, site, values, share * base.cost, 1.0, _beside(law, effect, site, values))


def _in_series(missing: MissingForce, base: Refit) -> Iterator[Candidate]:
    """Yield effects in series with a spring at the site of a force, with what this takes off the spring."""
    settled = missing.settled
    motions = [run.motion(settled.number) for run in settled.runs]
    site, every = scaled(missing.site, motions, None), _few(motions)
    wanted = -np.concatenate([force.values[every] for force in settled.forces])
    whole = _joined([_at(m, every) for m in motions])
    moved = np.column_stack([whole.s, whole.v, np.ones(len(whole.s))])
    stiffness, _, preload = np.linalg.lstsq(moved, whole.f, rcond=None)[0].tolist()
    if stiffness <= 0:
        return
    whole = replace(whole, s=whole.s + preload / stiffness)
    for effect in EFFECTS.values():
        if effect.eased is None or not effect.may_act(site):
            continue
        values, left = _eased(effect, site.domain, whole, stiffness, wanted)
        share = 1 - left / float(wanted @ wanted)
        if share > LIKENED_SHARE:
            yield Candidate(effect, site, values, share * base.cost, 1.0, settled.given)


def _eased(
    effect: Effect, domain: str, motion: Motion, stiffness: float, wanted: Array
) -> tuple[dict[str, float], float]:
    """Return the value with which an effect takes off a spring what is wanted, and the square of the rest."""
    from scipy.optimize import minimize_scalar

    (size,) = effect.sizes(domain)
    eased = effect.eased
    assert eased is not None

    def left(exponent: float) -> float:
        return float(((wanted - eased(motion, stiffness, {size.name: np.exp(exponent)})) ** 2).sum())

    tried = np.log(np.geomspace(*LIKENED_VALUES))
    step, best = tried[1] - tried[0], min(tried.tolist(), key=left)
    found = minimize_scalar(left, bounds=(best - step, best + step), method="bounded")
    return {size.name: float(np.exp(found.x))}, float(found.fun)


def _few(motions: Sequence[Motion]) -> slice:
    """Return which points of motions are enough to tell what a force is like."""
    return slice(None, None, max(1, sum(len(m.t) for m in motions) // LIKENED_POINTS))


def _beside(law: Law, effect: Effect, site: Site, values: Values) -> dict[str, float]:
    """Return parameters beside an effect: they do what is linear in a law, in the outputs, in its place."""
    slopes, wanted = [], []
    for run, moved in zip(law.runs, law.motions, strict=True):
        motion = run.motion(law.number)
        rest = law.along(moved) - _force(effect, site, motion, values)
        columns, shared, priors = run.columns()
        answer = run.answers(law.number, rest[:, None])
        whole = np.concatenate([columns[:, :, 1 : 1 + shared], answer], axis=2)
        left = apart(whole, columns[:, :, 1 + shared :], priors).reshape(-1, shared + 1)
        slopes.append(left[:, :-1])
        wanted.append(left[:, -1])
    further = np.linalg.lstsq(np.concatenate(slopes), np.concatenate(wanted), rcond=None)[0]
    return law.beside(law.fit.moved + further)


def _force(effect: Effect, site: Site, motion: Motion, values: Values) -> Array:
    """Return the force of an effect along a motion."""
    assert effect.basis is not None
    sizes = [size.name for size in effect.sizes(site.domain)]
    shape = {name: value for name, value in values.items() if name not in sizes}
    units = effect.basis(effect.about(motion, site), shape)
    return np.asarray(np.column_stack(units) @ np.array([values[name] for name in sizes]))


def _at(motion: Motion, points: slice) -> Motion:
    """Return a motion at some of its points."""
    return replace(motion, **{name: getattr(motion, name)[points] for name in MOVING})


def _joined(motions: Sequence[Motion]) -> Motion:
    """Return the points of several motions one after another."""
    whole: dict[str, Any] = {name: np.concatenate([getattr(m, name) for m in motions]) for name in MOVING}
    return replace(motions[0], **whole)


class _Fit:
    """Values of an effect with which it is most like a force along motions, beside what is linear."""

    def __init__(
        self, effect: Effect, site: Site, motions: Sequence[Motion], forces: Sequence[Array]
    ) -> None:
        self.effect, self.domain, self.wanted = effect, site.domain, np.concatenate(forces)
        where, speed = (np.concatenate([getattr(m, name) for m in motions]) for name in ("s", "v"))
        straight = np.column_stack([where, speed, np.ones(len(where))])
        told = where, projected(self.wanted[:, None], straight)[:, 0]
        self.motions = [replace(effect.about(m, site), missed=told) for m in motions]
        self.linear = np.concatenate([np.column_stack([m.s, m.v]) for m in self.motions])
        self.all_of_it = self._left(np.zeros((len(self.wanted), 0)), np.zeros(0))[1] or 1.0

    def of(self, shape: Values) -> tuple[dict[str, float], float]:
        """Return sizes with a shape, and the share of the square of what is wanted that they have.

        A shape that numbers cannot hold has none of it.
        """
        assert self.effect.basis is not None
        with np.errstate(all="ignore"):
            columns = np.concatenate([np.column_stack(self.effect.basis(m, shape)) for m in self.motions])
        sizes = self.effect.sizes(self.domain)
        if not np.isfinite(columns).all():
            return {**{size.name: 0.0 for size in sizes}, **shape}, -inf
        found, left = self._left(columns, np.array([size.low for size in sizes]))
        values = dict(zip([size.name for size in sizes], found.tolist(), strict=True))
        return {**values, **shape}, 1 - left / self.all_of_it

    def _left(self, columns: Array, low: Array) -> tuple[Array, float]:
        from scipy.optimize import lsq_linear

        whole = np.column_stack([columns, self.linear])
        scale = np.linalg.norm(whole, axis=0)
        scale[scale == 0] = 1.0
        least = np.concatenate(
            [np.where(np.isfinite(low), 0.0, -np.inf), np.full(self.linear.shape[1], -np.inf)]
        )
        found = lsq_linear(whole / scale, self.wanted, (least, np.inf))
        return np.maximum(found.x[: len(low)] / scale[: len(low)], low), 2 * float(found.cost)

    def refined(self, best: tuple[dict[str, float], float]) -> tuple[dict[str, float], float]:
        """Return values with shapes about the best so far that make it liker."""
        from scipy.optimize import minimize

        names = [q.name for q in self.effect.quantities[self.domain] if q.shape]
        first = np.array([best[0][name] for name in names])
        if not names or not first.all():
            return best

        def at(factors: Array) -> tuple[dict[str, float], float]:
            return self.of(dict(zip(names, (first * np.exp(factors)).tolist(), strict=True)))

        corners = np.vstack([np.zeros(len(names)), LIKENED_SHAPE_SPREAD * np.eye(len(names))])
        options = {"initial_simplex": corners, "maxiter": 60 * len(names)}
        ended = minimize(lambda x: -at(x)[1], corners[0], method="Nelder-Mead", options=options)
        return max(best, at(ended.x), key=lambda one: one[1])
