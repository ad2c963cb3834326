"""Records of a machine after a change: what a campaign says of them, and how a fit predicts them."""

import pickle
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Fit, Record

CHANNELS = {
    "F": {"input": "push.f", "unit": "N"},
    "x": {"output": "mass.s", "unit": "m"},
}
NOISE = 1e-6
M, K, D = 2.0, 260.0, 3.0  # of the truth; the model has m = 2, k = 200, d = 2


def rig() -> ia.Network:
    net = ia.Network("rig", wall=ia.Fixed(), mass=ia.Mass(m=2.0), push=ia.Force(), spring=ia.Spring(k=200.0))
    net.add(damper=ia.Damper(d=2.0))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.mass.flange, net.spring.flange_b, net.damper.flange_b, net.push.flange)


def record(m: float = M, k: float = K, d: float = D, omega: float = 9.0, seed: int = 1) -> Record:
    """Return a record, from 3 to 7 s of a clock, of the steady answer to two sines and a free motion."""
    t = np.linspace(3.0, 7.0, 401)
    force, x = np.zeros_like(t), np.zeros_like(t)
    for w, size in ((omega, 4.0), (1.7 * omega, 3.0)):
        answer = size / (k - m * w**2 + 1j * d * w)
        force += size * np.cos(w * t)
        x += np.real(answer * np.exp(1j * w * t))
    own = np.sqrt(complex((d / (2 * m)) ** 2 - k / m)) - d / (2 * m)
    x += np.real(0.01 * np.exp(own * (t - 3.0)))
    x += NOISE * np.random.default_rng(seed).standard_normal(len(t))
    return Record(f"run {seed}", t, {"F": force, "x": x})


def campaign(*changed: dict[str, Any], **more: Any) -> Campaign:
    known = {"spring.k": {"rel": 0.3}, "damper.d": {"rel": 0.5}}
    return Campaign(
        rig(), CHANNELS, known, [{"record": record()}], noise={"x": NOISE}, counterfactual=changed, **more
    )


def after(found: Fit) -> list[float]:
    return [c.rms("x", c.after) / NOISE for c in found.comparisons if c.kind == "counterfactual"]


def test_each_kind_of_change_is_predicted_to_the_noise() -> None:
    heavy, soft = record(m=3.5, seed=2), record(m=1.5 * M, k=0.5 * K, seed=3)
    free, other = record(d=0.0, seed=4), record(k=500.0, d=1.0, seed=5)
    given = campaign(
        {"record": heavy, "set": {"mass.m": "3500 g"}},
        {"record": soft, "scale": {"spring.k": 0.5, "mass.m": 1.5}},
        {"record": free, "remove": ["damper"]},
        {"record": other, "exchange": {"spring": ia.Spring(k=500.0)}, "set": {"damper.d": 1.0}},
    )
    found = ia.fit(pickle.loads(given.pickled()))
    assert found.values["spring.k"] == pytest.approx(K, rel=1e-4)
    assert after(found) == pytest.approx([1.0] * 4, abs=0.15)
    assert [c.experiment.change.told(given.machine) for c in found.comparisons if c.experiment.change] == [
        "mass.m = 3.5 kg",
        "spring.k times 0.5; mass.m times 1.5",
        "without damper",
        "damper.d = 1 N.s/m; another spring: Spring(k=500.0)",
    ]
    told = [entry for entry in found.to_dict()["records"] if "change" in entry]
    assert told[0]["change"] == "mass.m = 3.5 kg"
    assert "counterfactual" in found.table()
    assert not [line for line in found.warnings if "after a change" in line]


def test_a_change_that_is_told_wrongly_is_seen_and_never_fitted() -> None:
    wrong = {"record": record(m=3.5, seed=2), "set": {"mass.m": 3.4}}
    plain, found = ia.fit(campaign()), ia.fit(campaign(wrong))
    assert found.values == plain.values
    assert after(found)[0] > 20.0
    assert any("run 2: x: after a change (mass.m = 3.4 kg) it is missed by" in w for w in found.warnings)


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "nothing": ({}, r"\[\[counterfactual\]\] 1: say what was changed: set, scale, remove, exchange"),
    "path": ({"set": {"mass.mm": 3.0}}, r'set."mass.mm": .* no parameter .*did you mean .mass.m.'),
    "unit": ({"set": {"mass.m": "3 N"}}, r'set."mass.m": .*measures'),
    "text": ({"set": {"mass.m": "heavy"}}, "is no number with a unit"),
    "range": ({"set": {"mass.m": -1.0}}, r'set."mass.m": '),
    "factor": ({"scale": {"spring.k": "x"}}, r'scale."spring.k" must be a number'),
    "both": ({"scale": {"mass.m": 2.0}, "set": {"mass.m": 2.0}}, "it is set, too"),
    "no part": ({"remove": ["dampr"]}, "no component 'dampr'; did you mean 'damper'"),
    "channel": ({"remove": ["push"]}, "channel 'F' is push.f, which goes with 'push'"),
    "gone": ({"remove": ["damper"], "scale": {"damper.d": 2.0}}, "no parameter 'damper.d'"),
    "exchanged": (
        {"exchange": {"spring": ia.Spring(k=1.0)}, "scale": {"spring.k": 2.0}},
        "'spring' is exchanged; give the new one that value",
    ),
    "component": ({"exchange": {"spring": 3.0}}, "must be 'path/to/file.py:function' or a component, got 3"),
    "key": ({"removed": ["damper"]}, "there is no key 'removed'; did you mean 'remove'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_changed_is_told(case: str) -> None:
    entry, told = WRONG[case]
    with pytest.raises(ia.ModelError, match=told):
        campaign({"record": record(seed=2), **entry})


def test_what_is_fitted_is_no_counterfactual() -> None:
    with pytest.raises(ia.ModelError, match=r"\[\[counterfactual\]\] 1: 'run 1' is also \[\[train\]\] 1"):
        campaign({"record": record(), "remove": ["damper"]})


def test_a_file_names_the_component_that_takes_the_place_of_another(tmp_path: Path) -> None:
    (tmp_path / "parts.py").write_text(
        "import inertance as ia\ndef stiff():\n    return ia.Spring(k=500.0)\n"
    )
    entry = {"record": record(k=500.0, seed=2), "exchange": {"spring": "parts.py:stiff"}}
    assert after(ia.fit(campaign(entry, base=tmp_path))) == pytest.approx([1.0], abs=0.15)
    with pytest.raises(ia.ModelError, match="has no function 'stif'"):
        campaign({**entry, "exchange": {"spring": "parts.py:stif"}}, base=tmp_path)
