"""Papers on dry friction: forced vibration in closed form, stick-slip on a belt."""

from math import cos, pi, sin, sqrt
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest

# R. I. Leine, D. H. van Campen, A. de Kraker, L. van den Steen, Stick-slip vibrations induced by alternate
# friction models, Nonlinear Dynamics 16 (1998): where the periodic motion of a block on a belt turns.
TURNING_POINT = 1.133944669704  # m


class Falling(ia.Friction):
    """Friction that falls with speed: f = F_s/(1 + delta |v_rel|) while it slides."""

    F_s = ia.parameter("N", "friction at rest", min=0)
    delta = ia.parameter("s/m", "how fast it falls", min=0)

    def sliding(self, speed: Any) -> Any:
        return self.F_s / (1 + self.delta * speed)


def test_stick_slip_of_a_block_on_a_belt() -> None:
    """k = m = F_s = 1, delta = 3, belt at 0.2 m/s: printed figure to 1e-8, one by SciPy to 1e-9."""
    net: Any = ia.Network(
        "block on a belt", wall=ia.Fixed(), spring=ia.Spring(k=1.0), block=ia.Mass(m=1.0, s=0.4, v=0.0),
        belt=ia.Speed(v_ref=0.2), rub=Falling(F_s=1.0, delta=3.0),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.belt.flange, net.rub.flange_a)
    net.connect(net.spring.flange_b, net.block.flange, net.rub.flange_b)
    run = net.simulate(40.0, step=0.01, rtol=1e-11, atol=1e-13)
    assert run.peak("block.s", begin=20.0) == pytest.approx(TURNING_POINT, abs=1e-8)
    slips = [event.time for event in run.events if event.source == "stuck"][-2:]
    assert run.at("block.s", slips[-1]) == pytest.approx(1.0, abs=1e-9)  # F_s/k

    from scipy.integrate import solve_ivp

    def turned(_: float, y: Any) -> float:
        return float(y[1])

    turned.terminal, turned.direction = True, -1  # type: ignore[attr-defined]
    slipping = solve_ivp(
        lambda _, y: [y[1], -y[0] + 1 / (1 + 3 * (0.2 - y[1]))], (0, 5), [1.0, 0.2], events=turned,
        method="DOP853", rtol=1e-13, atol=1e-15,
    )  # fmt: skip
    assert run.peak("block.s", begin=20.0) == pytest.approx(slipping.y[0, -1], abs=1e-9)


def bound(r: float) -> float:
    """Friction over force up to which there are no stops, eqs. (6) to (9) of Marino & Cicirello (2020)."""
    U, V = sin(pi / r) / (r * (1 + cos(pi / r))), 1 / (1 - r**2)
    t = np.linspace(1e-4, pi - 1e-4, 20_000)
    S = (r * np.sin(t / r) + U * r**2 * (np.cos(t) - np.cos(t / r))) / np.sin(t)
    return sqrt(V**2 / (U**2 + (S.max() / r**2) ** 2))


def driven(r: float, beta: float) -> ia.Result:
    """A mass on a spring, rubbing with beta times the force that drives it at r times its frequency."""
    net: Any = ia.Network(
        "rubbing", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=4.0, s=0.1),
        rub=ia.CoulombFriction(f_c=100.0 * beta), push=ia.Force(f=lambda t: 100.0 * ca.cos(5 * r * t)),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.rub.flange_a)
    net.connect(net.spring.flange_b, net.rub.flange_b, net.mass.flange, net.push.flange)
    run: ia.Result = net.simulate(100.0, step=0.02, rtol=1e-9, atol=1e-11)
    return run


@pytest.mark.parametrize(("r", "share"), [(0.6, 0.5), (0.85, 0.8), (1.2, 0.9), (1.7, 0.6)])
def test_forced_vibration_with_coulomb_friction(r: float, share: float) -> None:
    """J. P. Den Hartog, Phil. Mag. S. 7 vol. 9 (1930) p. 801: X = sqrt(V^2 - beta^2 U^2) without stops."""
    beta = share * bound(r)
    U, V = sin(pi / r) / (r * (1 + cos(pi / r))), 1 / (1 - r**2)
    run = driven(r, beta)
    assert run.peak("mass.s", begin=60.0) == pytest.approx(sqrt(V**2 - beta**2 * U**2), rel=2e-5)
    assert run.share("rub.mode", "stuck", begin=60.0) < 1e-6


@pytest.mark.parametrize("r", [0.6, 0.85, 1.2])
def test_stops_begin_at_the_bound(r: float) -> None:
    """Just above the bound the mass rests for a while in each half period, just below it does not."""
    below, above = (
        driven(r, share * bound(r)).share("rub.mode", "stuck", begin=60.0) for share in (0.98, 1.04)
    )
    assert below < 1e-6 < 1e-3 < above
