"""Parameters of which each record has an unknown value of its own, against equations of motion in SciPy."""

from collections.abc import Mapping
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Record
from scipy.integrate import solve_ivp

M1, M2, K1, K2, D1, D2 = 2.0, 0.7, 900.0, 400.0, 6.0, 2.0
NOISE = {"x": 2e-5, "y": 3e-5}
CHANNELS = {
    "F": {"input": "push.f", "unit": "N"},
    "x": {"output": "slide.s", "unit": "mm"},
    "y": {"output": "tip.s", "unit": "m"},
}
SHARED = {"near.k": {"rel": 0.2}, "far.k": {"rel": 0.2}}
OWN: dict[str, Any] = {
    "near.s_rel0": {"min": -0.05, "max": 0.05, "per": "record"},
    "far.s_rel0": {"rel": 0.3, "per": "record"},
}


def model() -> ia.Network:
    net = ia.Network("rig", wall=ia.Fixed(), near=ia.SpringDamper(k=1000.0, d=D1), slide=ia.Mass(m=M1))
    net.add(far=ia.SpringDamper(k=430.0, d=D2, s_rel0=0.1), tip=ia.Mass(m=M2), push=ia.Force())
    net.connect(net.wall.flange, net.near.flange_a)
    net.connect(net.near.flange_b, net.slide.flange, net.push.flange, net.far.flange_a)
    return net.connect(net.far.flange_b, net.tip.flange)


def measured(
    seed: int, near: float, far: float, k2: float = K2, settled: bool = False, begin: float = 1.5
) -> Record:
    """Return a record with these rest lengths, cut from a motion or begun where forces balance."""
    rng = np.random.default_rng(seed)
    lines, phases = rng.uniform(0.5, 6.0, 8), rng.uniform(0, 2 * np.pi, 8)

    def force(t: Any) -> Any:
        fade = np.clip(np.asarray(t) / 0.5, 0, 1) ** 3
        return 4.0 * fade * np.sin(2 * np.pi * np.multiply.outer(t, lines) + phases).sum(axis=-1)

    def rates(t: float, state: Any) -> list[float]:
        x, y, v, w = state
        inner = k2 * (y - x - far) + D2 * (w - v)
        return [v, w, (-K1 * (x - near) - D1 * v + inner + float(force(t))) / M1, -inner / M2]

    t = np.arange(0.0 if settled else begin, 5.0, 0.01)
    state = [near, near + far, 0.0, 0.0] if settled else [near + 0.01, near + far, 0.3, -0.2]
    found = solve_ivp(rates, (0.0, 5.0), state, t_eval=t, rtol=1e-10, atol=1e-13, max_step=0.02).y
    noisy = {name: found[n] + rng.normal(0, NOISE[name], len(t)) for n, name in enumerate(NOISE)}
    return Record(f"run {seed}", t, {"F": force(t), **noisy})


def campaign(
    parameters: Mapping[str, Any], *train: Mapping[str, Any], test: Any = (), **more: Any
) -> Campaign:
    noise = {"x": 1e3 * NOISE["x"], "y": NOISE["y"]}  # in the channels' units
    return Campaign(model(), CHANNELS, parameters, train, test, noise=noise, **more)


LENGTHS = [(0.012, 0.11), (-0.007, 0.085), (0.003, 0.12)]


@pytest.fixture(scope="module")
def found() -> Any:
    *train, test = [{"record": measured(n, *lengths)} for n, lengths in enumerate(LENGTHS)]
    return ia.fit(campaign({**SHARED, **OWN}, *train, test=[test]))


def test_each_record_gets_its_own_rest_lengths(found: Any) -> None:
    assert sorted(found.values) == ["far.k", "near.k"]
    for name, true in {"near.k": K1, "far.k": K2}.items():
        assert abs(found.values[name] - true) < 4 * found.errors[name]
        assert found.errors[name] < 1e-3 * true
    for comparison, lengths in zip(found.comparisons, LENGTHS, strict=True):
        for name, true in zip(("near.s_rel0", "far.s_rel0"), lengths, strict=True):
            assert abs(comparison.own[name] - true) < 4 * comparison.own_errors[name]
            assert comparison.own_errors[name] < 2e-5
        for channel, sigma in NOISE.items():
            assert comparison.rms(channel, comparison.after) < 1.1 * sigma
