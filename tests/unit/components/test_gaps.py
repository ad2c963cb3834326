"""Contacts that open: forces at given states, rebounds and periods known in closed form."""

import inertance as ia
import numpy as np
import pytest
from scipy.optimize import root_scalar


def against_wall(element: ia.Component, s: float, v: float, m: float = 1.0) -> ia.Network:
    net = ia.Network("contact", wall=ia.Fixed(), gap=element, mass=ia.Mass(m=m, s=s, v=v))
    net.connect(net.wall.flange, net.gap.flange_a)
    net.connect(net.gap.flange_b, net.mass.flange)
    return net


def force_at(element: ia.Component, s: float, v: float) -> float:
    return float(against_wall(element, s, v).simulate(1e-6)["gap.f"][0])


@pytest.mark.parametrize(
    ("s", "v", "force"),
    [
        (2.0, -9.0, 0.0),  # apart
        (1.5, -9.0, 0.0),  # just touching: no damping force without spring force
        (1.0, 0.0, -5.0),  # spring alone
        (1.0, -2.0, -8.0),  # damper helps the spring
        (1.0, -9.0, -10.0),  # damper limited to the spring's force
        (1.0, 2.0, -2.0),  # damper takes from the spring
        (1.0, 9.0, 0.0),  # and never pulls
    ],
)
def test_elasto_gap_limits_its_damping(s: float, v: float, force: float) -> None:
    assert force_at(ia.ElastoGap(k=10.0, d=1.5, s_rel0=1.5), s, v) == pytest.approx(force, abs=1e-12)


def test_elasto_gap_release_speed() -> None:
    """Pressed 1.5 m and let go, the mass leaves where the damper has used up the spring."""
    k, d, e0 = 10.0, 1.5, 1.5
    net = against_wall(ia.ElastoGap(k=k, d=d, s_rel0=e0), s=0.0, v=0.0)
    run = net.simulate(1.0, rtol=1e-9, atol=1e-11)
    decay = d / 2
    w = np.sqrt(k - decay**2)

    def speed(t: float) -> float:
        return float(e0 * k / w * np.exp(-decay * t) * np.sin(w * t))

    def pressed(t: float) -> float:
        return float(e0 * np.exp(-decay * t) * (np.cos(w * t) + decay / w * np.sin(w * t)))

    release = root_scalar(lambda t: k * pressed(t) - d * speed(t), bracket=(0.1, 1.0)).root
    assert run["mass.v"][-1] == pytest.approx(speed(release), rel=1e-6)
    assert run["gap.f"].max() == 0.0


@pytest.mark.parametrize("n", [1.0, 1.5])
def test_elasto_gap_deepest_point_follows_from_energy(n: float) -> None:
    k, m, v = 1e5, 2.0, 3.0
    net = against_wall(ia.ElastoGap(k=k, d=0.0, s_rel0=0.1, n=n), s=0.13, v=-v, m=m)
    run = net.simulate(0.1, step=1e-5, rtol=1e-9, atol=1e-11)
    deepest = ((n + 1) * m * v**2 / (2 * k)) ** (1 / (n + 1))
    assert 0.1 - run["mass.s"].min() == pytest.approx(deepest, rel=1e-5)
    assert run["mass.v"][-1] == pytest.approx(v, rel=1e-6)


@pytest.mark.parametrize(
    ("s", "v", "force"),
    [
        (0.005, 0.0, 0.0),
        (0.02, 0.0, 1.0),
        (-0.02, 0.0, -1.0),
        (0.02, 0.25, 1.5),
        (0.02, -1.0, 0.0),
        (0.005, 1.0, 1.5),  # the damper counts inside the clearance
        (0.02, -2.0, -1.0),
    ],
)
def test_backlash_is_a_dead_zone_on_spring_and_damper(s: float, v: float, force: float) -> None:
    element = ia.Backlash(k=100.0, d=2.0, eps=0.01)
    assert force_at(element, s, v) == pytest.approx(force, abs=1e-12)


def test_backlash_without_clearance_is_a_spring_and_damper() -> None:
    backlash = ia.Backlash(k=100.0, d=2.0, eps=0.0, s_rel0=0.3)
    plain = ia.SpringDamper(k=100.0, d=2.0, s_rel0=0.3)
    ends = [against_wall(e, 0.5, 0.0).simulate(1.0)["mass.s"][-1] for e in (backlash, plain)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-12)


def test_backlash_lengthens_the_period() -> None:
    k, eps, amplitude = 400.0, 0.1, 0.5
    w = np.sqrt(k)
    period = 2 * np.pi / w + 4 * eps / (w * (amplitude - eps))
    net = against_wall(ia.Backlash(k=k, d=0.0, eps=eps), s=amplitude, v=0.0)
    run = net.simulate(10 * period, rtol=1e-10, atol=1e-12)
    assert run["mass.s"][-1] == pytest.approx(amplitude, rel=1e-6)
    assert run["mass.s"].min() == pytest.approx(-amplitude, rel=1e-6)


def test_errors_name_parameter_value_and_unit() -> None:
    net = against_wall(ia.ElastoGap(k=-1.0, d=0.0), s=1.0, v=0.0)
    with pytest.raises(ia.ModelError, match=r"ElastoGap 'gap': k must be at least 0 N/m\^n, got -1"):
        net.simulate(1.0)
    net = against_wall(ia.Backlash(k=1.0, d=0.0), s=1.0, v=0.0)  # type: ignore[call-arg]
    with pytest.raises(ia.ModelError, match=r"eps \[m\] \(half of the clearance\) must be given"):
        net.simulate(1.0)
