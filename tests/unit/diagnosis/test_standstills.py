"""Prescribed motion that stands still: dry friction may hold any force there, and no model tells which."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.base import Array
from inertance.diagnosis.models.prescribed import standing
from inertance.identification import Campaign, Filter, Record

RATE, NOISE = 250.0, 0.3
TIME = np.arange(0.0, 8.0, 1 / RATE)


def strut() -> ia.Network:
    net = ia.Network("strut", frame=ia.Fixed(), cell=ia.ForceSensor(), drive=ia.Position())
    net.add(spring=ia.Spring(k=2e3), damper=ia.Damper(d=50.0))
    net.connect(net.frame.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.drive.flange)


def stroke(frequency: float, held: tuple[float, float], level: float, friction: float) -> Record:
    """Return a stroke that pauses, with a force while it does that is not that of sliding."""
    paused = np.clip(TIME, None, held[0]) + np.clip(TIME - held[1], 0.0, None)
    s = 0.02 * np.sin(2 * np.pi * frequency * paused)
    v = np.gradient(s, TIME)
    still = (held[0] < TIME) & (held[1] > TIME)
    rubbing = np.where(still, level, friction * np.sign(v))
    noise = NOISE * np.random.default_rng(round(10 * frequency)).standard_normal(len(TIME))
    force = 2.1e3 * s + 45.0 * np.where(still, 0.0, v) + rubbing + noise
    return Record(f"{frequency:g} Hz", TIME, {"s": s, "F": -force})


def filtered(record: Record, cutoff: float | None) -> Record:
    if cutoff is None:
        return record
    passed = Filter(cutoff=cutoff)
    return replace(record, values={name: passed.apply(x, RATE) for name, x in record.values.items()})


def campaign(
    friction: float, noise: float | None = NOISE, cutoff: float | None = None, **entries: Any
) -> Campaign:
    pauses = [(2.25 / 0.7, 5.0, -2.0), (2.75 / 1.3, 2.7, 1.0), (4.25, 7.0, 0.5)]  # from where a stroke turns
    strokes = [
        {"record": filtered(stroke(f, (begin, end), level * (friction > 0), friction), cutoff), **entries}
        for f, (begin, end, level) in zip((0.7, 1.3, 1.0), pauses, strict=True)
    ]
    channels = {"s": {"input": "drive.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}}
    priors = {"spring.k": {"rel": 0.1}, "damper.d": {"rel": 0.3}}
    stated: dict[str, Any] = {} if noise is None else {"noise": {"F": noise}}
    return Campaign(strut(), channels, priors, strokes[:2], strokes[2:], **stated)


@pytest.mark.parametrize("entries", [{}, {"initial": "rest"}, {"offset": ("F",)}])
def test_friction_is_found_though_it_holds_any_force_at_rest(entries: dict[str, Any]) -> None:
    found = ia.diagnose(campaign(3.0, **entries))
    assert [placed.effect.kind for placed in found.effects] == ["coulomb_friction"]
    assert found.effects[0].values["f_c"] == pytest.approx(3.0, rel=0.02)
    assert found.closed > 0.9
    assert any(re.search(r"stands still in 1\.8\d? s of 0.7 Hz, 0.596", note) for note in found.notes)


KNOWN = {
    "stated": (NOISE, None),
    "half": (0.5 * NOISE, None),
    "unknown": (None, None),
    "filtered": (None, 40.0),
}


CASES = [(3.0, known) for known in KNOWN] + [(0.0, "unknown"), (0.0, "filtered")]


@pytest.mark.parametrize(("friction", "case"), CASES)
def test_pauses_count_neither_as_gap_nor_as_quiet(friction: float, case: str) -> None:
    known = KNOWN[case]
    found = ia.diagnose(campaign(friction, *known))
    kinds = [placed.effect.kind for placed in found.effects]
    assert kinds == (["coulomb_friction"] if friction else [])
    assert found.verdict in (("effect",) if friction else ("none", "parameters"))
    over, told = found.gap["F"].over_noise, known[0] or NOISE
    assert over == pytest.approx(found.evidence.after.misfit)
    assert over == pytest.approx(NOISE / told, rel=0.3)


def stretches(*inputs: Array) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(standing(inputs, RATE), prepend=False, append=False))
    return [(int(begin), int(end) - 1) for begin, end in edges.reshape(-1, 2)]


def test_stretches_in_which_no_input_changes_are_told() -> None:
    ramp = np.interp(TIME, [0, 1, 2, 3, 5, 8], [0, 0, 1, 1, 2, 2])
    assert stretches(ramp) == [(0, 250), (500, 750), (1250, 1999)]
    assert stretches(ramp, np.sin(TIME)) == []
    assert stretches() == []
    assert stretches(ramp[:10]) == []


@pytest.mark.parametrize("frequency", [0.1, 1.0, 10.0])
def test_a_sine_never_stands_still(frequency: float) -> None:
    assert stretches(np.sin(2 * np.pi * frequency * TIME)) == []


def test_the_last_digit_of_a_sensor_may_move_at_rest() -> None:
    last = np.random.default_rng(1).integers(0, 2, len(TIME)) / 2**12
    assert len(stretches(np.interp(TIME, [0, 3, 5, 8], [0, 1, 1, 0]) + last)) == 1
