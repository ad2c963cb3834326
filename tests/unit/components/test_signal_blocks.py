"""Blocks that choose, switch, look up and filter, against NumPy's and SciPy's own."""

from typing import Any, Literal

import inertance as ia
import numpy as np
import pytest
import scipy.signal
from inertance import signals
from scipy.interpolate import RegularGridInterpolator


def sine(f: float = 1.0, amplitude: float = 1.0, offset: float = 0.0) -> ia.Component:
    return signals.Sine(f=f, amplitude=amplitude, phase=0.3, offset=offset)


def fed(block: ia.Component, **sources: ia.Component) -> ia.Network:
    """Return a block whose inputs come from sources."""
    net = ia.Network("fed", block=block)
    for port, source in sources.items():
        net.add(**{f"source_{port}": source})
        net.connect(getattr(net, f"source_{port}").y, getattr(net.block, port))
    return net


PLAIN: list[tuple[Any, Any]] = [
    (signals.Max(), np.maximum),
    (signals.Min(), np.minimum),
    (signals.Feedback(), np.subtract),
]


@pytest.mark.parametrize(("block", "law"), PLAIN, ids=lambda x: type(x).__name__)
def test_two_signals_make_one(block: ia.Component, law: Any) -> None:
    run = fed(block.clone(), u1=sine(), u2=sine(2.3, 0.7)).simulate(2.0, begin=-0.5)
    assert run["block.y"] == pytest.approx(law(run["block.u1"], run["block.u2"]))
    assert run.events == []


def test_a_size_is_never_negative() -> None:
    run = fed(signals.Abs(), u=sine()).simulate(2.0)
    assert run["block.y"] == pytest.approx(np.abs(run["block.u"]))


def test_a_sign_changes_at_events() -> None:
    run = fed(signals.Sign(), u=sine()).simulate(2.0)
    sure = np.abs(run["block.u"]) > 1e-9
    assert (run["block.y"] == np.sign(run["block.u"]))[sure].all()
    crossings = [k / 2 - 0.3 / (2 * np.pi) for k in (1, 2, 3, 4)]
    assert [event.time for event in run.events] == pytest.approx([0.0, *crossings])
    assert fed(signals.Sign(), u=signals.Constant(k=0.0)).simulate(1.0)["block.y"][-1] == 0.0


def test_a_hysteresis_switches_at_two_levels() -> None:
    run = fed(signals.Hysteresis(uLow=-0.2, uHigh=0.5), u=sine()).simulate(1.2)
    on, off = (np.arcsin(0.5) - 0.3) / (2 * np.pi), (np.pi + np.arcsin(0.2) - 0.3) / (2 * np.pi)
    assert [event.time for event in run.events] == pytest.approx([on, off, on + 1])
    assert [event.target for event in run.events] == ["on", "off", "on"]
    high = fed(signals.Hysteresis(), u=signals.Constant(k=2.0)).simulate(1.0)
    assert high["block.y"][0] == 1.0


def test_on_and_off_are_numbers() -> None:
    net = fed(signals.Hysteresis(uLow=-0.2, uHigh=0.5), u=sine())
    net.add(level=signals.BooleanToReal(realTrue=3.0, realFalse=-1.0))
    net.connect(net.block.y, net.level.u)
    run = net.simulate(1.2)
    assert run["level.y"] == pytest.approx(np.where(run["block.mode"] == 1, 3.0, -1.0))
    assert set(run["level.y"].tolist()) == {3.0, -1.0}


def test_a_switch_passes_one_or_the_other() -> None:
    run = fed(signals.Switch(threshold=0.2), u1=sine(), u2=sine(0.7), u3=sine(3.0)).simulate(3.0)
    u1, u2, u3, y = (run[f"block.{name}"] for name in ("u1", "u2", "u3", "y"))
    sure = np.abs(u2 - 0.2) > 1e-9
    assert y[sure] == pytest.approx(np.where(u2 > 0.2, u1, u3)[sure])


def test_a_table_goes_straight_on_or_holds() -> None:
    table = ((-1.0, 2.0), (1.0, 3.0), (2.0, -1.0))
    for extrapolation in ("linear", "hold"):
        block = signals.CombiTable1D(table=table, extrapolation=extrapolation)
        run = fed(block, u=sine(amplitude=4.0)).simulate(1.0)
        u, (x, y) = run["block.u"], np.array(table).T
        expected = np.interp(u, x, y)
        if extrapolation == "linear":
            expected = np.where(u < -1, 2 + 0.5 * (u + 1), np.where(u > 2, -1 - 4 * (u - 2), expected))
        assert run["block.y"] == pytest.approx(expected)


@pytest.mark.parametrize("extrapolation", ["linear", "hold"])
def test_a_map_is_bilinear(extrapolation: Literal["linear", "hold"]) -> None:
    table = ((0, 0, 1, 4), (100, 10, 80, 3), (300, 5, 120, 7), (400, 1, 2, 3))
    block = signals.CombiTable2D(table=table, extrapolation=extrapolation)
    run = fed(block, u1=sine(1.0, 300.0, 250.0), u2=sine(1.7, 4.0, 2.0)).simulate(2.0)
    u1, u2 = run["block.u1"], run["block.u2"]
    if extrapolation == "hold":
        u1, u2 = np.clip(u1, 100, 400), np.clip(u2, 0, 4)
    values = np.array([row[1:] for row in table[1:]], dtype=float)
    beyond: Any = {"bounds_error": False, "fill_value": None}
    known = RegularGridInterpolator(([100, 300, 400], [0, 1, 4]), values, **beyond)
    assert run["block.y"] == pytest.approx(known(np.column_stack([u1, u2])))


def test_columns_of_a_time_table_go_their_own_way() -> None:
    data = signals.CombiTimeTable(table=((0.0, 1.0, 5.0), (2.0, 3.0, 4.0), (2.0, 0.0, 4.0)))
    net = ia.Network("data", data=data, first=signals.Integrator(), second=signals.Integrator())
    net.connect(net.data.column1.y, net.first.u).connect(net.data.column2.y, net.second.u)
    run = net.simulate(3.0)
    assert run["first.y"][-1] == pytest.approx(4.0)
    assert run["second.y"][-1] == pytest.approx(9.0 + 4.0)


POLYNOMIALS = [
    ((2.0, 3.0), (4.0, 5.0, 6.0)),
    ((2.0, -3.0, 1.0), (4.0, 5.0, 6.0)),
    ((3.0,), (0.5, 2.0)),
    ((2.0,), (4.0,)),
]


@pytest.mark.parametrize(("b", "a"), POLYNOMIALS)
def test_a_transfer_function_answers_a_step(b: tuple[float, ...], a: tuple[float, ...]) -> None:
    """Against its partial fractions: y = b0/a0 + sum r (exp(p t) - 1)/p."""
    net = fed(signals.TransferFunction(b=b, a=a), u=signals.Step(start_time=0.5, height=2.0))
    run = net.simulate(5.0, rtol=1e-9)
    t = np.where(run.time > 0.5, run.time - 0.5, 0.0)
    residues, poles, direct = scipy.signal.residue(b, a)
    expected = np.full(len(t), sum(direct), dtype=complex)
    for residue, pole in zip(residues, poles, strict=True):
        expected += residue * (np.exp(pole * t) - 1) / pole
    after = run.time > 0.5
    assert run["block.y"][after] == pytest.approx(2 * np.real(expected[after]), abs=1e-7)


def test_a_second_order_lag_rings() -> None:
    net = fed(signals.SecondOrder(k=2.0, w=3.0, D=0.2), u=signals.Constant(k=1.5))
    run = net.simulate(4.0, rtol=1e-10)
    t, wd = run.time, 3 * np.sqrt(1 - 0.04)
    expected = 3 * (1 - np.exp(-0.6 * t) * (np.cos(wd * t) + 0.6 / wd * np.sin(wd * t)))
    assert run["block.y"] == pytest.approx(expected, abs=1e-7)


def test_a_chirp_sweeps_down_and_goes_on() -> None:
    chirp = signals.Chirp(f_min=5.0, f_max=1.0, duration=2.0, start_time=0.5, amplitude=2.0, offset=0.1)
    run = ia.Network("source", chirp=chirp).simulate(4.0)
    t, y = run.time - 0.5, run["chirp.y"]
    sweep = 0.1 + 2 * scipy.signal.chirp(t, 5.0, 2.0, 1.0, phi=-90)
    inside = (t > 0) & (t < 2)
    assert y[inside] == pytest.approx(sweep[inside])
    assert y[t > 2] == pytest.approx(0.1 + 2 * np.sin(2 * np.pi * (t[t > 2] - 2.0 + 6.0)))
    assert (y[t < 0] == 0.1).all()


@pytest.mark.parametrize(
    ("block", "told"),
    [
        (
            signals.TransferFunction(b=(1.0, 2.0, 3.0), a=(1.0, 1.0)),
            "b has 3 coefficients; it may",
        ),
        (signals.TransferFunction(a=(0.0, 1.0)), "highest power of s first, the first not 0"),
        (signals.CombiTable2D(table=((0, 1), (1, 2))), r"first|rows of equal length"),
        (signals.CombiTable1D(table=((0, 1), (0, 2))), "u increasing"),
        (signals.CombiTimeTable(table=((0.0,),)), "times not decreasing"),
    ],
)
def test_a_bad_table_is_told(block: ia.Component, told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        ia.Network("bad", block=block.clone()).dae()
