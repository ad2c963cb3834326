"""Elastic rods and shafts: natural frequencies, waves and stiffness of a continuous bar; errors as told."""

from itertools import pairwise
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational

M, K = 2.0, 8e4


def bar(kind: str, turning: bool, count: int, d: float = 0.0) -> Any:
    options = {"modes" if kind == "Modal" else "segments": count}
    if turning:
        shaft: Any = rotational.ModalShaft if kind == "Modal" else rotational.LumpedShaft
        return shaft(J=M, c=K, d=d, **options)
    rod: Any = ia.ModalRod if kind == "Modal" else ia.LumpedRod
    return rod(m=M, k=K, d=d, L=0.7, **options)


def body(turning: bool, size: float) -> Any:
    return rotational.Inertia(J=size) if turning else ia.Mass(m=size)


def free(element: Any, turning: bool) -> ia.Network:
    """A bar between two bodies of next to no mass."""
    push = rotational.Torque() if turning else ia.Force()
    net = ia.Network("free", bar=element, left=body(turning, 1e-9), right=body(turning, 1e-9), push=push)
    net.connect(net.left.flange, net.bar.flange_a, net.push.flange)
    return net.connect(net.bar.flange_b, net.right.flange)


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize(("kind", "count"), [("Modal", 1), ("Modal", 5), ("Lumped", 1), ("Lumped", 8)])
def test_natural_frequencies_are_off_by_what_is_told(kind: str, count: int, turning: bool) -> None:
    element = bar(kind, turning, count)
    net = free(element, turning)
    system = ia.analysis.linearise(net, ["push.tau" if turning else "push.f"], [])
    found = np.sort(np.abs(np.imag(system.poles)))[::2]
    for mode in range(1, (count if kind == "Lumped" else count + 1) + 1):
        exact = mode * np.pi * np.sqrt(K / M)
        told = exact * (1 + element.frequency_error(mode))
        assert np.abs(found - told).min() < 1e-4 * told
    assert abs(element.frequency_error(1)) < (0.4 if count == 1 else 0.01)


@pytest.mark.parametrize("turning", [False, True])
def test_errors_fall_with_modes_and_with_the_square_of_segments(turning: bool) -> None:
    modal = [bar("Modal", turning, n).frequency_error(1) for n in (1, 2, 4, 8)]
    lumped = [bar("Lumped", turning, n).frequency_error(1) for n in (4, 8, 16)]
    assert all(a > b > 0 for a, b in pairwise(modal))
    assert all(3.9 < a / b < 4.1 for a, b in pairwise(lumped))


@pytest.mark.parametrize("kind", ["Modal", "Lumped"])
@pytest.mark.parametrize("turning", [False, True])
def test_a_shaken_bar_answers_as_a_continuous_one(kind: str, turning: bool) -> None:
    """Force at a driven end, the other on a body, against tan() of the wave equation with damping."""
    net = ia.Network("shaken", bar=bar(kind, turning, 60 if kind == "Lumped" else 8, d=3.0))
    net.add(drive=rotational.Position() if turning else ia.Position(), body=body(turning, 1.5))
    net.connect(net.drive.flange, net.bar.flange_a).connect(net.bar.flange_b, net.body.flange)
    through, across = ("tau", "phi_ref") if turning else ("f", "s_ref")
    system = ia.analysis.linearise(net, [f"drive.{across}"], [f"bar.flange_a.{through}"])
    f = np.array([1.0, 20.0, 47.0, 90.0, 130.0])
    s = 2j * np.pi * f
    stiffness = K + 3.0 * s
    beta = np.sqrt(-M * s**2 / stiffness)  # of a bar of unit length
    end = -1.5 * s**2
    ratio = end / (stiffness * beta)
    expected = -stiffness * beta * (np.tan(beta) + ratio) / (1 - ratio * np.tan(beta))
    assert system.response(f)[:, 0, 0] == pytest.approx(expected, rel=6e-3)


@pytest.mark.parametrize(("kind", "count"), [("Modal", 16), ("Lumped", 64)])
def test_a_pulse_runs_along_a_rod_and_doubles_at_its_free_end(kind: str, count: int) -> None:
    """By d'Alembert: v(t) = 2 f(t - sqrt(m/k))/sqrt(m k)."""
    t_wave = np.sqrt(M / K)
    width = 0.8 * t_wave
    at = np.linspace(0, 2 * t_wave, 2001)
    pulse = 100 * np.sin(np.pi * at / width) ** 2 * (at < width)
    run = free(bar(kind, False, count), False).simulate(
        1.9 * t_wave, step=t_wave / 200, inputs={"push.f": (at, pulse)}, rtol=1e-8,
        start={"right.s": 0.7, "left.s": 0.0},
    )  # fmt: skip
    expected = 2 * np.interp(run.time - t_wave, at, pulse, left=0.0) / np.sqrt(M * K)
    assert run["right.v"] == pytest.approx(expected, abs=0.01 * expected.max())


def test_modes_that_it_has_not_are_told() -> None:
    with pytest.raises(ia.ModelError, match="mode must be at most 4"):
        ia.ModalRod(m=1.0, k=1.0, modes=3).frequency_error(5)
    with pytest.raises(ia.ModelError, match="mode must be a whole number, at least 1"):
        rotational.LumpedShaft(J=1.0, c=1.0).frequency_error(0)
