"""Corners of laws are modes in an FMU: each side is smooth, and an integrator outside lands on the corner."""

from __future__ import annotations

import shutil
from pathlib import Path

import casadi as ca
import fmpy
import inertance as ia
import numpy as np
import pytest
from inertance.machines import Sinusoid
from inertance.networks import corners_as_modes

needs_compiler = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


def rattle() -> ia.Network:
    """A mass between two stiff, damped sides of a clearance, shaken by a force."""
    net = ia.Network(
        "rattle",
        wall=ia.Fixed(),
        play=ia.ElastoGap(k=1e8, d=1e3),
        mass=ia.Mass(m=1.0, s=1e-3),
        shake=ia.Force(f=Sinusoid(50.0, 5.0)),
        spring=ia.Spring(k=1e4),
    )
    net.connect(net.wall.flange, net.play.flange_a, net.spring.flange_a)
    return net.connect(net.play.flange_b, net.mass.flange, net.shake.flange, net.spring.flange_b)


def test_a_corner_is_a_mode_and_changes_nothing_else() -> None:
    dae = rattle().dae()
    cornered = corners_as_modes(dae)
    added = cornered.modes.numel() - dae.modes.numel()
    assert added > 0
    assert len(cornered.switching.changes) == len(dae.switching.changes) + 2 * added
    plain = ca.Function("plain", dae.arguments(), [dae.ode])
    count = dae.switching.expressions.numel()
    chosen = ca.Function(
        "chosen", cornered.arguments(), [cornered.ode, cornered.switching.expressions[count:]]
    )
    p, rest = list(dae.parameter_values.values()), [0.0] * (dae.impulses.numel() + dae.completion.numel())
    for s, v in ((-1e-6, 0.1), (-1e-6, -0.1), (1e-3, 0.1), (-1e-6, 1.0)):
        modes, ode = np.zeros(added), None
        for _ in range(added + 1):  # a corner may stand behind another
            ode, found = chosen([s, v], [], [0.0], [*p, *modes, *rest], 0.0)
            modes = (found.full().ravel()[::2] > 0).astype(float)
        assert ode is not None
        assert ode.full() == pytest.approx(plain([s, v], [], [0.0], [*p, *rest], 0.0).full(), rel=1e-14)


def test_without_corners_nothing_is_done() -> None:
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=1e4), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    dae = net.connect(net.spring.flange_b, net.mass.flange).dae()
    assert corners_as_modes(dae) is dae


@needs_compiler
def test_an_integrator_outside_gets_through_a_clearance(tmp_path: Path) -> None:
    """CVODE needed 500 steps within a millisecond at corners of the inerter's meshes, and gave up."""
    rig = ia.machines.inerter_rig(ia.machines.ge_wang.planetary_inerter(), Sinusoid(0.005, 0.5)).dae()
    parts = "inerter.screw.contact", "inerter.flywheel.planet"
    start = {f"{part}.{x}": 0.0 for part in parts for x in ("s_rel", "v_rel")}
    path = ia.export_fmu(rig, tmp_path / "rig.fmu", start=start, outputs=["inerter.flange_a.f"])
    described = fmpy.read_model_description(str(path))
    assert not any("corner" in variable.name for variable in described.modelVariables)
    native = ia.simulate(rig, 0.2, step=1e-3, start=start, rtol=1e-10, atol=1e-12)
    force = native["inerter.flange_a.f"]
    for rtol in (1e-5, 1e-7):
        run = fmpy.simulate_fmu(
            str(path), fmi_type="ModelExchange", stop_time=0.2, output_interval=1e-3, relative_tolerance=rtol
        )
        grid = 1e-3 * np.arange(201)
        wanted = np.interp(grid, native.time, force)
        found = np.interp(grid, run["time"], run["inerter.flange_a.f"])
        assert np.abs(found - wanted).max() < 1e3 * rtol * np.abs(force).max()


def test_what_knows_no_beyond_stays() -> None:
    """A power of a depth has no value before the touch, so that its corner is none of the modes."""
    net = ia.Network(
        "gap",
        wall=ia.Fixed(),
        gap=ia.ElastoGap(k=1e5, d=50.0, n=1.5),
        mass=ia.Mass(m=1.0, s=0.05),
    )
    net.connect(net.wall.flange, net.gap.flange_a)
    dae = net.connect(net.gap.flange_b, net.mass.flange).dae()
    cornered = corners_as_modes(dae)
    chosen = ca.Function("chosen", cornered.arguments(), [cornered.ode])
    modes = cornered.modes.numel()
    assert modes == 2  # the two bounds of the damping
    rest = [0.0] * (dae.impulses.numel() + dae.completion.numel())
    for bits in range(2**modes):
        chosen_modes = [float(bits >> k & 1) for k in range(modes)]
        q = [*dae.parameter_values.values(), *chosen_modes, *rest]
        for s in (-1e-3, 1e-3):
            assert np.isfinite(chosen([s, 0.1], [], [], q, 0.0).full()).all()
