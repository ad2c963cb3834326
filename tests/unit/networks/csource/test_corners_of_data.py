"""Solver "compiled" under measured motion: pieces of data meet at corners, which friction feels."""

import inertance as ia
import numpy as np
import pytest

RATE, STOP = 1000.0, 2.0


def measured(seed: int, rate: float = RATE) -> ia.Sampled:
    """Return a motion of some millimetres with content up to 60 Hz, beginning anywhere."""
    t = np.arange(0.0, STOP + 0.5 / rate, 1 / rate)
    rng = np.random.default_rng(seed)
    frequencies = rng.uniform(1.0, 60.0, 40)
    waves = np.sin(2 * np.pi * frequencies * t[:, None] + rng.uniform(0, 2 * np.pi, 40))
    return ia.Sampled(t, waves @ (3e-3 / frequencies))


def rubbing(motion: ia.Sampled) -> ia.Network:
    net = ia.Network(
        "table",
        table=ia.Position(s_ref=motion),
        rail=ia.CoulombFriction(f_c=3.0),
        spring=ia.SpringDamper(k=4e3, d=8.0),
        mass=ia.Mass(m=1.0),
    )
    net.connect(net.table.flange, net.rail.flange_a, net.spring.flange_a)
    return net.connect(net.rail.flange_b, net.spring.flange_b, net.mass.flange)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_step_ends_at_a_corner_that_it_cannot_pass(seed: int) -> None:
    stop = STOP / 2
    run = rubbing(measured(seed)).simulate(stop, step=4e-3, solver="compiled", rtol=1e-7)
    assert run.stats["events"] > 20
    assert run.stats["steps"] < 3.5 * RATE * stop  # twice as many where it has to find each corner
    exact = rubbing(measured(seed)).simulate(stop, step=4e-3, solver="cvodes", rtol=1e-9, atol=1e-13)
    times = np.linspace(0.0, stop, 251)
    for name in ("mass.s", "mass.v"):
        a, b = (np.interp(times, one.time, one[name]) for one in (run, exact))
        assert np.abs(a - b).max() < 1e-4 * np.abs(b).max(), name


def test_a_smooth_model_steps_over_corners_as_before() -> None:
    """Where only the spring feels the motion, a corner is in its fourth derivative."""
    smooth = ia.Network(
        "smooth", table=ia.Position(s_ref=measured(3)), spring=ia.Spring(k=4e3), mass=ia.Mass(m=1.0)
    )
    smooth.connect(smooth.table.flange, smooth.spring.flange_a)
    smooth.connect(smooth.spring.flange_b, smooth.mass.flange)
    run = smooth.simulate(STOP, step=4e-3, solver="compiled", rtol=1e-5)
    assert run.stats["steps"] < RATE * STOP
