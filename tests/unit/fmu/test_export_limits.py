"""What an exported FMU refuses: numbers that are out of all proportion, and steps without end."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

import inertance as ia
import pytest

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)


def corner() -> ia.Network:
    """A wheel on a spring and a damper, which sticks."""
    net = ia.Network(
        "corner",
        wheel=ia.Mass(m=40.0),
        strut=ia.SpringDamper(k=2e4, d=1500.0),
        body=ia.Mass(m=300.0, s=0.1),
        rub=ia.CoulombFriction(f_c=50.0),
        road=ia.Spring(k=2e5),
        ground=ia.Fixed(),
    )
    net.connect(net.ground.flange, net.road.flange_a)
    net.connect(net.road.flange_b, net.wheel.flange, net.strut.flange_a, net.rub.flange_a)
    return net.connect(net.strut.flange_b, net.body.flange, net.rub.flange_b)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_step_without_end_is_given_up_and_says_why(version: str, tmp_path: Path) -> None:
    """It took 22 s, and 90 s with other parameters, and then failed without a word."""
    path = ia.export_fmu(corner(), tmp_path / "corner.fmu", fmi_version=version, step=1e-3)
    fmu = ia.FMU(path)
    told = []
    for name in ("road.k", "strut.k", "strut.d"):
        for value in (1e20, 1e150, 1e308):
            before = time.process_time()
            try:
                fmu.simulate(2e-3, step=1e-3, kind="CS", parameters={name: value})
            except ia.InertanceError as error:
                told.append(str(error))
            assert time.process_time() - before < 8, (name, value)
    assert [
        t for t in told if "Is a parameter out of all proportion, or the communication step too long?" in t
    ]
    reasons = ("out of all proportion", "no step is short enough", "not finite", "chattering")
    assert [t for t in told if not any(reason in t for reason in reasons)] == []
