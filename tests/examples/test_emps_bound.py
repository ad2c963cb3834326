"""examples/emps_bound.py: laws that are there are found, and what none explains of the measured axis."""

import importlib.util
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "emps_bound.py"


def load_example() -> Any:
    spec = importlib.util.spec_from_file_location("emps_bound", EXAMPLE)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


bound = load_example()
MEASURED = pytest.mark.skipif(
    not all((bound.emps.DATA / file).is_file() for file in bound.emps.FILES.values()),
    reason="no EMPS records: not checked is what no law of the motion explains of them",
)


def made(seed: int, waves: float) -> Any:
    """Return a motion of an axis of 95 kg whose dry friction of 20 N has waves along the travel."""
    t = np.arange(0, 20, 1e-3)
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, 2)
    q = 0.125 + 0.11 * np.sin(0.7 * t + phases[0]) + 0.01 * np.sin(2.9 * t + phases[1])
    v = np.gradient(q, 1e-3)
    a = np.gradient(v, 1e-3)
    side = np.tanh(v / bound.REST_SPEED)
    force = 95 * a + 200 * v + 20 * side * (1 + waves * np.sin(2 * np.pi * q / 0.04))
    motion = SimpleNamespace(q=q, v=v, a=a, force=force)
    motion.columns = lambda parts: bound.Motion.columns(motion, parts)
    return motion


def test_a_law_is_found_where_it_is_free_enough() -> None:
    found = bound.bounds(made(1, 0.5), made(2, 0.5))
    assert found["mass, viscous friction"][0] > 10
    assert 5 < found["and dry friction"][0] < 10
    assert found["and by position and direction"][0] < 1
    assert found["and by position and direction"][1] < 0.1


@MEASURED
def test_what_no_law_of_its_motion_explains_of_the_axis(monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    monkeypatch.setattr(sys, "argv", ["emps_bound.py"])
    bound.main()
    told = capsys.readouterr().out.splitlines()
    assert told[2].split() == ["and", "dry", "friction", "3.80", "N", "6.6%", "3.62", "N", "6.3%"]
    assert told[-1].split() == ["and", "all", "that", "3.26", "N", "5.6%", "2.37", "N", "4.1%"]
