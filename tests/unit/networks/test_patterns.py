"""Every average takes several names, and patterns."""

from typing import Any

import inertance as ia
import numpy as np
import pandas as pd
import pytest


@pytest.fixture(scope="module")
def run() -> ia.Result:
    net = ia.Network(
        "two", wall=ia.Fixed(), spring=ia.Spring(k=90.0), body=ia.Mass(m=1.0, s=0.1, v=-0.3),
        link=ia.Spring(k=40.0), tail=ia.Mass(m=2.0), rub=ia.CoulombFriction(f_c=1.0),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.rub.flange_a)
    net.connect(net.spring.flange_b, net.body.flange, net.rub.flange_b, net.link.flange_a)
    net.connect(net.link.flange_b, net.tail.flange)
    return net.simulate(3.5, begin=0.5)


@pytest.mark.parametrize("what", ["mean", "rms", "std", "peak"])
def test_a_pattern_gives_what_each_name_gives(run: ia.Result, what: str) -> None:
    measure = getattr(run, what)
    window = {"begin": 1.0, "end": 2.25}
    found = measure("body.*", **window)
    assert {"body.s", "body.v", "body.a"} <= set(found.index)
    assert all(name.startswith("body.") for name in found.index)
    for name in found.index:
        assert found[name] == measure(name, **window)
    assert list(measure(["tail.v", "body.v", "tail.v"]).index) == ["tail.v", "body.v"]


def test_a_pattern_leaves_out_modes_but_a_list_of_names_does_not(run: Any) -> None:
    assert "rub.mode" not in run.rms("*").index
    assert "rub.f" in run.rms("rub.*").index
    with pytest.raises(ia.ModelError, match=r"'rub\.mode' of 'two' is a mode"):
        run.rms(["rub.f", "rub.mode"])


def test_shares_of_all_modes(run: Any) -> None:
    shares = run.share("*.mode", "stuck")
    assert dict(shares) == {"rub.mode": run.share("rub.mode", "stuck")}
    assert list(run.share("rub.*", "stuck").index) == ["rub.mode"]
    with pytest.raises(ia.UnknownNameError, match=r"no variable like '\*\.mode'"):
        run.share("*.mode", "molten")


def test_values_at_instants(run: ia.Result) -> None:
    row: Any = run.at("*.v", 1.75)
    assert row["tail.v"] == run.at("tail.v", 1.75)
    table = run.at(["body.v", "tail.*"], [0.5, 2.0, 3.5])
    assert isinstance(table, pd.DataFrame)
    assert list(table.index) == [0.5, 2.0, 3.5]
    np.testing.assert_array_equal(table["tail.s"], run.at("tail.s", [0.5, 2.0, 3.5]))


def test_records_take_patterns_too() -> None:
    record: Any = ia.Recorded(
        pd.DataFrame({"a.f": [1.0, 3.0], "b.f": [0.0, 0.0], "a.s": [0.0, 1.0]}, index=[0.0, 2.0])
    )
    assert dict(record.mean("*.f")) == {"a.f": 2.0, "b.f": 0.0}


@pytest.mark.parametrize("wrong", ["nothing.*", ["body.v", "nothing.*"]])
def test_a_pattern_that_matches_nothing_is_told(run: ia.Result, wrong: Any) -> None:
    for measure in (run.mean, run.rms, run.std, run.peak, run.share, lambda name: run.at(name, 1.0)):
        with pytest.raises(ia.UnknownNameError, match=r"'two' has no variable like 'nothing\.\*'"):
            measure(wrong)
