"""Limits of a campaign: units, faults and remedies, and campaigns without records."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Limit, Record


def rig() -> ia.Network:
    net = ia.Network("rig", table=ia.Position(), spring=ia.SpringDamper(k=1000.0, d=4.0), mass=ia.Mass(m=2.0))
    net.connect(net.table.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


CHANNELS = {
    "x": {"input": "table.s_ref", "unit": "mm"},
    "F": {"output": "spring.f", "unit": "kN"},
    "v": {"output": "mass.v", "unit": "m/s"},
}
NOISE = {"F": 1e-5, "v": 1e-4}


def campaign(limits: dict[str, Any], **changed: Any) -> Campaign:
    given = {"train": (), "noise": NOISE, "planned": True, **changed}
    return Campaign(rig(), CHANNELS, {"spring.k": {"rel": 0.1}}, limits=limits, **given)


def test_numbers_are_in_the_units_of_the_channel_and_texts_in_their_own() -> None:
    limits = {
        "duration": "0.5 min",
        "rate": 500,
        "x": {"travel": 5, "speed": "0.2 m/s", "acceleration": 3000, "band": [0.5, 8]},
        "F": {"force": 0.1, "amplitude": "50 N"},
        "v": {"speed": 0.3, "acceleration": "1 g"},
        "mass.s": {"travel": "8 mm"},
    }
    allowed = campaign(limits).allowed
    assert (allowed.duration, allowed.rate) == (30.0, 500.0)
    x, force, speed, path = (allowed.quantities[name] for name in ("x", "F", "v", "mass.s"))
    assert x.peaks == pytest.approx((5e-3, 0.2, 3.0))
    assert x.band == (0.5, 8.0)
    assert force.peaks[0] == pytest.approx(50.0)
    assert force.peaks[1:] == (np.inf, np.inf)
    assert speed.peaks[:2] == pytest.approx((0.3, 9.80665))
    assert path == Limit("mass.s", (path.peaks[0], np.inf, np.inf))
    assert path.peaks[0] == pytest.approx(8e-3)


@pytest.mark.parametrize(
    ("limits", "told"),
    [
        ({"x": {"travl": 5}}, "limits.x: there is no key 'travl'; did you mean 'travel'?"),
        ({"y": {"travel": 5}}, "limits.y: there is no channel or quantity of the model 'y'"),
        ({"mass.q": {"travel": 5}}, "did you mean 'mass"),
        ({"x": {"travel": "5 N"}}, "limits.x: travel 'N' measures N, the quantity of the model is in m"),
        (
            {"x": {"travel": "far"}},
            "x: travel must be a number [mm], or a text such as '2 mm', got 'far'",
        ),
        ({"x": {"travel": -5}}, "limits.x: travel must be above 0 mm, got -5"),
        (
            {"x": {"force": 5}},
            "limits.x: force is in N, and what is limited in m: give amplitude, travel",
        ),
        ({"x": {"band": [8, 0.5]}}, "got 8 to 0.5 Hz; the lower frequency comes first"),
        ({"x": {"band": 8}}, "limits.x: band must be [lowest, highest] in Hz, got 8"),
        ({"F": {"band": [1, 2]}}, "limits.F: band is of an input"),
        ({"x": 5}, "limits.x: a table of amplitude, travel, speed, acceleration, band is needed, got 5"),
        ({"duration": "long"}, "limits.duration: must be a number [s]"),
        (
            {"duration": 1, "x": {"travel": 5, "band": [0.2, 8]}},
            "no whole cycle in the 1 s; last at least",
        ),
        ({"rate": 10, "x": {"travel": 5, "band": [1, 8]}}, "8 Hz is too fast for 10 samples a second"),
    ],
)
def test_what_is_wrong_is_told_with_the_remedy(limits: dict[str, Any], told: str) -> None:
    with pytest.raises(ia.ModelError) as error:
        campaign(limits)
    assert told in str(error.value)


def test_all_that_is_wrong_with_a_quantity_is_told_at_once() -> None:
    with pytest.raises(ia.ModelError) as error:
        campaign({"x": {"travel": "5 N", "band": [8, 0.5]}})
    assert "measures N" in str(error.value)
    assert "comes first" in str(error.value)


def test_without_records_limits_and_noise_are_needed() -> None:
    with pytest.raises(ia.ModelError) as error:
        campaign({}, noise={"F": 1e-5})
    for told in ("duration [s] must be given", "an input must be limited, such as x = {", "noise.v:"):
        assert told in str(error.value)
    with pytest.raises(ia.ModelError, match="band = "):
        campaign({"duration": 5, "x": {"travel": 3}})
    with pytest.raises(ia.ModelError, match=r"limits\.x: give amplitude, travel"):
        campaign({"duration": 5, "x": {"band": [1, 3]}})


def test_a_fit_refuses_a_campaign_without_records() -> None:
    limits = {"duration": 5, "x": {"travel": 3, "band": [1, 3]}}
    with pytest.raises(ia.ModelError, match="at least one record is needed"):
        ia.fit(campaign(limits))
    with pytest.raises(ia.ModelError, match="at least one record is needed"):
        campaign(limits, planned=False)


def test_a_record_beyond_the_limits_is_noted() -> None:
    t = np.linspace(0, 6 * np.pi / 9, 401)
    x = 4e-3 * np.sin(9 * t)
    values = {"x": x, "F": 3 * np.sin(9 * t + 0.1), "v": np.cos(9 * t)}
    within = campaign({"x": {"travel": 5}}, train=[{"record": Record("run", t, values)}])
    beyond = campaign({"x": {"travel": 3}}, train=[{"record": Record("run", t, values)}])
    assert not any("beyond its limit" in note for note in within.notes)
    assert any("'x' went 4 mm from its middle, beyond its limit of 3 mm" in note for note in beyond.notes)
