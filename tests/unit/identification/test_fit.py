"""Fits recover what the data were made with, and say how well."""

import json
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Chirp, Fit, FitInterruptedError, Multisine, Record
from inertance.machines import Sinusoid

TRUTH = {"spring.k": 1100.0, "spring.d": 5.0, "rub.friction.f_c": 0.9}
PARAMETERS = {
    "spring.k": {"rel": 0.2},
    "spring.d": {"rel": 0.5},
    "rub.friction.f_c": {"min": 0.0, "max": 5.0},
}
CHANNELS = {"x": {"input": "table.s_ref", "unit": "mm"}, "F": {"output": "spring.f", "unit": "N"}}


def rig() -> ia.Network:
    net = ia.Network(
        "rig",
        table=ia.Position(),
        spring=ia.SpringDamper(k=1000.0, d=4.0),
        mass=ia.Mass(m=2.0),
        rub=ia.SupportFriction(friction=ia.CoulombFriction(f_c=0.5)),
    )
    net.connect(net.table.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.rub.flange)
    return net


def measured(signal: Any, name: str, noise: float = 0.05, seed: int = 0, pulled: float = 0.0) -> Record:
    drive = ia.identification.sampled(signal, stop=2.0, rate=250.0, fade=0.3)
    run = rig().simulate(
        2.0, step=4e-3, inputs={"table.s_ref": drive}, parameters=TRUTH, start={"mass.s": pulled}
    )
    at = np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1
    scatter = np.random.default_rng(seed).normal(0, noise, len(at))
    return Record(name, drive.time, {"x": drive.values, "F": run["spring.f"][at] + scatter})


def campaign(**entries: Any) -> Campaign:
    train = [{"record": measured(Multisine(rms=2e-3, low=0.5, high=8.0, period=2.0), "noise")}]
    test = [{"record": measured(Chirp(4e-3, 0.5, 6.0, 2.0), "chirp", seed=1)}]
    return Campaign(rig(), CHANNELS, PARAMETERS, **{"train": train, "test": test, **entries})


@pytest.fixture(scope="module")
def done() -> Fit:
    return ia.fit(campaign())


def test_values_lie_within_three_standard_errors_of_the_truth(done: Fit) -> None:
    for name, true in TRUTH.items():
        assert abs(done.values[name] - true) < 3 * done.errors[name]
        assert done.errors[name] < 0.02 * true
    assert not done.warnings


def test_the_test_record_is_met_down_to_its_noise(done: Fit) -> None:
    test = done.comparisons[-1]
    assert test.tested
    assert test.rms("F", test.before) > 0.2
    assert test.rms("F", test.after) == pytest.approx(0.05, rel=0.1)


def test_the_network_of_a_fit_carries_its_values(done: Fit) -> None:
    values = done.network.dae().parameter_values
    assert {name: values[name] for name in TRUTH} == done.values
    assert rig().dae().parameter_values["spring.k"] == 1000.0


def test_a_fit_tells_in_a_table_in_json_and_in_a_picture(done: Fit, tmp_path: Path) -> None:
    assert "spring.k" in done.table()
    told = json.loads(done.to_json(tmp_path / "fit.json").read_text())
    assert told["parameters"]["spring.k"]["value"] == done.values["spring.k"]
    assert len(done.plot("F").axes) == 4


def test_offset_and_start_are_found_with_the_parameters() -> None:
    record = measured(Chirp(4e-3, 0.5, 6.0, 2.0), "pulled", pulled=5e-3)
    shifted = Record("shifted", record.time, {"x": record.values["x"], "F": record.values["F"] + 1.5})
    found = ia.fit(campaign(train=[{"record": shifted, "offset": ["F"]}], test=[]))
    for name, true in TRUTH.items():
        assert abs(found.values[name] - true) < 3.5 * found.errors[name]


@pytest.mark.parametrize("fixed", [{"s": 0.05}, {"s": -0.01, "v": 0.3}, {"a": 9.0}])
@pytest.mark.parametrize("shooting", [None, 0.5])
def test_where_a_record_begins_does_not_hang_on_what_the_model_fixes(
    fixed: dict[str, float], shooting: float | None
) -> None:
    record = measured(Chirp(4e-3, 0.5, 6.0, 2.0), "pulled", pulled=5e-3)
    train = [{"record": record} if shooting is None else {"record": record, "shooting": shooting}]
    model = rig().with_values(mass=ia.Mass(m=2.0, **fixed))
    found = ia.fit(Campaign(model, CHANNELS, PARAMETERS, train=train))
    for name, true in TRUTH.items():
        assert abs(found.values[name] - true) < 3.5 * found.errors[name]
    (compared,) = found.comparisons
    assert compared.rms("F", compared.after) == pytest.approx(0.05, rel=0.1)


def test_stages_fit_what_they_are_told_and_pass_it_on() -> None:
    stage: list[dict[str, Any]] = [
        {"parameters": ["rub.friction.f_c", "spring.k"], "filter": {"cutoff": 4.0, "order": 4}},
        {"parameters": ["spring.k", "spring.d"]},
    ]
    found = ia.fit(campaign(stage=stage))
    assert list(found.stages[0].optimum.values) == ["rub.friction.f_c", "spring.k"]
    assert found.values["rub.friction.f_c"] == pytest.approx(0.9, rel=0.25)
    assert found.values["spring.k"] == pytest.approx(1100.0, rel=0.02)


def test_multiple_shooting_finds_the_same() -> None:
    found = ia.fit(campaign(train=[{**campaign().train[0], "shooting": 0.5}], test=[]))
    assert found.values["spring.k"] == pytest.approx(1100.0, rel=0.01)
    assert len(found.stages[0].problem.blocks[0].pieces) == 4


def test_motion_is_predicted_from_force_when_the_source_is_exchanged() -> None:
    record = campaign().training[0].record
    drive = ia.identification.sampled(Sinusoid(1.0, 2.0), stop=2.0, rate=250.0, fade=0.3)
    pushed = rig().with_values(table=ia.Force())
    pushed.add(bar=ia.Mass(m=1.0))
    pushed.connect(pushed.bar.flange, pushed.table.flange)
    run = pushed.simulate(2.0, step=4e-3, inputs={"table.f": drive}, parameters=TRUTH)
    at = np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1
    noise = np.random.default_rng(0).normal(0, 1e-5, len(at))
    record = Record("pushed", drive.time, {"F": drive.values, "x": run["bar.s"][at] + noise})
    channels = {"F": {"input": "table.f"}, "x": {"output": "bar.s"}}
    found = ia.fit(Campaign(pushed, channels, PARAMETERS, train=[{"record": record, "initial": "rest"}]))
    for name, true in TRUTH.items():
        assert abs(found.values[name] - true) < 3.5 * found.errors[name]


def test_what_the_records_do_not_show_is_said() -> None:
    net = rig().with_values(spring=ia.SpringDamper(k=1100.0, d=5.0))
    record = measured(Sinusoid(2e-3, 0.5), "slow", noise=1.0)
    parameters = {"spring.d": {"rel": 0.3}, "mass.m": {"rel": 0.1}}
    found = ia.fit(Campaign(net, CHANNELS, parameters, train=[{"record": record}]))
    assert any("spring.d: the records say next to nothing" in warning for warning in found.warnings)


class Inline(Executor):
    """Runs what is submitted at once."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def test_starts_go_through_an_executor(tmp_path: Path) -> None:
    found = ia.fit(campaign(test=[]), starts=2, executor=Inline())
    assert len(found.starts) == 2
    assert found.values["spring.k"] == pytest.approx(1100.0, rel=0.01)


def test_ctrl_c_keeps_the_best_until_then() -> None:
    count = 0

    def interrupt(line: str) -> None:
        nonlocal count
        count += 1
        if count == 3:
            raise KeyboardInterrupt

    with pytest.raises(FitInterruptedError) as interrupted:
        ia.fit(campaign(test=[]), report=interrupt)
    found = interrupted.value.fit
    assert found.interrupted
    assert found.to_dict()["interrupted"]
    assert "interrupted" in found.table()
    assert any("interrupted" in warning for warning in found.warnings)
    assert abs(found.values["spring.k"] - 1100.0) < 90.0


@pytest.mark.parametrize("kind", ["smooth", "hybrid"])
def test_variations_agree_with_differences_of_runs(kind: str) -> None:
    net = rig()
    if kind == "smooth":
        friction = ia.CoulombFriction(f_c=0.5, regularised=0.01)
        net = net.with_values(rub=ia.SupportFriction(friction=friction))
    dae = net.dae()
    names = ["spring.k", "spring.d", "rub.friction.f_c", "mass.m"]
    options: dict[str, Any] = {
        "inputs": {"table.s_ref": Sinusoid(0.004, 2.0)},
        "step": 2e-3,
        "progress": False,
    }
    options |= {"rtol": 1e-10, "atol": 1e-12}
    run = ia.simulate(dae, 2.0, **options)
    slopes = ia.Variations(dae, ["spring.f"], names).along(run)[:, 0]
    times = np.linspace(0, 2, 1001)
    at = np.searchsorted(run.time, times + 1e-6, side="right") - 1
    for number, name in enumerate(names):
        value = dae.parameter_values[name]
        sides = []
        for sign in (1, -1):
            other = ia.simulate(dae, 2.0, parameters={name: value * (1 + sign * 1e-5)}, **options)
            sides.append(other["spring.f"][np.searchsorted(other.time, times + 1e-6, side="right") - 1])
        difference = (sides[0] - sides[1]) / (2e-5 * value)
        error = np.sqrt(np.mean((slopes[at, number] - difference) ** 2))
        assert error < 3e-3 * np.sqrt(np.mean(difference**2))


def test_a_start_that_follows_no_parameter_may_be_given() -> None:
    dae = rig().dae()
    run = ia.simulate(dae, 0.1, inputs={"table.s_ref": Sinusoid(0.004, 2.0)}, progress=False)
    states = len(dae.state_names)
    slopes = ia.Variations(dae, ["spring.f"], []).along(run, np.zeros((states, 0)))
    assert slopes.shape == (len(run.time), 1, states)
