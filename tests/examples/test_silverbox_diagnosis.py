"""examples/silverbox_diagnosis.py: its linear oscillator, and the measured records where they are."""

import sys
from pathlib import Path
from typing import Any

import inertance as ia
import pytest

EXAMPLE = "silverbox_diagnosis"


@pytest.fixture
def measured(example: Any) -> None:
    if not all((example.DATA / f"{name}.csv").is_file() for name in (example.TRAIN, *example.TESTS)):
        pytest.skip("no Silverbox records: not checked is what a linear oscillator misses of them")


def test_says_where_the_records_come_from(
    example: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["silverbox", "--data", str(tmp_path), "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit, match=r"no train_1\.csv in .*\n.*nonlinearbenchmark"):
        example.main()
    assert not (tmp_path / "out").exists()


def test_an_input_of_a_volt_holds_the_oscillator_at_a_volt(example: Any) -> None:
    run = example.oscillator().simulate(2.0, inputs={"gain.u": 1.0}, progress=False)
    assert run["mass.s"][-1] == pytest.approx(1.0, rel=1e-3)


@pytest.mark.usefixtures("measured")
def test_a_linear_oscillator_misses_what_is_published_of_it(example: Any) -> None:
    campaign = example.campaign(example.DATA)
    assert [len(e.record.time) for e in campaign.experiments] == [26000, 8000, 40500]
    tests = [one for one in ia.fit(campaign).comparisons if one.tested]
    rms = {one.experiment.name: 1e3 * one.rms("y_V", one.after) for one in tests}
    assert rms["test_1.csv"] == pytest.approx(7.0, abs=0.7)  # [mV]
    assert rms["test_2.csv"] == pytest.approx(14.2, abs=1.5)
