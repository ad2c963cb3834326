"""Synthesis: random positive-real functions become networks that have them, others are refused."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.analysis import StateSpace
from inertance.synthesis import NotPositiveRealError, RationalFunction
from numpy.polynomial import polynomial as upwards
from scipy.optimize import minimize_scalar
from scipy.signal import step

Coefficients = Any
FREQUENCIES = np.geomspace(0.02, 50.0, 60)


def hurwitz(rng: np.random.Generator, degree: int) -> Coefficients:
    """Return a polynomial with roots between 0.1 and 10 rad/s left of the axis."""
    p: Coefficients = np.ones(1)
    while len(p) - 1 < degree:
        w, zeta = 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-1.5, 0.0)
        pair = len(p) < degree and rng.random() < 0.7
        p = np.polymul(p, [1.0, 2 * zeta * w, w**2] if pair else [1.0, w])
    return p


def least_real(num: Coefficients, den: Coefficients) -> float:
    """Return the least real part on the axis by a search over frequencies."""

    def real(log_w: Any) -> Any:
        s = 1j * np.exp(log_w)
        return np.real(np.polyval(num, s) / np.polyval(den, s))

    logs = np.linspace(np.log(1e-3), np.log(1e3), 3000)
    k = int(np.clip(np.argmin(real(logs)), 1, len(logs) - 2))
    near = (logs[k - 1], logs[k + 1])
    inner = minimize_scalar(real, bounds=near, method="bounded", options={"xatol": 1e-12})
    return min(float(inner.fun), float(num[-1] / den[-1]), float(num[0] / den[0]))


def positive_real_function(seed: int) -> tuple[Coefficients, Coefficients]:
    """Return a random positive-real function of degree 1 to 6, some with poles on the axis."""
    rng = np.random.default_rng(seed)
    degree = 1 + seed % 6
    tank = degree > 2 and seed % 4 == 0
    proper = degree - 2 * tank
    den = hurwitz(rng, proper)
    num = rng.normal(size=proper + 1) * den
    least = least_real(num, den)
    num = num + (rng.choice([1e-4, 1e-2, 1.0]) * abs(least) - least) * den
    if tank:
        pair = [1.0, 0.0, rng.uniform(0.1, 10.0)]
        num = np.polyadd(np.polymul(num, pair), np.polymul([rng.uniform(0.1, 3.0), 0.0], den))
        den = np.polymul(den, pair)
    return (den, num) if rng.random() < 0.3 else (num, den)


def linearised(strut: ia.TwoTerminal) -> StateSpace:
    """Return the admittance with all states the network has."""
    net = ia.Network("moved", strut=strut.clone(), wall=ia.Fixed(), probe=ia.Position())
    net.connect(net.strut.flange_a, net.wall.flange).connect(net.strut.flange_b, net.probe.flange)
    return ia.analysis.linearise(net, ["der(probe.s_ref)"], ["strut.f"])


@pytest.mark.parametrize("seed", range(120))
def test_random_positive_real_functions_are_realised(seed: int) -> None:
    num, den = positive_real_function(seed)
    assert ia.synthesis.positive_real((num, den))
    strut = ia.synthesis.synthesise((num, den))
    s = 1j * FREQUENCIES
    wanted = np.polyval(num, s) / np.polyval(den, s)
    assert np.abs(linearised(strut)(s).ravel() / wanted - 1).max() < 1e-8
    if seed % 5 == 0:  # of every kind
        assert_it_moves(strut, num, den)


def assert_it_moves(strut: ia.TwoTerminal, num: Coefficients, den: Coefficients) -> None:
    """Push a mass on it, and compare its speed with that which the function gives."""
    net = ia.Network("pushed", wall=ia.Fixed(), strut=strut, mass=ia.Mass(m=1.0), push=ia.Force(f=1.0))
    net.connect(net.wall.flange, net.strut.flange_a)
    net.connect(net.strut.flange_b, net.mass.flange, net.push.flange)
    run = net.simulate(5.0, step=0.05, rtol=1e-8, atol=1e-10)
    _, speed = step((den, np.polyadd(np.polymul([1.0, 0.0], den), num)), T=run.time)  # 1/(s + Y)
    assert run["mass.v"] == pytest.approx(speed, abs=1e-5 * np.abs(speed).max())


@pytest.mark.parametrize("seed", range(40))
def test_what_is_a_little_less_is_refused_at_its_frequency(seed: int) -> None:
    rng = np.random.default_rng(seed)
    den = hurwitz(rng, 1 + seed % 6)
    num = rng.normal(size=len(den)) * den
    num = num - (1 + 1e-3) * least_real(num, den) * den + (0.0 if seed % 2 else -1e-6) * den
    expected = least_real(num, den)
    found = ia.synthesis.positive_real((num, den))
    s = 2j * np.pi * min(found.frequency, 1e12)
    assert found.least == pytest.approx(expected, rel=1e-6, abs=1e-12)
    assert np.real(np.polyval(num, s) / np.polyval(den, s)) == pytest.approx(expected, rel=1e-6, abs=1e-9)
    assert bool(found) == (expected >= 0)
    if not found:
        with pytest.raises(NotPositiveRealError, match="its real part is -") as caught:
            ia.synthesis.synthesise((num, den))
        assert caught.value.frequency == found.frequency


@pytest.mark.parametrize(
    ("num", "den", "frequency", "reason"),
    [
        ([1.0, 0.0, 0.0], [1.0], np.inf, "grows as s"),
        ([1.0], [1.0, 0.0, 0.0], 0.0, "multiple pole at 0 Hz"),
        ([1.0], [-1.0, 1.0], 0.0, "unstable pole, 1"),
        ([1.0, 4.0], [1.0, -2.0, 5.0], 2 / (2 * np.pi), "unstable pole"),
        ([-1.0, 0.0], [1.0, 0.0, 9.0], 3 / (2 * np.pi), "not simple with a positive residue"),
        ([1.0, 0.0], [1.0, 0.0, 2.0, 0.0, 1.0], 1 / (2 * np.pi), "not simple with a positive residue"),
        ([1.0, 1.0], [1.0, 0.0, 1.0], 1 / (2 * np.pi), "is not real"),
        ([-1.0, 1.0], [1.0], np.inf, "not simple with a positive residue"),
        ([-1.0], [2.0], 0.0, "real part is -0.5"),
        ([1.0, 1.0, 1.0], [1.0, 1.0, 9.0], np.sqrt(6) / (2 * np.pi), "real part is -0.6"),
    ],
)
def test_every_way_not_to_be_positive_real(
    num: Coefficients, den: Coefficients, frequency: float, reason: str
) -> None:
    found = ia.synthesis.positive_real((num, den))
    assert not found
    assert found.frequency == pytest.approx(frequency)
    assert reason in found.reason
    with pytest.raises(NotPositiveRealError, match="not positive-real"):
        ia.synthesis.synthesise((num, den))


def elements(component: ia.Component) -> list[ia.Component]:
    found = [e for part in component._parts.values() for e in elements(part)]
    return found or [component]


def kinds(component: ia.Component) -> dict[str, int]:
    names = [type(e).__name__ for e in elements(component)]
    return {name: names.count(name) for name in sorted(set(names))}


def regular_biquadratic(rng: np.random.Generator) -> tuple[Coefficients, Coefficients]:
    """Return (s^2 + b s + c)/(s^2 + e s + f) times a gain whose real part is least at 0 or infinity."""
    while True:
        num, den = 10 ** rng.uniform(-1, 1, 3), 10 ** rng.uniform(-1, 1, 3)
        for one, other in ((num, den), (den, num)):
            ends = min(one[-1] / other[-1], one[0] / other[0])
            if least_real(one, other) > ends * (1 - 1e-9):
                return num, den


@pytest.mark.parametrize("seed", range(20))
def test_a_regular_biquadratic_takes_five_elements(seed: int) -> None:
    """Jiang & Smith, IEEE Trans. Automat. Contr. 56 (2011) 1275-1290: two reactive ones and three dampers."""
    strut = ia.synthesis.synthesise(regular_biquadratic(np.random.default_rng(seed)))
    found = kinds(strut)
    assert found["Damper"] == 3
    assert sum(found.values()) == 5


def test_lossless_functions_become_foster_forms() -> None:
    num = upwards.polyfromroots([0.0, 2j, -2j, 5j, -5j]).real[::-1]
    den = upwards.polyfromroots([1j, -1j, 3j, -3j]).real[::-1]
    assert kinds(ia.synthesis.synthesise((num, den))) == {"Inerter": 3, "Spring": 2}
    assert kinds(ia.synthesis.synthesise((den, num))) == {"Inerter": 2, "Spring": 3}


def minimum_function(rng: np.random.Generator) -> tuple[Coefficients, Coefficients]:
    """Return a biquadratic with Re F = 0 at one frequency, no poles and zeros on the axis."""
    x, (b, e) = rng.uniform(0.5, 2.0), 10 ** rng.uniform(-0.5, 0.5, 2)
    c = rng.uniform(0.1, 0.9) * x
    f = x + b * e * x / (x - c)  # (c - x)(f - x) + b e x = 0
    f = x**2 / c  # and it is the least there: c f = x^2
    b = (x - c) * (f - x) / (e * x)
    return (np.array([1.0, b, c]), np.array([1.0, e, f]))


@pytest.mark.parametrize("seed", range(20))
def test_a_minimum_function_takes_seven_elements(seed: int) -> None:
    """Hughes, IEEE Trans. Automat. Contr. 62 (2017) 4333-4346: five reactive ones, in a bridge."""
    num, den = minimum_function(np.random.default_rng(seed))
    for one, other in ((num, den), (den, num)):
        strut = ia.synthesis.synthesise((one, other))
        found = kinds(strut)
        assert found["Damper"] == 2
        assert found["Inerter"] + found["Spring"] == 5
        assert_it_is(strut, one, other)


def assert_it_is(strut: ia.TwoTerminal, num: Coefficients, den: Coefficients) -> None:
    """Compare with all states the network has, and look for values that are not above zero."""
    s = 1j * FREQUENCIES
    wanted = np.polyval(num, s) / np.polyval(den, s)
    assert np.abs(linearised(strut)(s).ravel() / wanted - 1).max() < 1e-8
    assert all(getattr(e, "bdk"["IDS".index(type(e).__name__[0])]) > 0 for e in elements(strut))


@pytest.mark.parametrize("seed", range(30))
def test_what_is_not_regular_takes_at_most_eight_elements(seed: int) -> None:
    """A damper, and a bridge of two dampers and five reactive elements, if none with fewer is found."""
    rng = np.random.default_rng(seed)
    while True:
        num, den = 10 ** rng.uniform(-1, 1, 3), 10 ** rng.uniform(-1, 1, 3)
        least = [least_real(*pair) for pair in ((num, den), (den, num))]
        ends = [min(one[0] / other[0], one[-1] / other[-1]) for one, other in ((num, den), (den, num))]
        if least[0] > 0 and all(a < b * (1 - 1e-6) for a, b in zip(least, ends, strict=True)):
            break
    strut = ia.synthesis.synthesise((num, den))
    found = kinds(strut)
    assert sum(found.values()) <= 8
    assert found["Damper"] == 3
    assert_it_is(strut, num, den)


def test_six_elements_where_a_pole_is_shared() -> None:
    """An inerter and a damper side by side share a pole of 1/Y with what is in series with them."""
    num, den = [1.0, 1.77, 0.26], [1.0, 9.28, 15.7]
    for one, other in ((num, den), (den, num), (num[::-1], den[::-1])):
        strut = ia.synthesis.synthesise((one, other))
        assert kinds(strut)["Damper"] == 3
        assert len(elements(strut)) == 6
        assert_it_is(strut, one, other)


@pytest.mark.parametrize(
    ("num", "den"),
    [
        ([1.0, 1.0, 1.1], [1.0, 1.0, 0.5]),
        ([1.0, 0.2, 1.1], [1.0, 0.7, 0.8]),
        ([2.0, 1.0, 4.0], [1.0, 1.3, 3.0]),
    ],
)
def test_seven_elements_do_for_most_that_are_not_regular(num: Coefficients, den: Coefficients) -> None:
    strut = ia.synthesis.synthesise((num, den))
    assert kinds(strut)["Damper"] == 3
    assert len(elements(strut)) == 7
    assert_it_is(strut, num, den)


def rubbing(d: float, other: ia.Component, how: Any = ia.parallel) -> ia.TwoTerminal:
    """A damper beside another element, or in series with it."""
    strut: ia.TwoTerminal = how(ia.Damper(d=d), other)
    return strut


INERTER, SPRING = ia.Inerter(b=2.0), ia.Spring(k=5.0)


@pytest.mark.parametrize(
    "strut",
    [
        ia.series(rubbing(3.0, INERTER), rubbing(0.7, SPRING)),
        ia.parallel(rubbing(3.0, INERTER, ia.series), rubbing(0.7, SPRING, ia.series)),
        ia.series(ia.Damper(d=3.0), ia.parallel(INERTER, rubbing(0.7, SPRING, ia.series))),
        ia.parallel(ia.Damper(d=3.0), ia.series(SPRING, rubbing(0.7, INERTER))),
        ia.series(ia.parallel(SPRING, ia.Inerter(b=3.0)), rubbing(5.0, INERTER)),
    ],
)
def test_no_more_elements_come_back_than_went_in(strut: ia.TwoTerminal) -> None:
    again = ia.synthesis.synthesise(ia.analysis.admittance(strut))
    assert len(elements(again)) <= len(elements(strut))
    s = 1j * FREQUENCIES
    assert np.abs(ia.analysis.admittance(again)(s) / ia.analysis.admittance(strut)(s) - 1).max() < 1e-8


def test_a_bridge_joins_five_elements() -> None:
    with pytest.raises(ia.ModelError, match="joins five elements, got 2"):
        ia.bridge(ia.Damper(d=1.0), ia.Spring(k=1.0))
    balanced = ia.bridge(*(ia.Damper(d=d) for d in (1.0, 2.0, 3.0, 6.0)), across=ia.Spring(k=9.0))
    assert ia.analysis.admittance(balanced)(1j).item() == pytest.approx(2 / 3 + 2.0, rel=1e-12)


@pytest.mark.parametrize(
    "strut",
    [
        ia.series(ia.SpringDamper(k=4e4, d=260.0), ia.Inerter(b=130.0)),
        ia.machines.suspension("S3", 60e3, 2300.0, 31.0),
        ia.machines.suspension("S7", 60e3, 3200.0, 330.0, k_1=2e4, k_2=3e4),
        ia.machines.suspension("S8", 60e3, 3200.0, 300.0, 1e4, 2e4, 3e4),
    ],
)
def test_the_admittance_of_a_network_is_realised_anew(strut: ia.TwoTerminal) -> None:
    own = ia.analysis.admittance(strut)
    again = ia.analysis.admittance(ia.synthesis.synthesise(own))
    s = 2j * np.pi * np.geomspace(0.1, 100.0, 50)
    assert np.abs(again(s) / own(s) - 1).max() < 1e-8


@pytest.mark.parametrize("seed", range(10))
def test_fosters_forms_have_a_branch_a_pole(seed: int) -> None:
    rng = np.random.default_rng(seed)
    k, c, p, x = rng.uniform(0.5, 3.0, 4)
    s = 1j * FREQUENCIES
    relaxing = [([k], [1.0, p]), ([c, 0.0], [1.0, p + 1])]
    terms = [*relaxing, ([2.0, 0.0], [1.0, 0.0, x]), ([0.3], [1.0, 0.0]), ([0.4], [1.0])]
    num: Coefficients = np.zeros(1)
    den: Coefficients = np.ones(1)
    for above, below in terms:
        num, den = np.polyadd(np.polymul(num, below), np.polymul(above, den)), np.polymul(den, below)
    second = ia.synthesis.foster((num, den), form=2)
    assert kinds(second) == {"Damper": 3, "Inerter": 2, "Spring": 3}
    first = ia.synthesis.foster((den, num), form=1)
    assert kinds(first) == {"Damper": 3, "Inerter": 3, "Spring": 2}
    wanted = sum(np.polyval(above, s) / np.polyval(below, s) for above, below in terms)
    assert np.abs(linearised(second)(s).ravel() / wanted - 1).max() < 1e-10
    assert np.abs(linearised(first)(s).ravel() * wanted - 1).max() < 1e-10


def test_what_has_no_foster_form_is_told() -> None:
    with pytest.raises(ia.ModelError, match="no branch for complex or multiple poles, of which there are 2"):
        ia.synthesis.foster(([1.0, 1.0, 3.0], [1.0, 2.0, 2.0]))
    with pytest.raises(ia.ModelError, match=r"lacks a resistance of 0\.25 N\.s/m"):
        ia.synthesis.foster(([0.5, 1.5], [1.0, 3.0, 2.0]))  # 1/(s + 1) - 0.5/(s + 2)
    with pytest.raises(ia.ModelError, match="forms are 1"):
        ia.synthesis.foster(([1.0], [1.0]), form=3)


def test_common_factors_are_cancelled() -> None:
    assert kinds(ia.synthesis.synthesise(([1.0, -1.0], [2.0, -2.0]))) == {"Damper": 1}
    assert kinds(ia.synthesis.synthesise(([1.0, 3.0, 2.0, 0.0], [1.0, 6.0, 5.0, 0.0]))) == {
        "Damper": 2,
        "Inerter": 1,
    }


@pytest.mark.parametrize(
    ("num", "den", "kind"),
    [([2.0], [1.0], "Damper"), ([2.0, 0], [1.0], "Inerter"), ([2.0], [1.0, 0], "Spring")],
)
def test_single_elements(num: Coefficients, den: Coefficients, kind: str) -> None:
    assert kinds(ia.synthesis.synthesise((num, den))) == {kind: 1}


def test_admittances_come_in_many_forms() -> None:
    import scipy.signal

    num, den = [1.0, 2.0], [1.0, 1.0]
    for given in (
        (num, den),
        RationalFunction(num, den),
        scipy.signal.TransferFunction(num, den),
        scipy.signal.TransferFunction(num, den).to_ss(),
    ):
        assert ia.analysis.admittance(ia.synthesis.synthesise(given))(1j).item() == pytest.approx(
            (1j + 2) / (1j + 1), rel=1e-9
        )
    control = pytest.importorskip("control", reason="needs python-control")
    assert ia.synthesis.positive_real(control.tf(num, den))


def test_what_cannot_be_an_admittance() -> None:
    with pytest.raises(ia.ModelError, match="must be finite real"):
        RationalFunction([np.nan], [1.0])
    with pytest.raises(ia.ModelError, match="denominator must not be zero"):
        RationalFunction([1.0], [0.0])
    with pytest.raises(ia.ModelError, match="is zero: nothing"):
        ia.synthesis.synthesise(([0.0], [1.0]))
    with pytest.raises(ia.ModelError, match="an admittance is a"):
        ia.synthesis.synthesise(3.0)
