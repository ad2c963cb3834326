"""examples/emps.py against the two measured records, where they are."""

import importlib.util
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "emps.py"


def load_example() -> Any:
    spec = importlib.util.spec_from_file_location("emps", EXAMPLE)
    assert spec
    assert spec.loader
    module = sys.modules["emps"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


emps = load_example()
MEASURED = pytest.mark.skipif(
    not all((emps.DATA / file).is_file() for file in emps.FILES.values()),
    reason="no EMPS records: not checked are fit, control law, position and force errors, sticking, pictures",
)


@pytest.fixture(scope="module")
def studied() -> Any:
    return emps.study(emps.DATA)


def test_says_where_the_records_come_from(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["emps.py", "--data", str(tmp_path), "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit, match=r"no DATA_EMPS\.mat in .*\n.*nonlinearbenchmark\.org"):
        emps.main()
    assert not (tmp_path / "out").exists()


@MEASURED
def test_estimates_are_the_published_ones(studied: Any) -> None:
    found, published = studied[0][1], emps.PUBLISHED
    assert found.m == pytest.approx(published.m, rel=1e-3)
    assert found.d == pytest.approx(published.d, rel=1e-3)
    assert found.f_c == pytest.approx(published.f_c, rel=2e-3)
    assert found.f_0 == pytest.approx(published.f_0, rel=5e-3)


@MEASURED
def test_the_records_obey_the_control_law_of_the_network(studied: Any) -> None:
    for compared, height in ((studied[1]["estimation"], 0.0), (studied[1]["pulses"], 5.07)):
        r = compared[0].record
        speed = (r.qm[2:] - r.qm[:-2]) / (2 * emps.SAMPLE)
        law = r.kv * (r.kp * (r.qg - r.qm)[2:] - speed) + height * (r.pulses[2:] > 0)
        assert emps.rms(law - r.vir[2:]) < 0.003 * emps.rms(r.vir)


@MEASURED
@pytest.mark.parametrize(
    ("name", "model", "s_rms", "relative"),
    [
        ("estimation", 0, 6.67e-6, 0.171),
        ("estimation", 1, 1.61e-6, 0.0457),
        ("pulses", 0, 7.07e-6, 0.166),
        ("pulses", 1, 2.54e-6, 0.0580),
    ],
)
def test_errors(studied: Any, name: str, model: int, s_rms: float, relative: float) -> None:
    compared = studied[1][name][model]
    assert emps.rms(compared.s_error) == pytest.approx(s_rms, rel=0.01)
    assert compared.relative == pytest.approx(relative, rel=0.01)


@MEASURED
@pytest.mark.parametrize("name", ["estimation", "pulses"])
def test_each_reversal_is_an_event_and_what_sticks_rests(studied: Any, name: str) -> None:
    run = studied[1][name][1].run
    friction = [e for e in run.events if "coulomb" in e.component]
    reference = np.diff(studied[1][name][1].record.qg)
    turns = np.flatnonzero(np.diff(np.sign(reference)))
    for turn in turns:
        near = [e for e in friction if abs(e.time - emps.SAMPLE * turn) < 0.05]
        assert near[0].source != near[-1].target != "stuck"
    stuck = run["coulomb.friction.mode"] == 0
    assert len(turns) == 7
    assert stuck.any()
    assert np.abs(run["carriage.v"][stuck]).max() < 1e-12


@MEASURED
def test_prints_the_tables_and_draws(
    studied: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(emps, "study", lambda directory: studied)
    monkeypatch.setattr(sys, "argv", ["emps.py", "--out", str(tmp_path)])
    emps.main()
    printed = capsys.readouterr().out
    assert all(file in printed for file in emps.FILES.values())
    assert sorted(p.name for p in tmp_path.iterdir()) == ["emps_estimation.png", "emps_pulses.png"]
