"""How far shapes may change in a fit, and which of what was fitted counts."""

from dataclasses import replace

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.shaping import Shapes
from inertance.diagnosis.effects.sites import BETWEEN, Site
from inertance.diagnosis.search.choice import is_worth_it
from inertance.diagnosis.search.model_comparison import Refit, clearness, stretches
from inertance.diagnosis.search.round import Round, only_bends
from inertance.identification import Campaign, Record
from numpy.typing import NDArray

Array = NDArray[np.float64]
TRAVEL = 0.01
SITE = Site("guide", "translational", "guide.flange_b", "guide.flange_a", BETWEEN, travel=TRAVEL)


def hysteresis(s_y: float) -> Hypothesis:
    return Hypothesis(effect_of("hysteresis"), SITE, "hysteresis_1", {"k": 100.0, "s_y": s_y, "n": 2.0})


def test_a_shape_goes_on_from_where_it_is_held_within_what_is_screened() -> None:
    placed = hysteresis(2 * TRAVEL)
    wide = np.array([-5.0, 0.0, 0.0, 0.0]), np.array([5.0, np.inf, np.inf, np.inf])
    shapes = Shapes(wide, [placed], [placed.scales])
    bounds = shapes.bounds(np.array([0.0, 1.0, 1.0, 1.0]))
    assert bounds[0] == pytest.approx([-5.0, 0.0, 0.5, 0.5])  # yields less sharply, n = 1 at least
    assert bounds[1][:2] == pytest.approx([5.0, np.inf])
    assert shapes.are_held(np.array([0.0, 3.0, 0.5, 1.0]), bounds)
    assert not shapes.are_held(np.array([5.0, 0.0, 0.8, 0.5]), bounds)
    least = shapes.bounds(np.array([0.0, 1.0, 1e-9, 1.0]))[0][2]
    assert least == pytest.approx(0.5 * 0.04 / 2.0)
    near = shapes.bounds(np.array([0.0, 1.0, 1.5 * least, 1.0]))
    assert not shapes.are_held(np.array([0.0, 1.0, least, 1.0]), near)


def test_friction_that_rises_from_rest_is_no_stribeck_effect() -> None:
    credible = effect_of("stribeck_friction").credible
    assert credible({"f_c": 1.0, "f_s": 1.5, "v_s": 0.01})
    assert not credible({"tau_c": 1.0, "tau_s": 0.2, "w_s": 0.01})


def campaign() -> Campaign:
    net = ia.Network("rig", carriage=ia.Mass(m=1.0), push=ia.Force())
    net.connect(net.push.flange, net.carriage.flange)
    time = np.linspace(0, 4, 1001)
    first, second = (Record(f"run {w}", time, {"F": np.sin(w * time), "s": np.sin(w * time)}) for w in (8, 9))
    return Campaign(
        net,
        channels={"F": {"input": "push.f", "unit": "N"}, "s": {"output": "carriage.s", "unit": "m"}},
        parameters={"carriage.m": {"rel": 0.1}},
        train=[{"record": first, "initial": "rest"}],
        test=[{"record": second, "initial": "rest"}],
        noise={"s": 0.1},
    )


def white(rng: np.random.Generator) -> Array:
    """Return white noise of the test record that is just as strong as was thought."""
    noise = rng.standard_normal(1001)
    noise /= np.sqrt(np.mean(noise**2))
    return noise


def leaving(residual: Array, cost: float = 0.0) -> Refit:
    """Return a model that leaves so much of the test record."""
    blocks = stretches(campaign().testing)
    return Refit({}, (hysteresis(TRAVEL),), [], [{"s": residual}], cost, blocks, len(residual))


def test_an_overtone_alone_is_a_ripple_of_its_own() -> None:
    credible = effect_of("harmonic_ripple").credible
    names = [f"f_{wave}{n}" for n in ("", "_2", "_3") for wave in ("sin", "cos")]
    alone = dict.fromkeys(names, 0.0)
    assert credible(alone | {"f_sin": 1.0, "period": 0.01})
    assert credible(alone | {"f_sin_2": 1.0, "f_cos_3": 0.2, "period": 0.01})
    assert not credible(alone | {"f_sin_2": -3.77, "f_sin_3": -0.11, "period": 0.018})
    assert not credible(alone | {"f_cos_3": 1.0, "f_sin": 0.05, "period": 0.018})


@pytest.mark.parametrize(
    ("plain", "richer", "worth"), [(2.0, 1.9, False), (2.0, 1.6, True), (1.05, 1.0, True)]
)
def test_what_generalises_must_take_away_a_good_part_of_what_is_left(
    plain: float, richer: float, worth: bool
) -> None:
    rng = np.random.default_rng(0)
    noise = white(rng)

    def fitted(misfit: float) -> Refit:
        return leaving(misfit * noise + 0.01 * rng.standard_normal(len(noise)))

    assert is_worth_it(fitted(plain), fitted(richer)) is worth


@pytest.mark.parametrize(("left", "worth"), [(0.0, True), (2.0, False)])
def test_what_generalises_is_worth_it_if_nothing_is_left_but_noise(left: float, worth: bool) -> None:
    rng = np.random.default_rng(0)
    noise = white(rng)
    burst = np.where(np.arange(1001) < 50, 3.0, 0.0)

    plain, richer = leaving(noise + burst), leaving(noise + left / 3 * burst)
    assert clearness(plain, richer) < 3
    assert is_worth_it(plain, richer) is worth


@pytest.mark.parametrize(
    ("drop", "left", "worth"),
    [(90.0, 0.0, True), (10.0, 0.0, False), (-90.0, 0.0, False), (90.0, 0.4, False)],
)
def test_what_generalises_is_worth_it_if_all_records_tell_beside_mere_noise(
    drop: float, left: float, worth: bool
) -> None:
    """By test records alone it is not: few stretches tell, and little is left without it, too."""
    rng = np.random.default_rng(0)
    noise = white(rng)
    burst, hum = np.where(np.arange(1001) < 20, 2.5, 0.0), left * np.sin(np.arange(1001.0))

    plain, richer = leaving(noise + burst + hum, 1000.0), leaving(noise + 0.6 * burst + hum, 1000.0 - drop)
    assert clearness(plain, richer) < 3
    assert is_worth_it(plain, richer) is worth


def test_what_generalises_is_not_worth_it_where_noise_was_thought_to_be_larger() -> None:
    """Less than the noise that is told is left without it, so that it takes nothing away."""
    rng = np.random.default_rng(0)
    noise = 0.9 * rng.standard_normal(1001)

    for share in (0.01, -0.01):
        other = noise + share * rng.standard_normal(1001) - 0.5 * share**2 * noise
        assert not is_worth_it(leaving(noise), leaving(other))


def test_what_takes_nearly_all_away_is_not_worth_it_where_that_may_be_chance() -> None:
    rng = np.random.default_rng(0)
    noise = white(rng)
    few = np.where(np.arange(1001) < 20, 1.2, 0.0)

    plain, richer = leaving(noise + few, 20.0), leaving(noise)
    assert plain.misfit**2 - 1 > 4 * (richer.misfit**2 - 1)
    assert not is_worth_it(plain, richer)


def test_what_takes_nearly_all_away_is_worth_it_though_most_stretches_do_not_tell() -> None:
    rng = np.random.default_rng(0)
    noise = rng.standard_normal(1001)
    burst = np.where(np.arange(1001) < 200, 9.0, 0.0)

    plain, richer = leaving(noise + burst), leaving(1.1 * noise)
    assert clearness(plain, richer) < 3
    assert is_worth_it(plain, richer)


@pytest.mark.parametrize(
    ("found", "further", "bends"),
    [
        ("hysteresis", "presliding_friction", True),
        ("position_dependent_friction", "coulomb_friction", True),
        ("coulomb_friction", "position_dependent_friction", False),
        ("coulomb_friction", "cubic_damping", False),
    ],
)
def test_an_effect_may_only_bend_the_law_of_another_at_its_site(
    found: str, further: str, bends: bool
) -> None:
    here, there = (replace(hysteresis(TRAVEL).site, path=path) for path in ("rail", "belt"))
    one = Hypothesis(effect_of(found), here, "one", {})
    for site, wanted in ((here, bends), (there, False)):
        model = Refit({}, (one,), [], [], 0.0)
        other = Hypothesis(effect_of(further), site, "other", {})
        assert bool(only_bends(other, model, Round(model, [], []))) is wanted


@pytest.mark.parametrize(
    ("alone_here", "alone_there", "bends"),
    [(3.0, 3.5, True), (3.0, 5.0, False), (50.0, 51.0, False), (3.0, 70.0, False)],
)
def test_what_nearly_all_goes_by_at_two_sites_is_of_one_motion(
    alone_here: float, alone_there: float, bends: bool
) -> None:
    """A motor and its arm behind a stiff shaft; of equal hystereses at two carts, each alone takes a part."""
    here, there = (replace(hysteresis(TRAVEL).site, path=path) for path in ("motor", "arm"))
    one, other = (replace(hysteresis(TRAVEL), site=site, name=site.path) for site in (here, there))

    def leaving(share: float, *effects: Hypothesis) -> Refit:
        return Refit({}, effects, [], [{"s": np.full(100, np.sqrt(share))}], 0.0, [2], 100.0)

    alone = [leaving(alone_here, one), leaving(alone_there, other)]
    model = leaving(50.0, one)
    assert bool(only_bends(other, model, Round(leaving(100.0), [], alone))) is bends
    assert not only_bends(other, model, Round(leaving(100.0), [], alone[:1]))
