"""Campaigns and records: read in SI units, their noise, filters, excitations, and the command."""

from collections.abc import Callable
from pathlib import Path

import inertance as ia
import numpy as np
import pytest
from inertance.cli import app
from inertance.identification import Campaign, Filter, Multisine, SineDwells
from inertance.machines import Sinusoid
from typer.testing import CliRunner

MODEL = """
import inertance as ia

def build():
    net = ia.Network("rig", table=ia.Position(), spring=ia.SpringDamper(k=1000.0, d=4.0), mass=ia.Mass(m=2.0))
    net.connect(net.table.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    return net
"""
CAMPAIGN = """
model = "rig.py:build"
[channels]
x = { input = "table.s_ref", unit = "mm" }
F = { output = "spring.f", unit = "N" }
[parameters]
"spring.k" = { rel = 0.1 }
"spring.d" = { min = 0.0, max = 20.0 }
[[train]]
file = "train.csv"
[[test]]
file = "test.csv"
[noise]
F = 0.01
"""


def rows(frequency: float = 2.0, rate: float = 200.0) -> list[tuple[float, float, float]]:
    drive = ia.identification.sampled(Sinusoid(2e-3, frequency), stop=1.0, rate=rate, fade=0.3)
    model: dict[str, Callable[[], ia.Network]] = {}
    exec(MODEL, model)
    inputs = {"table.s_ref": drive}
    run = model["build"]().simulate(1.0, step=1 / rate, inputs=inputs, parameters={"spring.k": 1080.0})
    force = run["spring.f"] + np.random.default_rng(0).normal(0, 0.01, len(run.time))
    return list(zip(drive.time.tolist(), (1e3 * drive.values).tolist(), force.tolist(), strict=True))


ROWS, OTHER = rows(), rows(3.0)


def write(path: Path, table: list[tuple[float, float, float]], header: str = "time [s],x [mm],F [N]") -> None:
    lines = [",".join(f"{v:.9g}" for v in row) for row in table]
    path.write_text("\n".join([header, *lines]) + "\n")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "rig.py").write_text(MODEL)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    write(tmp_path / "train.csv", ROWS)
    write(tmp_path / "test.csv", OTHER)
    return tmp_path


def test_all_problems_are_told_at_once(folder: Path) -> None:
    text = CAMPAIGN.replace("rel = 0.1", "rel = 0.0").replace("F = 0.01", "G = 1.0").replace('"mm"', '"lbf"')
    (folder / "campaign.toml").write_text(text)
    with pytest.raises(ia.ModelError) as told:
        Campaign.load(folder / "campaign.toml")
    assert len(told.value.problems) >= 3


def test_a_campaign_in_si_units_with_notes_on_rates(folder: Path) -> None:
    write(folder / "test.csv", rows(3.0, 100.0))
    campaign = Campaign.load(folder / "campaign.toml")
    record = campaign.training[0].record
    assert record.values["x"].max() == pytest.approx(2e-3, rel=0.05)
    assert record.rate == pytest.approx(200.0)
    assert campaign.floors["F"].source == "stated"
    assert any("sampling rates differ" in note for note in campaign.notes)


def test_small_jitter_is_evened_out_and_told(folder: Path) -> None:
    jitter = np.random.default_rng(0).uniform(-3e-4, 3e-4, len(ROWS))
    write(folder / "train.csv", [(t + j, x, f) for (t, x, f), j in zip(ROWS, jitter, strict=True)])
    campaign = Campaign.load(folder / "campaign.toml")
    assert any("jitter" in note for note in campaign.notes)
    assert np.ptp(np.diff(campaign.training[0].record.time)) < 1e-12


@pytest.mark.parametrize("ending", [".npz", ".mat", ".parquet"])
def test_other_formats_hold_the_same(folder: Path, ending: str) -> None:
    import pandas as pd
    from scipy.io import savemat

    time, x, force = np.array(ROWS).T
    path = folder / f"train{ending}"
    if ending == ".npz":
        np.savez(path, t=time, x=x, F=force)
    elif ending == ".mat":
        savemat(path, {"t": time, "x": x, "F": force, "gain": 3.0})
    else:
        pd.DataFrame({"time": time, "x": x, "F": force}).to_parquet(path)
    (folder / "campaign.toml").write_text(CAMPAIGN.replace("train.csv", path.name))
    record = Campaign.load(folder / "campaign.toml").training[0].record
    assert record.values["x"] == pytest.approx(1e-3 * x)
    assert record.values["F"] == pytest.approx(force)


def test_noise_is_estimated_from_the_spectrum_and_from_repeats(folder: Path) -> None:
    text = CAMPAIGN[: CAMPAIGN.index("[noise]")]
    (folder / "campaign.toml").write_text(text)
    floor = Campaign.load(folder / "campaign.toml").floors["F"]
    assert floor.source == "spectrum"
    assert floor.sigma == pytest.approx(0.01, rel=0.25)
    again = np.random.default_rng(5).normal(0, 0.01 * 2**0.5, len(ROWS))
    write(folder / "again.csv", [(t, x, f + n) for (t, x, f), n in zip(ROWS, again, strict=True)])
    repeat = '[[train]]\nfile = "again.csv"\nrepeat_of = "train.csv"\n'
    (folder / "campaign.toml").write_text(text + repeat)
    floor = Campaign.load(folder / "campaign.toml").floors["F"]
    assert floor.source == "repeats"
    assert floor.sigma == pytest.approx(0.01, rel=0.25)


def test_a_filter_delays_nothing() -> None:
    t = np.arange(0, 10, 1e-3)
    slow, fast = np.sin(2 * np.pi * 0.2 * t), np.sin(2 * np.pi * 5 * t)
    passed = Filter(cutoff=1.0, order=6).apply(slow + fast, rate=1000.0)
    assert np.abs(passed - slow)[2000:-2000].max() < 1e-3


def test_a_multisine_is_flat_in_its_band_and_of_low_crest() -> None:
    signal = Multisine(rms=1.0, low=1.0, high=20.0, period=10.0)
    values = ia.identification.sampled(signal, stop=10.0, rate=200.0).values[:-1]
    amplitude = 2 * np.abs(np.fft.rfft(values)) / len(values)
    assert amplitude[10:201] == pytest.approx(amplitude[10], rel=1e-6)
    assert np.abs(np.r_[amplitude[:10], amplitude[201:]]).max() < 1e-9
    assert np.sqrt(np.mean(values**2)) == pytest.approx(1.0)
    assert np.abs(values).max() < 3.2


def test_dwells_begin_and_end_at_rest() -> None:
    dwells = SineDwells((1.0, 0.5), (2.0, 4.0), cycles=5)
    values = ia.identification.sampled(dwells, stop=dwells.duration, rate=1000.0).values
    assert values[0] == 0.0
    assert abs(values[2500]) < 1e-9
    assert np.abs(np.diff(values, 3)).max() < 1e-4
    assert np.abs(values[:2500]).max() == pytest.approx(1.0, rel=1e-3)
    assert np.abs(values[2500:]).max() == pytest.approx(0.5, rel=1e-2)


def test_the_command_fits_and_writes(folder: Path) -> None:
    out, picture = folder / "fit.json", folder / "fit.png"
    arguments = ["fit", str(folder / "campaign.toml"), "--json", str(out), "--plot", str(picture)]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output
    assert "spring.k" in done.output
    assert picture.stat().st_size > 10_000
    import json

    fitted = json.loads(out.read_text())["parameters"]["spring.k"]
    assert abs(fitted["value"] - 1080.0) < 4 * fitted["error"]
