"""Absorbers: closed forms of the literature, and the true optima they approximate."""

from collections.abc import Mapping
from math import sqrt

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import Tuning
from inertance.machines import TMD, TMDI


def with_tid(mu: float, tuning: Tuning) -> ia.Network:
    tid = ia.machines.tid(tuning.stiffness(mu, 1.0), tuning.damping(mu, 1.0), mu)
    return ia.machines.shear_frame([1.0], [1.0], absorbers={(0, 1): tid})


def to_force(dae: ia.DAE, *, parameters: Mapping[str, float] | None = None) -> float:
    return ia.analysis.linearise(dae, ["wind.f"], ["floor1.s"], parameters=parameters).hinf()


def to_ground(dae: ia.DAE, *, parameters: Mapping[str, float] | None = None) -> float:
    return ia.analysis.linearise(dae, ["ground.s_ref"], ["storey1.s_rel"], parameters=parameters).hinf()


@pytest.mark.parametrize(
    ("mu", "fixed", "peak", "f", "zeta", "best"),
    [(0.05, 6.40312, 6.40844, 0.95237, 0.13394, 6.40792), (0.1, 4.58258, 4.59022, 0.90906, 0.18547, 4.58917)],
)
def test_grounded_tid_is_a_tuned_mass(
    mu: float, fixed: float, peak: float, f: float, zeta: float, best: float
) -> None:
    rule = ia.analysis.den_hartog(mu)
    frame = with_tid(mu, rule)
    assert to_force(frame.dae()) == pytest.approx(peak, abs=1e-5)
    mass = TMD(m=mu, k=rule.stiffness(mu, 1.0), d=rule.damping(mu, 1.0))
    other = ia.machines.shear_frame([1.0], [1.0], absorbers={(0, 1): mass})
    assert to_force(other.dae()) == pytest.approx(peak, abs=1e-5)
    crossing = [
        abs(ia.analysis.linearise(with_tid(mu, Tuning(rule.f, z)), ["wind.f"], ["floor1.s"])(1j * w).item())
        for z in (0.05, 0.3)
        for w in np.sqrt((1 + np.array([-1, 1]) * sqrt(mu / (2 + mu))) / (1 + mu))
    ]
    assert crossing == pytest.approx([fixed] * 4, abs=1e-4)
    bounds = {"absorber1.link.k": (0.5 * mu, mu), "absorber1.link.d": (0.01 * mu, mu)}
    tuned = ia.analysis.tune(frame, to_force, bounds, start=_link(mu, rule), starts=1)
    assert tuned.value == pytest.approx(best, abs=1e-5)
    w = sqrt(tuned.parameters["absorber1.link.k"] / mu)
    assert w == pytest.approx(f, abs=1e-5)
    assert tuned.parameters["absorber1.link.d"] / (2 * mu * w) == pytest.approx(zeta, abs=2e-5)


def _link(mu: float, rule: Tuning) -> dict[str, float]:
    return {"absorber1.link.k": rule.stiffness(mu, 1.0), "absorber1.link.d": rule.damping(mu, 1.0)}


@pytest.mark.parametrize(
    ("mu", "beta", "f", "zeta", "sigma"),
    [(0.01, 0.1, 0.920512, 0.159460, 1.738367), (0.05, 0.2, 0.825775, 0.230072, 1.447278)],
)
def test_tmdi_on_white_base(mu: float, beta: float, f: float, zeta: float, sigma: float) -> None:
    rule = ia.analysis.tmdi_white_base(beta, mu)
    assert (rule.f, rule.zeta) == pytest.approx((f, zeta), abs=1e-6)

    def spread(k: float, d: float) -> float:
        frame = ia.machines.shear_frame([1.0], [1.0], absorbers={(0, 1): TMDI(m=mu, k=k, d=d, b=beta)})
        return ia.analysis.linearise(frame, ["der(der(ground.s_ref))"], ["storey1.s_rel"]).h2()

    k, d = rule.stiffness(mu + beta, 1.0), rule.damping(mu + beta, 1.0)
    assert spread(k, d) == pytest.approx(sigma, abs=1e-6)
    assert min(spread(k * 1.02, d), spread(k * 0.98, d), spread(k, d * 1.05), spread(k, d * 0.95)) > sigma


def test_tvmd_by_fixed_points() -> None:
    mu = 0.1
    rule = ia.analysis.tvmd_fixed_points(mu)
    assert (rule.f, rule.zeta) == pytest.approx((1.12702, 0.20558), abs=1e-5)
    tvmd = ia.machines.tvmd(rule.stiffness(mu, 1.0), rule.damping(mu, 1.0), mu)
    frame = ia.machines.shear_frame([1.0], [1.0], absorbers={(0, 1): tvmd})
    assert to_ground(frame.dae()) == pytest.approx(4.1008, abs=5e-5)
    bounds = {"absorber1.spring.k": (0.05, 0.3), "absorber1.pair.damper.d": (0.01, 0.2)}
    assert ia.analysis.tune(frame, to_ground, bounds).value == pytest.approx(4.0985, abs=5e-5)


def test_first_modes_of_a_taut_cable() -> None:
    cable = ia.machines.taut_cable(L=100.0, T=1e6, m=50.0, parts=60)
    frequencies = [mode.frequency for mode in ia.analysis.linearise(cable).modes()[:3]]
    exact = [n / 200.0 * sqrt(1e6 / 50.0) for n in (1, 2, 3)]
    assert frequencies == pytest.approx(exact, rel=2e-3)


def test_uniform_shear_frame_has_the_frequencies_of_the_textbook() -> None:
    n, w0 = 5, 30.0
    frame = ia.machines.shear_frame([1e3] * n, [1e3 * w0**2] * n)
    found = [2 * np.pi * mode.frequency for mode in ia.analysis.linearise(frame).modes()]
    exact = [2 * w0 * np.sin((2 * k - 1) * np.pi / (2 * (2 * n + 1))) for k in range(1, n + 1)]
    assert found == pytest.approx(exact, rel=1e-9)
