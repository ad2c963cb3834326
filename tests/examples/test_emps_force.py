"""examples/emps_force.py: a late encoder parts force and motion; on the measured axis where that is."""

import sys
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Record

EXAMPLE = "emps_force"


@pytest.fixture
def measured(example: Any) -> None:
    if not all((example.emps.DATA / file).is_file() for file in example.emps.FILES.values()):
        pytest.skip("no EMPS records: not checked is the force that the measured motion does not explain")


def missed(example: Any, read: list[Record], coulomb: bool, late: float = 0.0) -> float:
    """Return what a fitted model misses of the force in the test record while the axis moves [N]."""
    campaign = example.campaign(read, coulomb, late)
    values = ia.fit(campaign).values
    record, motion = read[1], read[1].sampled("q", delay=-late)
    run = campaign.network.simulate(
        record.time[-1],
        step=1e-3,
        inputs={"motion.s_ref": motion},
        parameters=values,
        solver="compiled",
        progress=False,
    )
    moving = np.abs(run["carriage.v"]) > 1e-4
    left = np.interp(run.time, record.time, record.values["F"]) - run["drive.f"]
    return float(np.sqrt(np.trapezoid(left**2 * moving, run.time) / np.trapezoid(moving, run.time)))


def test_says_where_the_records_come_from(
    example: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["emps_force", "--data", str(tmp_path), "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit, match=r"no DATA_EMPS\.mat in "):
        example.main()
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("measured")
def test_a_late_encoder_explains_more_of_the_measured_axis_than_any_law(example: Any) -> None:
    read = example.records(example.emps.DATA)
    plain, rubbing = (missed(example, read, coulomb) for coulomb in (False, True))
    late, early = (missed(example, read, True, seconds) for seconds in (0.7e-3, -0.7e-3))
    assert 13.0 < plain < 15.5
    assert 5.5 < rubbing < 6.9
    assert late < 0.7 * rubbing
    assert early > 1.4 * rubbing
