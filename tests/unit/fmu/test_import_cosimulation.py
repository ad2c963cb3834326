"""FMUs as parts of networks: against the network that has everything in it."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import pytest
from inertance import (
    FMU,
    CoulombFriction,
    Fixed,
    FMUError,
    Force,
    Mass,
    ModelError,
    Network,
    PositionSensor,
    SpringDamper,
)
from inertance.fmu import CoupledRun, FMUBlock, FMUForce, FMUMotion, ForeignRun, cosimulate


class Make(Protocol):
    def __call__(self, model: str, *defines: str) -> Path: ...


def oscillator(path: Path, kind: str, **options: Any) -> CoupledRun:
    """A mass on the spring and damper of an FMU, k = 100 N/m, d = 3 N.s/m; the FMU counts in mm."""
    strut = FMUForce(path, position="s", velocity="v", force="F", kind=kind, parameters={"k": 0.1})
    net = Network("oscillator", wall=Fixed(), strut=strut, mass=Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.strut.flange_a)
    net.connect(net.strut.flange_b, net.mass.flange)
    return cosimulate(net, 2.0, rtol=1e-8, atol=1e-10, **options)


def error(run: CoupledRun) -> float:
    decay, w = 1.5, np.sqrt(100 - 1.5**2)
    exact = 0.1 * np.exp(-decay * run.time) * (np.cos(w * run.time) + decay / w * np.sin(w * run.time))
    return float(np.abs(run["mass.s"] - exact).max())


@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_a_force_and_its_order_of_convergence(make_fmu: Make, kind: str) -> None:
    path = make_fmu("spring")
    held = [error(oscillator(path, kind, communication_step=h, order=0, halving=False)) for h in (0.02, 0.01)]
    linear = [error(oscillator(path, kind, communication_step=h, halving=False)) for h in (0.02, 0.01)]
    assert linear[1] < 2e-3 * 0.1 < 0.1 * held[1]
    assert 1.6 < held[0] / held[1] < 3
    assert 3 < linear[0] / linear[1] < 5.5


def test_averages_are_over_time_and_of_the_network_exact_between_its_points(make_fmu: Make) -> None:
    run = oscillator(make_fmu("spring"), "CS", communication_step=0.05, halving=False)
    fine = oscillator(make_fmu("spring"), "CS", communication_step=0.005, halving=False)
    for measure in ("mean", "rms", "std", "peak"):
        coarse, exact = (getattr(each, measure)("mass.a") for each in (run, fine))
        assert coarse == pytest.approx(exact, rel=0.05, abs=0.02)
    t, square = fine.time, fine["mass.s"] ** 2
    assert fine.rms("mass.s") == pytest.approx(np.sqrt(np.trapezoid(square, t) / 2.0), rel=1e-3)
    assert len(fine.resample(0.01, "mass.s")) == 201
    spring = fine.fmus["strut"]
    assert spring.rms("F") == pytest.approx(fine.rms("strut.f"), rel=5e-3)
    assert spring.at("F", 1.0025) == pytest.approx(np.interp(1.0025, spring.time, spring["F"]))
    with pytest.raises(ModelError, match="t = 3 s is outside the run, 0 to 2 s"):
        fine.mean("mass.s", end=3.0)


def test_numbers_and_switches_of_an_fmu_are_averaged_over_time() -> None:
    run = ForeignRun("it", {"gear": "", "on": ""})
    for t, gear, on in ((0.0, 1, False), (1.0, 1, False), (1.0, 2, True), (4.0, 2, True)):
        run.record(t, [gear, on])
    assert run.mean("gear") == 1.75
    assert run.at("gear", [0.5, 1.0, 4.0]).tolist() == [1.0, 2.0, 2.0]
    assert run.share("on") == 0.75
    assert run.share("gear", 1) == 0.25


def test_the_step_error_is_told(make_fmu: Make) -> None:
    run = oscillator(make_fmu("spring"), "CS", communication_step=0.01)
    assert set(run.step_error) == {"strut.s_rel", "strut.f"}
    assert run.step_error["strut.s_rel"] == pytest.approx(0.75 * error(run), rel=0.3)
    assert run.stats["communication steps"] == 200
    assert run.fmus["strut"].unit("F") == "N"
    assert np.allclose(run.fmus["strut"]["F"], 100 * run["mass.s"] + 3 * run["mass.v"], rtol=1e-9, atol=1e-12)


def two_masses(path: Path, **options: Any) -> CoupledRun:
    body = FMUMotion(
        path, force="F", position="s", velocity="v", parameters={"m": 2.0}, start={"s": 0.1},
        kind=options.pop("kind"),
    )  # fmt: skip
    net = Network("split", wall=Fixed(), left=SpringDamper(k=50.0, d=1.0), body=body,
                  right=SpringDamper(k=20.0, d=1.0), mass=Mass(m=0.5, s=0.1))  # fmt: skip
    net.connect(net.wall.flange, net.left.flange_a)
    net.connect(net.left.flange_b, net.body.flange, net.right.flange_a)
    net.connect(net.right.flange_b, net.mass.flange)
    return cosimulate(net, 2.0, rtol=1e-8, atol=1e-10, **options)


@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_a_motion_against_the_whole(make_fmu: Make, kind: str) -> None:
    net = Network("whole", wall=Fixed(), left=SpringDamper(k=50.0, d=1.0), body=Mass(m=2.0, s=0.1),
                  right=SpringDamper(k=20.0, d=1.0), mass=Mass(m=0.5, s=0.1))  # fmt: skip
    net.connect(net.wall.flange, net.left.flange_a)
    net.connect(net.left.flange_b, net.body.flange, net.right.flange_a)
    net.connect(net.right.flange_b, net.mass.flange)
    whole = net.simulate(2.0, step=0.02, rtol=1e-10, atol=1e-12)
    errors = []
    for step in (0.02, 0.01):
        run = two_masses(make_fmu("body"), kind=kind, communication_step=step, halving=False)
        errors.append(np.abs(np.interp(whole.time, run.time, run["mass.s"]) - whole["mass.s"]).max())
    assert errors[1] < 2e-4 * 0.1 * 5
    assert 3 < errors[0] / errors[1] < 6


def test_a_signal_block_whose_events_end_steps(make_fmu: Make) -> None:
    """A mass pushed by a relay's output: x' = sign(s - 0.5 ...) switches when the mass passes zero."""
    net = Network(
        "relay", body=Mass(m=1.0, s=-0.55, v=1.0), sensor=PositionSensor(), relay=FMUBlock(make_fmu("relay"))
    )
    net.connect(net.body.flange, net.sensor.flange)
    net.connect(net.sensor.s, net.relay.u)
    run = cosimulate(net, 1.0, communication_step=0.1, halving=False)
    assert [event.time for event in run.events] == pytest.approx([0.55], abs=1e-9)
    assert run["relay.y"][-1] == pytest.approx(-0.55 + 0.45, abs=1e-9)
    assert 0.55 in np.round(run.time, 12)


def test_the_network_keeps_its_own_events(make_fmu: Make) -> None:
    body = FMUMotion(make_fmu("body"), force="F", position="s", velocity="v", start={"v": 1.0})
    net = Network("rubbing", body=body, rub=CoulombFriction(f_c=1.0), mass=Mass(m=0.5))  # fmt: skip
    net.connect(net.body.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.mass.flange)
    run = cosimulate(net, 1.0, communication_step=0.01, halving=False)
    stuck = 1.0 / (1.0 / 2.0 + 1.0 / 0.5)
    assert [event.target for event in run.network.events][-1] == "stuck"
    assert run.network.events[-1].time == pytest.approx(stuck, abs=0.01)
    assert run["mass.v"][-1] == pytest.approx(0.8, abs=0.01)


def test_two_fmus_go_back_to_the_first_event(make_fmu: Make) -> None:
    net = Network("two", a=Mass(m=1.0, s=-0.33, v=1.0), b=Mass(m=1.0, s=-0.37, v=1.0),
                  one=FMUBlock(make_fmu("relay")), two=FMUBlock(make_fmu("relay")),
                  at=PositionSensor(), bt=PositionSensor())  # fmt: skip
    net.connect(net.a.flange, net.at.flange)
    net.connect(net.b.flange, net.bt.flange)
    net.connect(net.at.s, net.two.u)
    net.connect(net.bt.s, net.one.u)
    run = cosimulate(net, 0.5, communication_step=0.1, halving=False)
    assert [event.time for event in run.events] == pytest.approx([0.33, 0.37], abs=1e-9)
    assert run["one.y"][-1] == pytest.approx(-0.37 + 0.13, abs=1e-9)
    assert run["two.y"][-1] == pytest.approx(-0.33 + 0.17, abs=1e-9)


def test_steps_of_one_size_only(make_fmu: Make, tmp_path: Path) -> None:
    path = tmp_path / "rigid.fmu"
    with zipfile.ZipFile(make_fmu("body")) as archive, zipfile.ZipFile(path, "w") as copy:
        for name in archive.namelist():
            copy.writestr(
                name, archive.read(name).replace(b'canHandleVariableCommunicationStepSize="true"', b"")
            )
    body = FMUMotion(path, force="F", position="s", velocity="v", kind="CS")
    net = Network(
        "two",
        a=Mass(m=1.0, s=-0.33, v=1.0),
        at=PositionSensor(),
        body=body,
        relay=FMUBlock(make_fmu("relay")),
        spring=SpringDamper(k=1.0, d=0.1),
        wall=Fixed(),
    )
    net.connect(net.a.flange, net.at.flange)
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.body.flange, net.spring.flange_b)
    net.connect(net.at.s, net.relay.u)
    cosimulate(net, 0.3, communication_step=0.1)
    with pytest.raises(FMUError, match=r"steps of one size only \(0\.1 s\) and cannot stop .* t = 0\.33 s"):
        cosimulate(net, 0.5, communication_step=0.1, halving=False)


def test_mistakes(make_fmu: Make) -> None:
    path = make_fmu("spring")
    with pytest.raises(FMUError, match=r"'k' \(it is parameter"):
        FMUForce(path, position="k", force="F")
    with pytest.raises(FMUError, match="'s' is in mm, where m/s belongs"):
        FMUForce(path, velocity="s", force="F")
    net = Network("free", mass=Mass(m=1.0), push=Force(f=1.0))
    net.connect(net.mass.flange, net.push.flange)
    with pytest.raises(ModelError, match="no FMU in it"):
        cosimulate(net, 1.0, communication_step=0.1)
    with pytest.raises(ModelError, match="communication_step must be above 0 s"):
        cosimulate(net, 1.0, communication_step=0.0)


def test_simulate_says_what_it_lacks(make_fmu: Make) -> None:
    net = Network(
        "alone", wall=Fixed(), strut=FMUForce(make_fmu("spring"), position="s", force="F"), mass=Mass(m=1.0)
    )
    net.connect(net.wall.flange, net.strut.flange_a)
    net.connect(net.strut.flange_b, net.mass.flange)
    with pytest.raises(ModelError, match=r"input 'strut\.f' \[N\] has no signal"):
        net.simulate(1.0)


def test_an_fmu_that_fails_within_a_network(make_fmu: Make) -> None:
    body = FMUMotion(
        FMU(make_fmu("body"), isolated=True), force="F", position="s", velocity="v", kind="CS",
        parameters={"fault": 1, "when": 0.05},
    )  # fmt: skip
    net = Network("n", body=body, spring=SpringDamper(k=1.0, d=0.1), wall=Fixed())
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.body.flange)
    with pytest.raises(FMUError, match="crashed in 'step': its process was killed by SIGSEGV"):
        cosimulate(net, 1.0, communication_step=0.02)
