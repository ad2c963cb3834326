"""Foreign FMUs run alone: events, units, values, errors."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

import numpy as np
import pytest
from inertance import FMU, FMUError


class Make(Protocol):
    def __call__(self, model: str, *defines: str) -> Path: ...


def test_what_an_fmu_says_of_itself(make_fmu: Make) -> None:
    fmu = FMU(make_fmu("body"))
    assert repr(fmu) == "<FMU 'body': FMI 2.0, ME and CS, 8 variables>"
    assert fmu.kinds == ["ME", "CS"]
    assert fmu.states == ["s", "v"]
    assert list(fmu.inputs) == ["F"]
    assert list(fmu.outputs) == ["s", "v"]
    assert fmu.unit("m") == "kg"
    assert fmu.parameters["m"].minimum == 0.001
    text = fmu.info()
    for part in (
        "body: FMI 2.0, ME and CS",
        "linux64",
        "saves and restores",
        "F  Real  = 0  [N]",
        "states      2",
    ):
        assert part in text


def test_unknown_names(make_fmu: Make) -> None:
    fmu = FMU(make_fmu("body"))
    with pytest.raises(FMUError, match="no such variable 'Fault'; did you mean 'fault'"):
        fmu.simulate(1.0, parameters={"Fault": 1.0})
    with pytest.raises(FMUError, match=r"'F' \(it is input"):
        fmu.simulate(1.0, parameters={"F": 1.0})
    with pytest.raises(FMUError, match="cannot run as CS: it is ME"):
        FMU(make_fmu("ball")).simulate(1.0, kind="CS")
    with pytest.raises(KeyError, match="not recorded"):
        fmu.simulate(0.1)["S"]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"parameters": {"m": 0.0}}, "'m' must be between 0.001 and inf kg, got 0.0"),
        ({"parameters": {"m": (1.0, "N")}}, "'m' is in kg, not convertible from N"),
        ({"parameters": {"m": (1.0, "stone")}}, "'stone' is not understood"),
        ({"parameters": {"m": "heavy"}}, r"'m' takes a number \[kg\], got 'heavy'"),
        ({"parameters": {"m": float("nan")}}, "got nan"),
        ({"start": {"F": 1.0}}, "'F' .* takes no start value"),
        ({"inputs": {"F": "force"}}, "takes a number, a function of time"),
        ({"inputs": {"F": lambda t: float("inf")}}, "input 'F' of FMU 'body' is inf at t = 0 s"),
        ({"stop": -1.0}, "cannot run from 0 s to -1 s"),
    ],
)
def test_wrong_values(make_fmu: Make, options: dict[str, Any], told: str) -> None:
    with pytest.raises(FMUError, match=told):
        FMU(make_fmu("body")).simulate(**{"stop": 1.0, **options})


@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_parameters_and_starts_in_other_units(make_fmu: Make, kind: str) -> None:
    fmu = FMU(make_fmu("body"))
    run = fmu.simulate(
        1.0, kind=kind, inputs={"F": (0.003, "kN")}, parameters={"m": (1500.0, "g")},
        start={"s": (39.37007874015748, "inch"), "v": (1.8, "km/h")}, step=0.1,
    )  # fmt: skip
    assert np.allclose(run["s"], 1.0 + 0.5 * run.time + run.time**2, rtol=1e-6)
    assert run.unit("v") == "m/s"
    assert run.to_dataframe().attrs["units"]["s"] == "m"


def test_signals(make_fmu: Make) -> None:
    fmu, t = FMU(make_fmu("body")), np.linspace(0, 2, 201)
    smooth = fmu.simulate(2.0, inputs={"F": np.cos}, parameters={"m": 1.0}, rtol=1e-8)
    data = fmu.simulate(2.0, inputs={"F": (t, np.cos(t))}, parameters={"m": 1.0}, rtol=1e-8)
    assert np.abs(smooth["s"] - (1 - np.cos(smooth.time))).max() < 1e-7
    assert np.abs(data["s"] - (1 - np.cos(data.time))).max() < 1e-7


@pytest.mark.parametrize("rtol", [1e-5, 1e-7, 1e-9])
def test_state_events(make_fmu: Make, rtol: float) -> None:
    run = FMU(make_fmu("ball")).simulate(2.0, rtol=rtol)
    fall = (2 / 9.81) ** 0.5
    bounces = np.cumsum(np.array([fall, 1.6 * fall, 1.28 * fall]))
    found = np.array([event.time for event in run.events])
    assert {event.cause for event in run.events} == {"state"}
    assert all(np.abs(found - bounce).min() < rtol for bounce in bounces)
    assert (run["h"] > -rtol).all()
    at = int(np.searchsorted(run.time, bounces[0] - 10 * rtol))
    before, after = run["v"][at], run["v"][run.time > bounces[0] + 10 * rtol][0]
    assert after == pytest.approx(-0.8 * before, rel=2e-2)


def test_time_events_and_an_end_that_the_fmu_asks_for(make_fmu: Make) -> None:
    run = FMU(make_fmu("clock")).simulate(2.0)
    assert [(event.time, event.cause) for event in run.events] == [
        (t, "time") for t in (0.25, 0.5, 0.75, 1.0)
    ]
    assert run["x"][-1] == pytest.approx(0.25 * (1 + 2 + 3 + 4), rel=1e-12)
    assert run.time[-1] == 1.0
    assert run.notes == ["the FMU asked to end at t = 1 s"]


def test_step_events(make_fmu: Make) -> None:
    run = FMU(make_fmu("saw")).simulate(1.0, step=0.02)
    assert {event.cause for event in run.events} == {"step"}
    assert 8 <= len(run.events) <= 9
    assert 0.1 < run["x"].max() <= 0.12


def test_inputs_move_event_indicators(make_fmu: Make) -> None:
    run = FMU(make_fmu("relay")).simulate(2.0, inputs={"u": lambda t: np.cos(np.pi * t)}, rtol=1e-8)
    assert [event.time for event in run.events] == pytest.approx([0.5, 1.5], abs=1e-12)
    assert run["y"][-1] == pytest.approx(0.0, abs=1e-9)
    assert run["y"].max() == pytest.approx(0.5, abs=1e-9)


def test_a_binary_that_lacks_functions(make_fmu: Make) -> None:
    with pytest.raises(FMUError, match="binary lacks FMI functions: fmi2GetStringStatus"):
        FMU(make_fmu("body", "INCOMPLETE")).simulate(1.0, kind="CS")


@pytest.mark.parametrize(("kind", "told"), [("ME", "nan as a derivative"), ("CS", "nan as a variable")])
def test_no_number(make_fmu: Make, kind: str, told: str) -> None:
    with pytest.raises(FMUError, match=f"'body' returned {told} at t = 0.5"):
        FMU(make_fmu("body")).simulate(1.0, kind=kind, parameters={"fault": 5, "when": 0.5}, step=0.01)


def test_several_at_once_and_nothing_left(
    make_fmu: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    fmu = FMU(make_fmu("body"))
    instances = [fmu.instantiate() for _ in range(5)]
    assert len(list(tmp_path.iterdir())) == 5
    for instance in instances:
        instance.close()
    assert list(tmp_path.iterdir()) == []
