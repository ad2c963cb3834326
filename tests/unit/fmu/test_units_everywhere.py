"""One list of units through every door: a column of a campaign, an FMU of another tool, `run --input`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from zipfile import ZipFile

import inertance as ia
import numpy as np
import pytest
from inertance.cli import app
from inertance.identification import Campaign
from typer.testing import CliRunner

UNITS = {
    "m": "m mm cm um µm nm in mil ft",
    "m/s": "m/s mm/s cm/s in/s km/h m.s-1",
    "m/s2": "m/s2 m/s^2 m/s² mm/s2 g g_n mg in/s2",
    "N": "N kN MN mN lbf kgf",
    "N.m": "N.m Nm N*m N·m kN.m kNm mN.m N.mm Nmm N.cm lbf.in lbf.ft",
    "rad": "rad mrad deg ° rev",
    "rad/s": "rad/s deg/s °/s rpm rev/min",
    "rad/s2": "rad/s2 deg/s2",
    "N/m": "N/m kN/m N/mm MN/m lbf/in",
    "N.s/m": "N.s/m kN.s/m N/(m/s)",
    "kg": "kg g t",
    "kg.m2": "kg.m2 kg.cm2 g.cm2",
    "s": "s ms us min h",
    "W": "W kW",
    "J": "J kJ",
    "Pa": "Pa bar MPa",
    "V": "V mV",
    "A": "A mA",
    "Hz": "Hz kHz 1/s 1/min",
    "1/(m.s)": "1/(m.s)",
    "1": "1 %",
}
CASES = [(si, unit) for si, units in UNITS.items() for unit in units.split()]
GIVEN = 1.0 + np.arange(40) ** 2 % 7
RIG = """
from inertance import Component, Network, der, variable
from inertance.components import RealInput, RealOutput


class Probe(Component):
    u = RealInput("{si}", "what is given")
    y = RealOutput("{si}", "the same")
    late = variable("", "the same, later")
    rate = variable("", "of it")

    def equations(self):
        yield self.y == self.u
        yield der(self.late) == self.rate
        yield self.rate == self.u - self.late


def build():
    return Network("rig", probe=Probe())
"""
MakeFMU = Callable[..., Path]


@pytest.fixture(params=CASES, ids=[f"{unit} for {si}" for si, unit in CASES])
def rig(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, str, str]:
    """A folder with a model that takes an SI unit, and data in another; the units."""
    si, unit = request.param
    (tmp_path / "rig.py").write_text(RIG.format(si=si))
    for name, columns in {"input": 1, "record": 2}.items():
        lines = [f"time [ms],probe.u [{unit}]" + ",y" * (columns - 1)]
        lines += [f"{10 * k}" + f",{x}" * columns for k, x in enumerate(GIVEN)]
        (tmp_path / f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return tmp_path, si, unit


def test_a_unit_is_the_same_through_every_door(
    rig: tuple[Path, str, str], make_fmu: MakeFMU, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, si, unit = rig
    monkeypatch.chdir(folder)
    factor = _foreign(make_fmu("spring"), folder, si, unit)
    channels = {"probe.u": {"input": "probe.u", "unit": unit}, "y": {"output": "probe.y"}}
    campaign = Campaign("rig.py:build", channels, {}, [{"file": "record.csv"}])
    assert campaign.training[0].record.values["probe.u"] == pytest.approx(factor * GIVEN)
    run = CliRunner().invoke(
        app, ["run", "rig.py:build", "--input", "input.csv", "--signals", "probe.y", "--out", "out.csv",
              "--step", "0.01"]
    )  # fmt: skip
    assert run.exit_code == 0, run.output
    assert ia.load_table("out.csv")["probe.y"].iloc[0] == pytest.approx(factor * GIVEN[0])


def _foreign(path: Path, folder: Path, si: str, unit: str) -> float:
    """Return what 1 of a unit is for an FMU that declares a parameter in another, neither of them defined."""
    copy = folder / "foreign.fmu"
    with ZipFile(path) as archive, ZipFile(copy, "w") as written:
        for name in archive.namelist():
            content = archive.read(name)
            if name == "modelDescription.xml":
                content = content.replace(b'<Real unit="N/m"', f'<Real unit="{si}"'.encode())
            written.writestr(name, content)
    fmu = ia.FMU(copy, validate=False)
    return float(fmu.converted(fmu.variables["k"], (1.0, unit)))
