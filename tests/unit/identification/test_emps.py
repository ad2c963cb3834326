"""The measured axis under its control loop: the fit of the closed loop meets the published figures."""

import importlib.util
import sys
from pathlib import Path
from typing import Any

import inertance as ia
import pytest
from inertance.identification import Campaign


def load_example() -> Any:
    path = Path(__file__).parents[3] / "examples" / "emps.py"
    spec = importlib.util.spec_from_file_location("emps_campaign", path)
    assert spec
    assert spec.loader
    module = sys.modules["emps_campaign"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


emps = load_example()
FILE = emps.DATA / emps.FILES["estimation"]


@pytest.mark.skipif(not FILE.is_file(), reason="no EMPS records: not checked is the fit under a control loop")
def test_the_published_parameters_lie_within_three_standard_errors() -> None:
    record = emps.load(FILE)
    network = emps.axis(record, emps.Parameters(m=90.0, d=220.0, f_0=-2.0, f_c=17.0))
    channels = {
        "qg": {"input": "dq_ref.u1", "unit": "m"},
        "qm": {"output": "carriage.s", "unit": "m"},
        "vir": {"output": "vir.y", "unit": "V"},
    }
    parameters = {
        "carriage.m": {"rel": 0.3},
        "viscous.d": {"rel": 0.5},
        "coulomb.friction.f_c": {"min": 0.0, "max": 60.0},
        "offset.f_constant": {"min": -20.0, "max": 20.0},
    }
    train = [{"file": str(FILE), "window": [0.0, 7.0]}]
    found = ia.fit(Campaign(network, channels, parameters, train, stage=[{"channels": ["vir"]}]))
    published = (emps.PUBLISHED.m, emps.PUBLISHED.d, emps.PUBLISHED.f_c, -emps.PUBLISHED.f_0)
    for name, value in zip(parameters, published, strict=True):
        assert abs(found.values[name] - value) < 3 * found.errors[name]
        assert found.errors[name] < 0.25 * value
