"""Probes: a network with a force across, and a stretch in series with, each site, both zero until asked."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import inf
from typing import Any

import numpy as np

from ...components import (
    CompliantWithSpeed,
    Component,
    Domain,
    RealInput,
    TwoFlanges,
    der,
    rotational,
    variable,
)
from ...networks import Network, Result
from ..effects.edits import Edit, Insert, between, edited
from ..effects.effect import Motion
from ..effects.sites import GROUND, Site


class Push(CompliantWithSpeed):
    """A force between two flanges from a signal, and how they move: f = u."""

    u = RealInput("N", "force")
    a_rel = variable("m/s2", "relative acceleration")

    def equations(self) -> Iterable[Any]:
        """State the force and the acceleration."""
        yield self.f == self.u
        yield self.a_rel == der(self.v_rel)


class Twist(rotational.CompliantWithSpeed):
    """A torque between two flanges from a signal, and how they turn: tau = u."""

    u = RealInput("N.m", "torque")
    a_rel = variable("rad/s2", "relative acceleration")

    def equations(self) -> Iterable[Any]:
        """State the torque and the acceleration."""
        yield self.tau == self.u
        yield self.a_rel == der(self.w_rel)


class StretchProbe(TwoFlanges):
    """A distance between two flanges from a signal: s_rel = u; the force goes through."""

    u = RealInput("m", "distance")
    f = variable("N", "force through it")

    def equations(self) -> Iterable[Any]:
        """State the distance and the force."""
        yield self.s_rel == self.u
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class Turn(rotational.TwoFlanges):
    """An angle between two flanges from a signal: phi_rel = u; the torque goes through."""

    u = RealInput("rad", "angle")
    tau = variable("N.m", "torque through it")

    def equations(self) -> Iterable[Any]:
        """State the angle and the torque."""
        yield self.phi_rel == self.u
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


PROBES: dict[str, tuple[type[Component], type[Component]]] = {
    Domain.TRANSLATIONAL: (Push, StretchProbe),
    Domain.ROTATIONAL: (Twist, Turn),
}


def probed(network: Network, sites: Sequence[Site]) -> Network:
    """Return the network with probes at its sites."""
    edits: list[Edit] = []
    for number, site in enumerate(sites):
        if "series" in site.places:
            edits.append(Insert(site.moving, f"stretch_{number}", PROBES[site.domain][1](u=0.0)))
    for number, site in enumerate(sites):
        far = GROUND if site.places <= {"series", "node"} else site.fixed
        edits += between(f"push_{number}", PROBES[site.domain][0](u=0.0), far, site.moving)
    return edited(network, edits)


def motion_at(run: Result, number: int, site: Site) -> Motion:
    """Return how a site moved in a run of the probed network."""
    names, push = site.mechanics, f"push_{number}"
    bearing = f"stretch_{number}" if "series" in site.places else site.moving
    s, v, f = f"{push}.{names.across}_rel", f"{push}.{names.speed}_rel", f"{bearing}.{names.through}"
    return Motion(run.time, run[s], run[v], run[f], run[f"{push}.a_rel"])


def scaled(site: Site, motions: Sequence[Motion], resting: int | None = 0, led: bool = False) -> Site:
    """Return a site with the scales of how it moves; of the motions `resting` begins at rest, if one does.

    Where all motion is `led`, by inputs that prescribe it, its mean is no place of rest.
    """
    lasting = sum(float(m.t[-1] - m.t[0]) for m in motions)
    speed = float(np.sqrt(sum(m.squared for m in motions) / lasting))
    force = float(np.abs(np.concatenate([m.f for m in motions])).max())
    travel = max(m.travel for m in motions)
    ends = min(float(m.s.min()) for m in motions), max(float(m.s.max()) for m in motions)
    usual = sum(m.distance * float(m.t[-1] - m.t[0]) for m in motions) / lasting
    there = site.unstretched if led and site.unstretched is not None else usual
    rest, middle = there if resting is None else float(motions[resting].s[0]), sum(ends) / 2
    passes = max(float(np.abs(np.diff(m.s)).sum() / np.ptp(m.s)) if m.travel else inf for m in motions)
    return replace(site, rest=rest, middle=middle, speed=speed, force=force, travel=travel, passes=passes)
