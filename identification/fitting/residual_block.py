"""`ResidualBlock`: one record in a fit: its nuisances, its weighted residual and the slopes of that."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...base import Array
from ..records.filters import Filter
from .campaign_model import Accuracy, Prediction, RecordModel, Values

CONTINUITY_SHARE = 1e-3  # of how far states move, by which pieces may miss each other


@dataclass(frozen=True, eq=False)
class Linearised:
    """A weighted residual (measured less predicted, over noise) and its slopes, and what it came from.

    `residual` counts per sample; `to_p` and `to_n` are its slopes in parameters and nuisances.
    """

    residual: Array
    to_p: Array
    to_n: Array
    predictions: list[Prediction]


class ResidualBlock:
    """A record, the channels of it that count, the filter both sides pass and the noise they are weighted by.

    Nuisances are the states at the start of every piece (one piece unless multiple shooting is asked for),
    the unknown values that the record has of its own and the offsets of channels, each as its distance from a
    first guess in units of what it may be expected to be.
    """

    def __init__(
        self, stand: RecordModel, channels: Sequence[str], sigma: Values, filtered: Filter | None
    ) -> None:
        self.stand, self.channels, self.filter = stand, list(channels), filtered
        self.sigma = {name: sigma[name] for name in channels}
        self.record = stand.record
        offsets = [name for name in stand.experiment.offset if name in channels]
        self.offsets = {name: n - len(offsets) for n, name in enumerate(offsets)}  # places among nuisances
        self.unknown = stand.experiment.unknown
        self.free = stand.experiment.initial == "fit"
        self.pieces = _pieces(len(self.record.time), self.record.rate, stand.experiment.shooting)
        self.center = np.zeros((len(self.pieces), 0))
        self.width = np.zeros(0)
        self.share = filtered.share(self.record.rate) if filtered else 1.0

    @property
    def samples(self) -> float:
        """Number of independent samples: what passes the filter, of all channels."""
        return self.share * len(self.channels) * len(self.record.time)

    @property
    def rows(self) -> int:
        """Number of residuals: samples of all channels, then by how much states miss each other at joints."""
        return len(self.channels) * len(self.record.time) + (len(self.pieces) - 1) * self.center.shape[1]

    @property
    def nuisances(self) -> int:
        return self.center.size + len(self.unknown) + len(self.offsets)

    @property
    def own(self) -> slice:
        """Where among the nuisances the values are that the record has of its own."""
        return slice(self.center.size, self.center.size + len(self.unknown))

    @property
    def weight(self) -> Array:
        """What a nuisance counts as a residual, if it is 1: as much as the noise, or by its prior."""
        weight = np.ones(self.nuisances)
        weight[self.own] = [prior.scale / prior.sd for prior in self.unknown.values()]
        return weight

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Least and largest nuisances."""
        low, high = np.full(self.nuisances, -np.inf), np.full(self.nuisances, np.inf)
        low[self.own], high[self.own] = np.reshape([p.range for p in self.unknown.values()], (-1, 2)).T
        return low, high

    def own_values(self, nuisances: Array) -> dict[str, float]:
        """Return the values of parameters that the record has of its own."""
        moved = zip(self.unknown.items(), nuisances[self.own].tolist(), strict=True)
        return {name: prior.at(share) for (name, prior), share in moved}

    def prepare(self, parameters: Values, accuracy: Accuracy) -> None:
        """Find where the pieces start, as a first guess, and how far states move."""
        if not self.free:
            return
        begins = [float(self.record.time[first]) for first, _ in self.pieces]
        self.center = np.array([self.stand.rest(parameters, begin) for begin in begins])
        runs = [
            self.stand.run(parameters, start, accuracy, span).run
            for start, span in zip(self.center, self.pieces, strict=True)
        ]
        moved = [max(np.ptp(run[name]) for run in runs) for name in self.stand.dae.state_names]
        self.width = np.array([most if most > 0 else 1.0 for most in moved])

    def linearise(
        self, parameters: Values, nuisances: Array, accuracy: Accuracy, slopes: bool = True
    ) -> Linearised:
        moved = nuisances[: self.center.size].reshape(self.center.shape)
        starts = self.center + moved * self.width
        values = {**parameters, **self.own_values(nuisances)}
        predictions = [
            self.stand.run(values, start if self.free else None, accuracy, span)
            for start, span in zip(starts, self.pieces, strict=True)
        ]
        parts = [self._channel(name, predictions, nuisances, slopes) for name in self.channels]
        parts += self._joints(predictions, starts, slopes)
        residual, to_p, to_n = map(np.concatenate, zip(*parts, strict=True))
        return Linearised(residual, to_p, to_n, predictions)

    def residual(self, name: str, predictions: Sequence[Prediction], nuisances: Array) -> Array:
        """Return measured less predicted of a channel, not filtered, in SI units."""
        measured = self.record.values[name]
        rest: Array = measured - _joined([p.values[name] for p in predictions])
        return rest - nuisances[self.offsets[name]] * self._range(name) if name in self.offsets else rest

    @property
    def _own_scales(self) -> Array:
        return np.array([prior.scale for prior in self.unknown.values()])

    def _range(self, name: str) -> float:
        """Return how far a channel moves, 1 if it rests."""
        return float(np.ptp(self.record.values[name])) or 1.0

    def _channel(
        self, name: str, predictions: list[Prediction], nuisances: Array, slopes: bool
    ) -> tuple[Array, Array, Array]:
        from scipy.linalg import block_diag

        residual = self.residual(name, predictions, nuisances)[:, None]
        to_p, to_n = np.zeros((len(residual), 0)), np.zeros((len(residual), self.nuisances))
        if slopes:
            to_p = -_joined([p.slopes[name] for p in predictions])
            if self.free:
                own = (p.start_slopes[name][n > 0 :] * self.width for n, p in enumerate(predictions))
                to_n[:, : self.center.size] = -block_diag(*own)
            to_n[:, self.own] = -_joined([p.own_slopes[name] for p in predictions]) * self._own_scales
            if name in self.offsets:
                to_n[:, self.offsets[name]] = -self._range(name)
        both = np.hstack([residual, to_p, to_n])
        if self.filter is not None:
            both = self.filter.apply(both, self.record.rate)
        both = both / self.sigma[name]
        split = 1 + to_p.shape[1]
        return both[:, 0], both[:, 1:split], both[:, split:]

    def _joints(
        self, predictions: list[Prediction], starts: Array, slopes: bool
    ) -> Iterator[tuple[Array, Array, Array]]:
        """Yield by how much pieces miss each other, in thousandths of how far the states move."""
        nx, shared = self.center.shape[1], self.stand.shared
        for n in range(len(predictions) - 1):
            weight = 1 / (CONTINUITY_SHARE * self.width)
            missed = weight * (predictions[n].end - starts[n + 1])
            to_p, to_n = np.zeros((nx, 0)), np.zeros((nx, self.nuisances))
            if slopes:
                end = predictions[n].end_slopes
                to_p = weight[:, None] * end[:, :shared]
                to_n[:, self.own] = weight[:, None] * end[:, shared : end.shape[1] - nx] * self._own_scales
                to_n[:, n * nx : (n + 1) * nx] = weight[:, None] * end[:, end.shape[1] - nx :] * self.width
                to_n[:, (n + 1) * nx : (n + 2) * nx] = -np.diag(weight * self.width)
            yield missed, to_p, to_n


def _joined(pieces: Sequence[Array]) -> Array:
    """Return what pieces hold one after the other; the sample that neighbours share is the earlier one's."""
    return np.concatenate([piece[n > 0 :] for n, piece in enumerate(pieces)])


def _pieces(samples: int, rate: float, length: float | None) -> list[tuple[int, int]]:
    """Return first and last sample of each piece; neighbours share one."""
    count = 1 if length is None else max(1, round((samples - 1) / rate / length))
    edges = np.linspace(0, samples - 1, count + 1).round().astype(int)
    return [(int(a), int(b)) for a, b in pairwise(edges)]
