"""FMUs of rigs that move by micrometres: Co-Simulation follows them, other tools must be told."""

from pathlib import Path
from typing import Any

import casadi as ca
import fmpy
import inertance as ia
import numpy as np
import pytest

SIZE = 1e-6
TIME = np.linspace(0.0, 5.0, 501)


def oscillator(size: float) -> ia.Network:
    net = ia.Network(
        "rig", wall=ia.Fixed(), spring=ia.Spring(k=400.0), damper=ia.Damper(d=0.4),
        mass=ia.Mass(m=1.0, s=0.3 * size, v=0.0), push=ia.Force(f=lambda t: 200.0 * size * ca.sin(19.0 * t)),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_micrometres_are_followed(version: str, tmp_path: Path) -> None:
    wanted = oscillator(1.0).simulate(5.0, step=0.01, rtol=1e-10, atol=1e-14).at("mass.s", TIME)
    path = ia.export_fmu(oscillator(SIZE), tmp_path / "rig.fmu", fmi_version=version, outputs=["mass.s"])

    def off(kind: str, **options: Any) -> float:
        run: Any = fmpy.simulate_fmu(
            str(path), fmi_type=kind, stop_time=5.0, output_interval=0.01, output=["mass.s"], **options
        )
        found = np.interp(TIME, run["time"], run["mass.s"]) / SIZE
        return float(np.abs(found - wanted).max() / np.ptp(wanted))

    assert off("CoSimulation") < 1e-6
    assert off("ModelExchange") > 0.5
    assert off("ModelExchange", relative_tolerance=1e-10) < 1e-3
    own = ia.FMU(path).simulate(5.0, step=0.01, kind="ME")
    assert np.abs(np.interp(TIME, own.time, own["mass.s"]) / SIZE - wanted).max() < 1e-4 * np.ptp(wanted)
