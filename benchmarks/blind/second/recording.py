"""How signals become files: filters, converters, noise, zeros of their own, clocks, gaps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from acquisition import FACTOR, SAMPLING, TAPS, filtered
from assembly import Rig
from scipy.signal import butter, sosfilt, sosfiltfilt
from second.excitations import PREROLL
from second.rigs import FILED
from stepper import Array

Rng = np.random.Generator
HEADROOM = 1.3
FINE_BITS, COARSE_BITS = 16, (10, 12)
GAP = 0.3  # s


@dataclass(frozen=True)
class Logger:
    """How a case's records are taken.

    Attributes:
        duration: of each [s].
        rate: at which they are stored [Hz].
        begin: "rest" or "motion".
        filtered: "none", "zero-phase", "causal" (both alike on all channels) or "apart" (zero-phase, each
            channel its own).
        cutoffs: of the filters [Hz], by channel.
        bits: of the converter.
        gap: "none", "window" (the campaign leaves it out) or "cut" (the file is cut in two there).
        offset: outputs whose zero is unknown and another in each record.
        clock: whether time begins anywhere rather than at 0.
        filed: whether files are in everyday units.
    """

    duration: float
    rate: int
    begin: str
    filtered: str
    cutoffs: tuple[float, ...]
    bits: int
    gap: str
    offset: tuple[str, ...]
    clock: bool
    filed: bool

    @property
    def rested(self) -> bool:
        """Whether records begin at rest."""
        return self.begin == "rest"

    @property
    def grain(self) -> float:
        """Noise of quantisation over the root mean square of a signal whose peaks are four times that."""
        return float(4 * HEADROOM * 2 / 2**self.bits / np.sqrt(12))


def drawn(rig: Rig, rng: Rng, longest: float) -> Logger:
    """Draw how the records of a case are taken."""
    rate = int(rng.choice([1000, 1000, 500, 250]))
    filtered = str(rng.choice(["none", "none", "zero-phase", "causal", "apart"]))
    top = 0.4 * rate
    low = min(6 * rig.band[1], 0.9 * top)
    cutoffs = rng.uniform(low, top, len(rig.channels)) if filtered == "apart" else [rng.uniform(low, top)]
    offset = rng.uniform() < 0.4
    return Logger(
        duration=min(float(rng.choice([8.0, 12.0, 20.0])), longest),
        rate=rate,
        begin=str(rng.choice(["rest", "motion", "motion", "motion", "motion"])),
        filtered=filtered,
        cutoffs=tuple(np.resize(cutoffs, len(rig.channels)).tolist()),
        bits=int(rng.integers(*COARSE_BITS, endpoint=True)) if rng.uniform() < 0.4 else FINE_BITS,
        gap=str(rng.choice(["none", "none", "none", "window", "cut"])),
        offset=tuple(rng.permutation(rig.outputs)[: 1 + len(rig.outputs) // 2].tolist()) if offset else (),
        clock=bool(rng.uniform() < 0.5),
        filed=bool(rng.uniform() < 0.5),
    )


@dataclass(frozen=True)
class Taken:
    """A record: time, measured columns (SI, input first), what the true law makes of the input as measured.

    That is the true signals behind the filter of the input, as filters and what is nearly linear commute.
    """

    time: Array
    values: Array
    clean: Array
    zeros: Array


def left(records: Sequence[Taken]) -> Array:
    """Return what the true law leaves of each output of some records, over the size of what was measured."""
    errors = np.concatenate([record.values - record.zeros - record.clean for record in records])
    seen = np.concatenate([record.values for record in records])
    return np.asarray(np.sqrt(np.mean(errors**2, axis=0) / np.mean(seen**2, axis=0))[1:])


def taken(fine: Array, logger: Logger, rig: Rig, noise: Array, reach: Array, rng: Rng) -> Taken:
    """Return the record of signals at the stepping rate.

    Args:
        fine: signals from PREROLL before the record to SPARE after it, input first.
        logger, rig: what takes it, and of what.
        noise: root mean square of each channel's noise.
        reach: greatest value of each channel in any record.
        rng: draws noise, zeros and clock.
    """
    logged = np.column_stack([filtered(x, TAPS, len(x) // FACTOR) for x in fine.T])
    noisy = logged + _passed(_noise(logged.shape, logger, noise, rng), logger)
    seen = noisy - logged + _passed(logged, logger)
    first, count = round(PREROLL * SAMPLING), round(logger.duration * SAMPLING) + 1
    kept = slice(first, first + count, SAMPLING // logger.rate)
    zeros = np.array([name in logger.offset for name in rig.channels]) * rng.uniform(-0.3, 0.3) * reach
    step = 2 * HEADROOM * reach / 2**logger.bits
    if rig.resolution:
        step[0] = rig.resolution
    values = step * np.round((seen[kept] + zeros) / step)
    begin = round(rng.uniform(0, 500), 3) if logger.clock else 0.0
    clean = _passed(logged, replace(logger, cutoffs=logger.cutoffs[:1] * len(logger.cutoffs)))
    return Taken(begin + np.arange(len(values)) / logger.rate, values, clean[kept], zeros)


def write(folder: Path, name: str, record: Taken, logger: Logger, rig: Rig, rng: Rng) -> list[str]:
    """Write a record as one file or two, and return the lines of the campaign that name them."""
    columns = {"time": record.time}
    for (channel, (_, unit)), column in zip(rig.channels.items(), record.values.T, strict=True):
        columns[channel] = column / FILED[unit][1] if logger.filed and unit in FILED else column
    at = round(len(record.time) * rng.choice([0.3, 0.7]))
    lost = slice(at, at + round(GAP * logger.rate))
    parts = [slice(0, lost.start), slice(lost.stop, None)]
    if logger.gap == "cut":
        names = [f"{name}{letter}" for letter in "ab"]
        for piece, part in zip(names, parts, strict=True):
            np.savez_compressed(folder / f"{piece}.npz", **{key: x[part] for key, x in columns.items()})
        return [_entry(piece, logger, begins=piece == names[0]) for piece in names]
    if logger.gap == "none":
        np.savez_compressed(folder / f"{name}.npz", **columns)
        return [_entry(name, logger, begins=True)]
    np.savez_compressed(folder / f"{name}.npz", **{key: np.delete(x, lost) for key, x in columns.items()})
    longer = max(parts, key=lambda part: len(record.time[part]))
    first, last = record.time[longer][[0, -1]]
    return [_entry(name, logger, begins=longer is parts[0], window=f"[{first:.6g}, {last:.6g}]")]


def _entry(name: str, logger: Logger, begins: bool, window: str = "") -> str:
    """Return the lines of a file; `begins` tells whether it holds the beginning of the record."""
    lines = [f"[[{name.split('_')[0]}]]", f'file = "{name}.npz"']
    lines += [f"window = {window}"] * bool(window)
    lines += ['initial = "rest"'] * (logger.rested and begins)
    offset = ", ".join(f'"{channel}"' for channel in logger.offset)
    return "\n".join([*lines, *[f"offset = [{offset}]"] * bool(offset)])


def _noise(shape: tuple[int, ...], logger: Logger, noise: Array, rng: Rng) -> Array:
    """Return white noise that has the wanted size once it has passed the filters."""
    white = rng.normal(size=shape)
    return white * noise / np.std(_passed(white, logger), axis=0)


def _passed(signals: Array, logger: Logger) -> Array:
    if logger.filtered == "none":
        return signals
    columns = []
    for column, cutoff in zip(signals.T, logger.cutoffs, strict=True):
        sections = butter(2, cutoff, fs=SAMPLING, output="sos")
        run = sosfilt if logger.filtered == "causal" else sosfiltfilt
        columns.append(run(sections, column))
    return np.column_stack(columns)
