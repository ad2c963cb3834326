"""Papers on absorbers: exact optima in closed form, claims of abstracts, each from networks and norms."""

from collections.abc import Callable, Mapping, Sequence
from math import sqrt
from typing import Any

import inertance as ia
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertance.analysis import linearise, tune
from inertance.machines import TMD

Norm = Callable[..., Any]


def structure(mu: float, f: float = 1.0, zeta: float = 0.1) -> ia.Network:
    """A mass of 1 kg at 1 rad/s without damping, and a tuned mass mu on it."""
    absorber = TMD(m=mu, k=mu * f**2, d=2 * zeta * mu * f)
    return ia.machines.shear_frame([1.0], [1.0], absorbers={(0, 1): absorber})


def peak(dae: ia.DAE, *, parameters: Mapping[str, float] | None = None) -> Any:
    return linearise(dae, ["wind.f"], ["floor1.s"], parameters=parameters).hinf()


def spread(dae: ia.DAE, *, parameters: Mapping[str, float] | None = None) -> Any:
    return linearise(dae, ["wind.f"], ["floor1.s"], parameters=parameters).h2()


def spread_on_ground(dae: ia.DAE, *, parameters: Mapping[str, float] | None = None) -> Any:
    system = linearise(dae, ["der(der(ground.s_ref))"], ["storey1.s_rel"], parameters=parameters)
    return system.h2()


def tuned(mu: float, measure: Norm, f: float, zeta: float) -> tuple[float, float, float]:
    """The optimum that is found: f, zeta and the norm, from a start that is 5 % off."""
    start = {"absorber1.k": mu * (1.05 * f) ** 2, "absorber1.d": 1.9 * zeta * mu * f}
    bounds = {"absorber1.k": (0.3 * mu, 2 * mu), "absorber1.d": (0.01 * mu, 2 * mu)}
    best = tune(structure(mu), measure, bounds, start=start, starts=1)
    found = sqrt(best.parameters["absorber1.k"] / mu)
    return found, best.parameters["absorber1.d"] / (2 * mu * found), best.value


@pytest.mark.parametrize("mu", [0.01, 0.05, 0.1, 0.3])
def test_exact_least_peak_of_nishihara_and_asami(mu: float) -> None:
    """O. Nishihara, T. Asami, ASME J. Vib. Acoust. 124 (2002): f, zeta and height of the least peak."""
    root = sqrt(4 + 3 * mu)
    above, below = 2 * (16 + 23 * mu + 9 * mu**2 + 2 * (2 + mu) * root), 3 * (64 + 80 * mu + 27 * mu**2)
    f = 2 / (1 + mu) * sqrt(above / below)
    zeta = sqrt((8 + 9 * mu - 4 * root) / (1 + mu)) / 4
    height = sqrt(((8 + 9 * mu) ** 2 * (16 + 9 * mu) - 128 * root**3) / (3 * (32 + 27 * mu))) / (3 * mu)
    found = tuned(mu, peak, f, zeta)
    assert found[2] == pytest.approx(height, rel=1e-7)
    assert found[0] == pytest.approx(f, rel=1e-5)
    assert found[1] == pytest.approx(zeta, rel=1e-4)
    assert peak(structure(mu, f, zeta).dae()) == pytest.approx(height, rel=1e-9)


@pytest.mark.parametrize("mu", [0.01, 0.05, 0.2])
def test_least_spread_of_warburton(mu: float) -> None:
    """G. B. Warburton, Earthquake Eng. Struct. Dyn. 10 (1982): white noise as a force, and of the ground."""
    f = sqrt(1 + mu / 2) / (1 + mu)
    zeta = sqrt(mu * (1 + 3 * mu / 4) / (4 * (1 + mu) * (1 + mu / 2)))
    by_force = tuned(mu, spread, f, zeta)
    assert by_force[:2] == pytest.approx((f, zeta), rel=1e-5)
    f = sqrt(1 - mu / 2) / (1 + mu)
    zeta = sqrt(mu * (1 - mu / 4) / (4 * (1 + mu) * (1 - mu / 2)))
    by_ground = tuned(mu, spread_on_ground, f, zeta)
    assert by_ground[:2] == pytest.approx((f, zeta), rel=1e-5)


@pytest.mark.parametrize(("mu", "more"), [(0.01, 0.0006), (0.02, 0.0012), (0.03, 0.0018), (0.05, 0.0030)])
def test_harmonic_tuning_costs_a_random_load_little(mu: float, more: float) -> None:
    """S. Krenk, J. Hogsberg, Prob. Eng. Mech. 23 (2008) 408-415, abstract: "within a margin of 0.001".

    Of the spread itself that holds up to some 1.6 % of mass; of the equivalent damping ratio, 1/(4 spread^2),
    for all. What is found is checked by the Lyapunov equation of matrices by hand.
    """
    from scipy.linalg import solve_continuous_lyapunov

    f = 1 / (1 + mu)
    damped = tune(structure(mu, f), spread, {"absorber1.d": (0.01 * mu, mu)}, starts=1)
    best = tuned(mu, spread, sqrt(1 + mu / 2) / (1 + mu), sqrt(mu) / 2)[2]
    assert damped.value / best - 1 == pytest.approx(more, abs=6e-5)
    assert 1 / (4 * best**2) - 1 / (4 * damped.value**2) < 1e-3
    k, d = mu * f**2, damped.parameters["absorber1.d"]
    K, D = (np.array([[own + link, -link], [-link, link]]) for own, link in ((1.0, k), (0.0, d)))
    inverse = np.diag([1.0, 1 / mu])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ K, -inverse @ D]])
    push = np.array([[0.0], [0.0], [1.0], [0.0]])
    variance = solve_continuous_lyapunov(A, -push @ push.T)[0, 0]
    assert damped.value == pytest.approx(sqrt(variance), rel=1e-9)


@pytest.mark.parametrize("mu", [0.02, 0.1])
def test_harmonic_tuning_damps_both_modes_alike(mu: float) -> None:
    """The same authors, EURODYN 2008, abstract: classic tuning leads to equal damping; and how far."""
    limit = sqrt(mu / (1 + mu))
    for share in (0.3, 0.7, 0.99):
        modes = linearise(structure(mu, 1 / (1 + mu), share * limit)).modes()
        assert modes[0].damping == pytest.approx(modes[1].damping, rel=1e-9)
    beyond = linearise(structure(mu, 1 / (1 + mu), 1.05 * limit)).modes()
    assert abs(beyond[0].damping - beyond[1].damping) > 0.02


def with_inerter(mu: float, b: float) -> ia.Network:
    """A tuned mass with an inerter beside its spring, between it and the structure."""
    net: Any = ia.Network(
        "inerter on board", ground=ia.Fixed(), column=ia.Spring(k=1.0), floor=ia.Mass(m=1.0),
        wind=ia.Force(f=0.0),
        link=ia.SpringDamper(k=mu, d=0.2 * mu), inerter=ia.Inerter(b=b), mass=ia.Mass(m=mu),
    )  # fmt: skip
    net.connect(net.ground.flange, net.column.flange_a)
    net.connect(
        net.column.flange_b, net.floor.flange, net.wind.flange, net.link.flange_a, net.inerter.flange_a
    )
    built: ia.Network = net.connect(net.link.flange_b, net.inerter.flange_b, net.mass.flange)
    return built


def test_an_inerter_between_structure_and_tuned_mass_is_no_improvement() -> None:
    """X. Wang et al., IEEE Access (2018), abstract, and F. Weber, Buildings 15 (2025) 1829, abstract."""

    def height(dae: ia.DAE, *, parameters: Mapping[str, float] | None = None) -> Any:
        return linearise(dae, ["wind.f"], ["floor.s"], parameters=parameters).hinf()

    mu = 0.05
    bounds = {"link.k": (0.3 * mu, 4 * mu), "link.d": (0.01 * mu, 2 * mu)}
    peaks = [tune(with_inerter(mu, b), height, bounds, starts=2).value for b in (1e-9, 0.01, 0.03, 0.06)]
    assert peaks[0] == pytest.approx(6.40792, abs=1e-4)
    assert (np.diff(peaks) > 0).all()


@settings(max_examples=15, deadline=None)
@given(
    m=st.tuples(*3 * [st.floats(0.2, 5.0)]), k=st.tuples(*3 * [st.floats(1.0, 50.0)]),
    b=st.tuples(*3 * [st.floats(0.05, 3.0)]), which=st.integers(0, 2), more=st.floats(0.05, 5.0),
)  # fmt: skip
def test_an_inerter_lowers_natural_frequencies(
    m: tuple[float, ...], k: tuple[float, ...], b: tuple[float, ...], which: int, more: float
) -> None:
    """M. Z. Q. Chen et al., J. Sound Vib. 333 (2014) 1874-1887, abstract: inertance lowers them all."""

    def frequencies(inertances: Sequence[float]) -> Any:
        storeys = {(n, n + 1): ia.Inerter(b=value) for n, value in enumerate(inertances)}
        frame = ia.machines.shear_frame(m, k, absorbers=storeys)
        return np.array([mode.frequency for mode in linearise(frame).modes()])

    raised = [value + more * (n == which) for n, value in enumerate(b)]
    before, after = frequencies(b), frequencies(raised)
    assert (after <= before * (1 + 1e-9)).all()
    assert after.sum() < before.sum()
    single = ia.machines.shear_frame(m[:1], k[:1], absorbers={(0, 1): ia.Inerter(b=b[0])})
    assert linearise(single).modes()[0].frequency == pytest.approx(
        sqrt(k[0] / (m[0] + b[0])) / (2 * np.pi), rel=1e-9
    )
