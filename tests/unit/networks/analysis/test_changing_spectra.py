"""Spectrogram and order tracking: chirps, run-ups, and motions whose orders are known in closed form."""

from math import pi
from typing import Any

import inertance as ia
import numpy as np
import pandas as pd
import pytest
from inertance import rotational
from inertance.analysis import order_tracking, spectrogram
from matplotlib import pyplot

T = np.arange(2.0, 12.0, 2e-4)  # a record need not begin at 0 s


def recorded(**signals: Any) -> ia.Recorded:
    return ia.Recorded(pd.DataFrame(signals, index=T))


def test_a_chirp_shows_its_frequency_and_amplitude() -> None:
    """f = 20 Hz + 6 Hz/s t, falling, on a mean: the ridge follows it within a part of a line."""
    t = T - T[0]
    run = recorded(y=0.4 * np.sin(2 * pi * (80 * t - 3 * t**2)) - 5.0)
    told = spectrogram(run, "y", window=0.5)
    assert told.frequency[1] == pytest.approx(2.0, rel=1e-3)
    assert told.strongest() == pytest.approx(80 - 6 * (told.time - T[0]), abs=0.1)
    assert told.amplitude[2:].max(axis=0) == pytest.approx(
        0.4, rel=0.25
    )  # smeared over 3 Hz, and between lines
    assert told.amplitude[0] == pytest.approx(5.0, rel=1e-3)
    assert told.time[0] == pytest.approx(T[0] + 0.25, abs=1e-3)
    assert told.time[-1] <= T[-1] - 0.249


def test_two_lasting_sines_show_as_they_are() -> None:
    run = recorded(y=2.0 * np.cos(2 * pi * 25 * T) + 0.5 * np.sin(2 * pi * 60 * T))
    told = spectrogram(run, "y", window=1.0)
    lines = {round(float(f)): told.amplitude[k] for k, f in enumerate(told.frequency)}
    assert lines[25] == pytest.approx(2.0, rel=1e-6)
    assert lines[60] == pytest.approx(0.5, rel=1e-6)
    assert told.amplitude[30:55].max() < 1e-6


def test_a_rate_of_ones_own_folds_what_lies_above_its_half() -> None:
    run = recorded(y=np.sin(2 * pi * 90 * T))
    assert spectrogram(run, "y", 1.0, rate=1000.0).strongest() == pytest.approx(90.0, abs=1e-3)
    assert spectrogram(run, "y", 1.0, rate=100.0).strongest() == pytest.approx(10.0, abs=1e-2)


def test_the_response_of_an_oscillator_to_a_sweep_follows_its_gain() -> None:
    """A run, not a table: a slow sweep through 8 Hz; the ridge follows the drive, as high as the gain."""
    w0, zeta, rate = 2 * pi * 8.0, 0.02, 0.25
    net: Any = ia.Network(
        "swept", wall=ia.Fixed(), link=ia.SpringDamper(k=w0**2, d=2 * zeta * w0), mass=ia.Mass(m=1.0),
        push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.link.flange_a)
    net.connect(net.link.flange_b, net.mass.flange, net.push.flange)
    t = np.linspace(0.0, 24.0, 24_001)
    drive = w0**2 * np.sin(2 * pi * (5 * t + rate / 2 * t**2))
    run = net.simulate(24.0, step=2e-3, inputs={"push.f": (t, drive)})
    told = spectrogram(run, "mass.s", window=1.0)
    settled = told.time > 6.0
    off = np.abs(told.time - 12.0) > 4.5  # where free vibration has died
    f = 5 + rate * told.time
    assert told.strongest()[settled & off] == pytest.approx(f[settled & off], abs=0.15)
    r = f / 8.0
    gain = 1 / np.abs(1 - r**2 + 2j * zeta * r)
    height = told.amplitude[2:].max(axis=0) / gain  # up to 15 % lower between two lines of a Hann window
    assert (height[settled & off] > 0.8).all()
    assert (height[settled & off] < 1.1).all()


def test_orders_of_a_run_up_are_what_they_were_made_of() -> None:
    """Orders 3 and 7.5 of an accelerating shaft: constant amplitudes at any speed, at one order each."""
    t = T - T[0]
    phi = 5 * t + 4 * t**2
    told = order_tracking(
        recorded(phi=phi, y=2 * np.sin(3 * phi) + 0.7 * np.cos(7.5 * phi)), "y", "phi", highest=10
    )
    assert told.track(3.0) == pytest.approx(2.0, rel=2e-3)
    assert told.track(7.5) == pytest.approx(0.7, rel=2e-3)
    assert told.track(5.0).max() < 5e-3
    assert told.strongest() == pytest.approx(3.0, abs=1e-3)
    middle = np.interp(told.time, T, phi)
    ends = [np.sqrt(25 + 16 * (middle + side * 8 * pi)) for side in (-1, 1)]  # w^2 = w_0^2 + 2 a phi
    assert told.speed == pytest.approx((ends[0] + ends[1]) / 2, rel=1e-3)


def test_a_shaft_that_turns_backward_and_slows_down_has_the_same_orders() -> None:
    t = T - T[0]
    phi = -(90 * t - 4 * t**2) + 1.0
    told = order_tracking(recorded(phi=phi, y=np.sin(2 * phi)), "y", "phi", highest=4)
    assert told.track(2.0) == pytest.approx(1.0, rel=2e-3)
    assert (told.speed < 0).all()
    assert told.speed[0] == pytest.approx(-87, rel=0.05)


def test_a_ripple_keeps_its_order_through_a_run() -> None:
    """A ripple of 12 waves a turn on a shaft that is run up: 0.3 N.m at order 12, by speed and angle."""
    net: Any = ia.Network(
        "run-up",
        ground=rotational.Fixed(),
        drive=rotational.Speed(),
        cogging=rotational.Ripple(period=2 * pi / 12, tau_sin=0.3, tau_cos=0.0),
    )
    net.connect(net.ground.flange, net.cogging.flange_a).connect(net.cogging.flange_b, net.drive.flange)
    run = net.simulate(6.0, step=5e-4, inputs={"drive.w_ref": lambda t: 20.0 + 15.0 * t})
    for shaft in ("drive.w", "cogging.phi_rel"):
        told = order_tracking(run, "drive.flange.tau", shaft, turns=6, highest=16)
        assert told.unit == "N.m"
        assert told.strongest() == pytest.approx(12.0, abs=2e-3)
        assert told.track(12.0) == pytest.approx(0.3, rel=5e-3)


def test_pictures_carry_units() -> None:
    pyplot.switch_backend("Agg")
    t = T - T[0]
    run = recorded(phi=9 * t + t**2, y=np.sin(3 * (9 * t + t**2)))
    figure = order_tracking(run, "y", "phi", highest=5).plot()
    assert figure.axes[0].get_xlabel() == "speed [rad/s]"
    assert figure.axes[0].get_ylabel() == "order"
    steady = order_tracking(recorded(phi=9 * T, y=np.sin(27 * T)), "y", "phi", highest=5)
    assert steady.plot().axes[0].get_xlabel() in ("time [s]", "speed [rad/s]")
    figure = spectrogram(run, "y", 1.0).plot()
    assert figure.axes[0].get_ylabel() == "frequency [Hz]"
    pyplot.close("all")


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda run: spectrogram(run, "y", 11.0), "at most as long as 'table', 9.9998 s; got 11 s"),
        (lambda run: spectrogram(run, "y", 1e-3), "at least 8 samples"),
        (lambda run: spectrogram(run, "x", 1.0), "'x'"),
        (lambda run: spectrogram(run, "y", 1.0, rate=1e9), "over 1e[+]07 samples"),
        (lambda run: order_tracking(run, "y", "swinging"), "stands or turns back at"),
        (lambda run: order_tracking(run, "y", "phi", turns=1.0), "at least 2, and 'phi' of 'table' makes"),
        (lambda run: order_tracking(run, "y", "phi", turns=1e4), "do not fit"),
        (lambda run: order_tracking(run, "y", "phi").track(99.0), "the orders end at 20"),
    ],
)
def test_what_cannot_be_told_is_refused(call: Any, told: str) -> None:
    with pytest.raises(ia.InertanceError, match=told):
        call(recorded(y=np.sin(T), phi=12 * T, swinging=np.sin(T)))


def test_a_force_is_no_shaft() -> None:
    net: Any = ia.Network("coasting", mass=ia.Mass(m=1.0, v=1.0))
    with pytest.raises(ia.ModelError, match=r"'mass.v' of 'coasting' is in m/s; name the angle \[rad\]"):
        order_tracking(net.simulate(1.0), "mass.s", "mass.v")
