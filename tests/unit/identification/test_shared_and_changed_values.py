"""Parameters that share one value, and values that differ from record to record."""

import pickle
from collections.abc import Mapping
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.hypothesis import with_effects
from inertance.diagnosis.models.study import study_of
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

NOISE = 1e-5
CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}}
SHARED: dict[str, Any] = {
    "left.k": {"rel": 0.5},
    "right.spring.k": {"share": "left.k", "ratio": 2.0},
    "right.damper.d": {"rel": 0.3},
}
TRUTH = {"left.k": 130.0, "right.spring.k": 260.0, "right.damper.d": 5.0}


def model() -> ia.Network:
    strut = ia.Network("strut", spring=ia.Spring(k=150.0), damper=ia.Damper(d=4.0))
    net = ia.Network("rig", push=ia.Force(), mass=ia.Mass(m=2.0), wall=ia.Fixed(), left=ia.Spring(k=100.0))
    net.add(right=strut).connect(
        net.wall.flange, net.left.flange_a, net.right.spring.flange_a, net.right.damper.flange_a
    )
    net.connect(
        net.left.flange_b,
        net.right.spring.flange_b,
        net.right.damper.flange_b,
        net.mass.flange,
        net.push.flange,
    )
    return net


def measured(seed: int, **changed: float) -> Record:
    """Return a record that begins in motion, at 2 s of a run."""
    force = sampled(Multisine(rms=6.0, low=0.5, high=6.0, period=4.0, seed=seed), stop=6.0, rate=100.0)
    values = TRUTH | {name.replace("_", ".", 1): value for name, value in changed.items()}
    run = model().simulate(6.0, step=0.01, inputs={"push.f": force}, parameters=values)
    at = np.searchsorted(run.time, force.time + 1e-6, side="right") - 1
    x = run["mass.s"][at] + np.random.default_rng(seed).normal(0, NOISE, len(at))
    return Record(f"run {seed}", force.time, {"F": force.values, "x": x}).window(2.0, 6.0)


def campaign(parameters: Mapping[str, Any], *records: Mapping[str, Any], **more: Any) -> Campaign:
    return Campaign(model(), CHANNELS, parameters, records, noise={"x": NOISE}, **more)


def test_parameters_that_share_a_value_are_fitted_as_one() -> None:
    given = campaign(SHARED, {"record": measured(1)})
    assert given.notes == ["right.spring.k: begins at 200 N/m, with left.k, not at 150"]
    assert sorted(given.priors) == ["left.k", "right.damper.d"]
    found = ia.fit(pickle.loads(given.pickled()))
    assert found.values["left.k"] == pytest.approx(130.0, abs=0.02)
    assert found.errors["left.k"] < 0.01
    run = found.network.simulate(1.0, start={"mass.s": 0.01}, inputs={"push.f": 0.0})
    force = run["right.spring.f"] / run["left.f"]
    assert force == pytest.approx(2.0)
    model().dae()  # is left as it was
    assert model().right.spring.k == 150.0


def test_the_range_of_a_parameter_is_that_of_all_that_share_it() -> None:
    free = {"left.s_rel0": {"min": -1.0, "max": 1.0}, "left.k": {"share": "left.s_rel0", "ratio": -1000.0}}
    with pytest.raises(ia.ModelError, match=r"must be below|outside"):
        campaign({**free, "left.s_rel0": {"min": 0.5, "max": 1.0}}, {"record": measured(1)})
    prior = campaign(free, {"record": measured(1)}).priors["left.s_rel0"]
    assert (prior.min, prior.max) == (-1.0, 0.0)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ({"share": "left.q"}, r"share: the model has no parameter 'left\.q'; did you mean 'left\.k'\?"),
        ({"share": "right.spring.k"}, "share names the parameter itself"),
        ({"share": "right.damper.d"}, r"'right\.damper\.d' itself shares 'left\.k'; name one that stands"),
        ({"share": "left.k", "ratio": 0}, "ratio must not be 0"),
        ({"share": "left.k", "ratio": "2"}, "ratio must be a finite number, got '2'"),
        ({"share": "left.k", "rel": 0.1}, "there is no key 'rel'"),
        ({"share": 3}, "share must be a text in quotes, got 3"),
    ],
)
def test_what_cannot_be_shared_is_told(entry: dict[str, Any], told: str) -> None:
    parameters = {"left.k": {"rel": 0.1}, "right.damper.d": {"share": "left.k"}, "right.spring.k": entry}
    with pytest.raises(ia.ModelError, match=rf'parameters\."right\.spring\.k": .*{told}'):
        campaign(parameters, {"record": measured(1)})
    with pytest.raises(ia.ModelError, match=r"the model has no parameter 'right\.sprig\.k'"):
        campaign({"right.sprig.k": {"share": "left.k"}}, {"record": measured(1)})


def test_a_record_may_have_values_of_its_own() -> None:
    plain, heavy = {"record": measured(1)}, {"record": measured(2, mass_m=3.1), "values": {"mass.m": 3.1}}
    found = ia.fit(campaign(SHARED, plain, heavy, test=[{**heavy, "record": measured(3, mass_m=3.1)}]))
    assert found.values["left.k"] == pytest.approx(130.0, abs=0.02)
    assert all(c.rms("x", c.after) < 1.2 * NOISE for c in found.comparisons)


def test_a_diagnosis_keeps_what_is_shared_and_what_a_record_has_of_its_own() -> None:
    heavy = {"record": measured(2, mass_m=3.1), "values": {"mass.m": 3.1}}
    given = campaign(SHARED, {"record": measured(1)}, heavy)
    refit = JointFit(study_of(given, Accuracy(rtol=1e-7)), given.start).fitted()
    assert refit.misfit < 1.1
    assert refit.parameters["left.k"] == pytest.approx(130.0, abs=0.02)
    with_effect = with_effects(given.network, [])
    assert "right.spring.k" not in with_effect.dae().parameter_values


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"mas.m": 3.0}, r"has no parameter 'mas\.m' that can be set; did you mean 'mass\.m'\?"),
        ({"left.k": 3.0}, r"it is in \[parameters\], and one for all records"),
        ({"right.spring.k": 3.0}, r"no parameter 'right\.spring\.k' that can be set"),
        ({"mass.m": -1.0}, "m must be above 0 kg, got -1.0"),
        ({"mass.m": "3"}, r"must be a number \[kg\], got '3'"),
        (3.1, "values must be a table in braces, got 3.1"),
    ],
)
def test_values_that_a_record_cannot_have_are_told(values: Any, told: str) -> None:
    with pytest.raises(ia.ModelError, match=rf"\[\[train\]\] 1: .*{told}"):
        campaign(SHARED, {"record": measured(1), "values": values})
