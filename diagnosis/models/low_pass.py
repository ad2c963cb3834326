"""Low passes through which model and record go before they are compared, where what rings is no evidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import reduce
from math import inf, pi
from typing import Any

import numpy as np

from ...base import Array
from ...components import Component, Stated, der, parameter, variable
from ...identification import Campaign, Channel, Experiment, NoiseFloor
from ...networks import DAE, Network
from ..criteria import LOW_PASS_RATE_SHARE

DAMPING_RATIOS = 0.3826834323650898, 0.9238795325112867  # sin and cos of pi/8: Butterworth's of order 4
NOISE_BAND_RATIO = 1.0261721529770309  # pi/8 over its sine: of the white noise that passes, over the cut-off
RINGING_UNITS = frozenset({"m/s2", "rad/s2", "N", "N.m"})  # of what impacts shake, if it is measured


class LowPass(Component):
    """Half of a Butterworth low pass of order 4: x'' + 2 D w x' + w^2 x = w^2 u, from rest."""

    w = parameter("rad/s", "cut-off", above=0)
    D = parameter("1", "damping ratio", above=0)
    u = variable("", "what comes")
    x = variable("", "what passes")
    rate = variable("", "rate of what passes")

    def equations(self) -> Stated:
        """State how what passes follows what comes."""
        yield der(self.x) == self.rate
        yield der(self.rate) == self.w * (self.w * (self.u - self.x) - 2 * self.D * self.rate)


def behind_low_passes(network: Network, channels: Mapping[str, Channel]) -> tuple[Network, list[str]]:
    """Return a network with the low passes of channels, and the paths at which outputs are compared."""
    outputs = [channel for channel in channels.values() if not channel.driven]
    paths = [c.path if c.cutoff == inf else f"low_pass_{n}_1.x" for n, c in enumerate(outputs)]
    passed = {n: channel for n, channel in enumerate(outputs) if channel.cutoff < inf}
    if not passed:
        return network, paths

    def equations(self: Any) -> Stated:
        for n, channel in passed.items():
            first, second = (getattr(self, f"low_pass_{n}_{half}") for half in (0, 1))
            yield first.u == reduce(getattr, channel.path.split("."), self)
            yield second.u == first.x

    wired = network.clone()
    wired.__class__ = type("Wired", (type(network),), {"equations": equations})
    for n, channel in passed.items():
        for half, ratio in enumerate(DAMPING_RATIOS):
            wired.add(**{f"low_pass_{n}_{half}": LowPass(w=2 * pi * channel.cutoff, D=ratio)})
    return wired, paths


def low_passed(campaign: Campaign) -> Campaign | None:
    """Return a campaign whose outputs that ring are compared behind a low pass; None if there are none.

    Of a record that is compared at fewer instants than it has, what is faster folds into what is compared,
    and a stiff contact rings as no logger's filter leaves it. Behind a low pass, from rest as the record
    begins, model and record agree on what is slower.
    """
    dae = campaign.dae
    ringing = [
        name
        for name in campaign.outputs
        if campaign.measured[name].si in RINGING_UNITS and _is_a_variable(dae, campaign.measured[name].path)
    ]
    if not ringing or any(experiment.every < 2 for experiment in campaign.experiments):
        return None
    cutoff = LOW_PASS_RATE_SHARE * min(experiment.rate for experiment in campaign.experiments)
    slow = campaign.with_each(lambda experiment: _passed(experiment, ringing, cutoff))
    slow.measured = {
        name: replace(channel, cutoff=cutoff) if name in ringing else channel
        for name, channel in campaign.measured.items()
    }
    return slow.with_floors([experiment.floors for experiment in slow.experiments])


def _is_a_variable(dae: DAE, path: str) -> bool:
    """Tell whether a path is of a variable that equations may use."""
    known = path in dae.parameter_values or path in dae.switching.mode_names
    return not known and not path.startswith("der(") and dae.derived.unit(path) is None


def _passed(experiment: Experiment, names: list[str], cutoff: float) -> Experiment:
    """Return a record of which some outputs are behind a low pass."""
    record, floors = experiment.record, dict(experiment.floors)
    values = {name: _through(record.values[name], cutoff, record.rate) for name in names}
    floors |= {name: _noise_behind(floors[name], cutoff, record.rate) for name in names if name in floors}
    return replace(experiment, record=replace(record, values=record.values | values), floors=floors)


def _through(values: Array, cutoff: float, rate: float) -> Array:
    """Return what passes of a signal that is straight between its samples."""
    from scipy.signal import cont2discrete, lfilter

    w = 2 * pi * cutoff
    poles = np.polymul(*([1.0, 2 * ratio * w, w**2] for ratio in DAMPING_RATIOS))
    found: Any = cont2discrete(([w**4], poles), 1 / rate, method="foh")
    numerator, denominator, _ = found
    return np.asarray(lfilter(np.ravel(numerator), denominator, values))


def _noise_behind(floor: NoiseFloor, cutoff: float, rate: float) -> NoiseFloor:
    """Return the noise that passes of what samples at a rate have."""
    whole, left = min(floor.band, 0.5 * rate), min(floor.band, NOISE_BAND_RATIO * cutoff)
    return replace(floor, sigma=floor.sigma * float(np.sqrt(left / whole)), band=left)
