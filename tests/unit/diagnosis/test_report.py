"""The report: one file, every section, nothing from outside, no error in a browser; and where a gap lies."""

import json
import re
import shutil
import subprocess
from base64 import b64decode
from copy import copy
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.edits import Insert
from inertance.diagnosis.effects.effect import EFFECTS, effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import sites_of
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.report.network_drawing import drawings, marks_of
from inertance.diagnosis.report.text import advice, code, ruled_out, screened_out
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.search.score_test import screen
from inertance.diagnosis.verdict.localisation import located, shares
from inertance.diagnosis.verdict.verdict import Evidence, Gap, Ranked, Verdict
from inertance.identification import Accuracy, Campaign, Record
from inertance.machines import Sinusoid

RATE, NOISE, SECONDS = 200.0, 2e-4, 4.0
SECTIONS = [
    "verdict", "force", "where", "gap", "signals", "residual", "ranking", "ruled-out", "correction", "next",
    "parameters", "notes",
]  # fmt: skip
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
PROBE = """
<script>
const place = document.getElementById("figure-record-0");
const spacing = () => { const x = place.data[0].x; return x.length + " points from " + x[0].toFixed(2); };
(async () => {
  const told = [places.filter((p) => p.querySelector(".main-svg")).length, spacing()];
  await Plotly.relayout(place, {"xaxis.range": [1, 1.5]});
  told.push(spacing());
  const select = document.querySelector("select");
  select.value = "record-1";
  select.dispatchEvent(new Event("change"));
  told.push(spacing());
  const wide = document.documentElement.scrollWidth <= window.innerWidth;
  told.push(wide ? "fits" : "too wide");
  told.push(performance.getEntriesByType("resource").map((entry) => entry.name));
  const probe = document.createElement("pre");
  probe.id = "probe";
  probe.textContent = JSON.stringify(told);
  document.body.append(probe);
})();
</script>
"""


def build(friction: float = 0.0) -> ia.Network:
    net = ia.Network(
        "oscillator",
        wall=ia.Fixed(),
        spring=ia.Spring(k=400.0),
        damper=ia.Damper(d=2.0),
        mass=ia.Mass(m=1.0),
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    if friction:
        net.add(rub=ia.CoulombFriction(f_c=friction))
        net.connect(net.wall.flange, net.rub.flange_a)
        net.connect(net.rub.flange_b, net.mass.flange)
    return net


def campaign(friction: float, k: float = 430.0, jam: float = 0.0) -> Campaign:
    """Return three runs of an oscillator that has friction, or whose sensor jumps about for a moment."""
    truth, rng = build(friction).dae(), np.random.default_rng(1)
    t = np.arange(int(SECONDS * RATE) + 1) / RATE
    records = []
    for number in range(3):
        f = np.arange(0.5, 8, 0.25)
        phases = rng.uniform(0, 2 * np.pi, len(f))
        force = np.sum(np.cos(2 * np.pi * np.outer(t, f) + phases) - np.cos(phases), axis=1)
        inputs = {"push.f": ia.Sampled(t, force)}
        run = ia.simulate(
            truth, SECONDS, inputs=inputs, parameters={"spring.k": k}, step=1 / RATE, progress=False
        )
        x = np.interp(t, run.time, run["mass.s"]) + NOISE * rng.standard_normal(len(t))
        x += jam * np.exp(-(((t - 2.1) / 0.08) ** 2)) * np.sin(2 * np.pi * 11 * t)
        records.append(
            {"record": Record(f"multisine <{number}>", t, {"F": force, "x": x}), "initial": "rest"}
        )
    return Campaign(
        build(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.1}, "damper.d": {"rel": 0.1}},
        train=records[:1],
        test=records[1:],
        noise={"x": NOISE},
    )


def verdict_of(word: str, evidence: Evidence, effects: tuple[Hypothesis, ...] = (), **more: Any) -> Verdict:
    def size(fitted: Refit) -> float:
        return float(np.sqrt(np.mean(np.concatenate([r["x"] for r in fitted.test]) ** 2)) * NOISE / 0.05)

    nominal, fitted, after = map(size, (evidence.nominal, evidence.refit, evidence.after))
    return Verdict(
        verdict=word,
        effects=effects,
        confidence=(0.97,) * len(effects),
        next_experiment=None,
        where=shares(evidence.screened),
        gap={"x": Gap(nominal, fitted, after, NOISE / 0.05, "m, NRMSE of the test runs", 0.05)},
        closed=0.99,
        parameters=evidence.after.parameters,
        network=evidence.campaign.network,
        evidence=evidence,
        **{"equivalent": (), "windows": {}, "ranking": (), **more},
    )


@pytest.fixture(scope="module")
def verdict() -> Verdict:
    """Return the verdict on friction that is missing."""
    rubbing = Study(campaign(friction=1.0), Accuracy())
    nominal = JointFit(rubbing, rubbing.campaign.start)
    start, base = nominal.seen(nominal.start), nominal.fitted()
    candidates = screen(rubbing, base.parameters)
    best = next(c for c in candidates if c.effect.kind == "coulomb_friction")
    placed = Hypothesis(best.effect, best.site, "coulomb_friction_1", best.values)
    after = JointFit(rubbing, base.parameters, [placed]).fitted()
    ranking = (
        Ranked("coulomb_friction", "damper", 0.99, 1e-5, after.effects[0].values),
        Ranked("stribeck_friction", "damper", 0.991, 1e-5),
        Ranked("friction_drift", "damper", 0.989, 1e-5),
        Ranked("position_ripple", "damper", 0.02, 0.4),
        Ranked("backlash", "damper", -0.1, 0.9),
    )
    evidence = Evidence(rubbing, start, base, after, tuple(candidates))
    return verdict_of("effect", evidence, after.effects, ranking=ranking)


@pytest.fixture(scope="module")
def jammed() -> Verdict:
    """Return the verdict on a sensor that jumps about for a moment."""
    jumping = Study(campaign(friction=0.0, k=400.0, jam=0.01), Accuracy())
    base = JointFit(jumping, jumping.campaign.start).fitted()
    candidates = tuple(screen(jumping, base.parameters))
    found = located(jumping, base, candidates)
    return verdict_of("unknown", Evidence(jumping, base, base, base, candidates), windows=found)


@pytest.fixture(scope="module")
def page(verdict: Verdict, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ia.diagnosis.write_report(verdict, tmp_path_factory.mktemp("report") / "gap.html")


class Sections(HTMLParser):
    """Collects sections in order, and every address and script."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str | None] = []
        self.addresses: list[str | None] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if tag == "section":
            self.found.append(given.get("id"))
        self.addresses += [given[key] for key in ("src", "href", "action") if key in given]


def test_one_file_with_every_section_in_order(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    read = Sections()
    read.feed(text)
    assert read.found == SECTIONS
    assert read.addresses == ["data:,"]
    assert "default-src 'none'" in text
    assert page.stat().st_size < 8e6


def test_numbers_are_those_of_the_verdict(page: Path, verdict: Verdict) -> None:
    text = page.read_text(encoding="utf-8")
    assert verdict.sentence in text
    assert f"{verdict.gap['x'].refit:.3%}" in text
    assert "multisine &lt;1&gt;" in text
    assert "multisine <1>" not in text
    for name, value in verdict.parameters.items():
        assert f"<td>{name}</td>" in text
        assert f"{value:.4g}</td>" in text


def test_samples_hold_what_was_measured(page: Path, verdict: Verdict) -> None:
    found = re.search(r'id="figures">(.*?)</script>', page.read_text(encoding="utf-8"), re.DOTALL)
    assert found is not None
    trace = json.loads(found[1])["record-0"]["data"][0]["samples"]
    whole = np.frombuffer(b64decode(trace["u2"]), "<u2")
    shown = trace["low"] + trace["size"] * whole / 65535
    record = verdict.evidence.campaign.testing[0].record
    assert np.abs(shown - record.values["x"]).max() < 1e-5 * np.ptp(record.values["x"])


def test_lines_make_the_corrected_network(verdict: Verdict) -> None:
    net = build()
    space: dict[str, Any] = {"net": net}
    exec("\n".join(code(verdict)), space)
    assert space["parameters"] == pytest.approx(verdict.parameters, rel=1e-5)
    assert net.dae().state_names == verdict.corrected().dae().state_names
    assert net.dae().parameter_values["coulomb_friction_1.f_c"] == pytest.approx(1.0, rel=0.03)


def test_what_was_ruled_out_is_told_with_a_reason(verdict: Verdict) -> None:
    told = {kind: why for kind, _, _, _, why in ruled_out(verdict)}
    assert told == {
        "stribeck_friction": "better than the verdict by no more than the scatter of the test runs",
        "friction_drift": "takes 0.10% less off than the verdict",
        "position_ripple": "no more than chance would do",
        "backlash": "makes the test runs worse",
    }
    screened = {kind: why for kind, _, _, why in screened_out(verdict)}
    assert "coulomb_friction" not in screened
    assert "mimic" in screened["viscous_damping"]


def test_guilty_site_and_what_was_added_are_marked(verdict: Verdict) -> None:
    assert marks_of(verdict) == {"damper": "coulomb friction", "coulomb_friction_1": "added"}
    drawn = "".join(drawings(verdict))
    assert drawn.count('stroke-width="3"') == 2


@pytest.mark.parametrize(("deviations", "marks"), [(2.5, {}), (3.5, {"spring": "k"})])
def test_a_parameter_is_marked_from_where_the_verdict_says_it_moved(
    jammed: Verdict, deviations: float, marks: dict[str, str]
) -> None:
    moved = {**jammed.evidence.campaign.start, "spring.k": 400.0 * (1 + 0.1 * deviations)}
    assert marks_of(replace(jammed, verdict="parameters", parameters=moved)) == marks


def test_site_within_parts_is_marked_at_every_depth(verdict: Verdict) -> None:
    rig = ia.machines.inerter_rig(ia.machines.ge_wang.planetary_inerter(regularised=0.1), Sinusoid(0.01, 3.0))
    site = next(site for site in sites_of(rig) if site.path == "inerter.screw.friction")
    placed = Hypothesis(effect_of("viscous_damping"), site, "viscous_damping_1", {"d": 1e-3})
    drawn = list(drawings(replace(verdict, network=rig, effects=(placed,), where={})))
    told = [re.findall(r'fill="#cc3311">([^<]*)<', figure) for figure in drawn if "<svg" in figure]
    assert sorted(told[0]) == ["added", "in screw.friction"]
    assert told[1:] == [["in friction"], ["viscous damping"]]


def test_lines_name_the_family_of_joined_elements() -> None:
    play = ia.parallel(gap=ia.rotational.ElastoBacklash(c=1.0, d=0.1, b=0.1), oil=ia.rotational.Damper(d=1.0))
    line = str(Insert("shaft.flange_b", "play", play))
    assert "gap=rotational.ElastoBacklash(" in line
    assert "oil=rotational.Damper(" in line


def test_what_is_inserted_within_a_part_is_drawn() -> None:
    inner = build().with_values(mass=ia.Mass(m=2.0))
    net = ia.Network("nested", rig=inner)
    net.insert(net.rig._parts["spring"].flange_b, play=ia.Backlash(k=1e6, d=100.0, eps=1e-3))
    assert net._repr_html_().count("<path") == 1
    alone = build()
    plain = alone._repr_html_().count("<path")
    alone.insert(alone.spring.flange_b, play=ia.Backlash(k=1e6, d=100.0, eps=1e-3))
    assert alone._repr_html_().count("<path") == plain + 1


def test_windows_and_band_of_a_moment(jammed: Verdict) -> None:
    found = jammed.windows
    assert {w["record"] for w in found["windows"]} == {e.name for e in jammed.evidence.campaign.experiments}
    for window in found["windows"]:
        assert 1.75 <= window["from"] < 2.1 < window["to"] <= 2.5
    assert sum(w["share"] for w in found["windows"]) > 0.8
    assert found["band"][0] < 11 < found["band"][1]
    assert found["regime"] == "any"
    assert "Hz" in advice(jammed)
    first, *others = json.loads(json.dumps(jammed.to_dict()))["where"]
    assert first["windows"] == found["windows"]
    assert not any("windows" in other for other in others)


def test_steady_gap_has_no_windows_of_its_own(verdict: Verdict) -> None:
    evidence = verdict.evidence
    found = located(evidence.study, evidence.refit, evidence.screened)
    assert [(w["from"], w["to"]) for w in found["windows"]] == [(0.0, SECONDS)] * 3
    assert found["band"][1] < 10


def test_gap_at_reversals_is_told_as_such(verdict: Verdict) -> None:
    evidence = verdict.evidence
    at = [np.abs(np.gradient(e.record.values["x"], 1 / RATE)) < 0.05 for e in evidence.campaign.experiments]
    missed = [{"x": 5.0 * slow.astype(np.float64)} for slow in at]
    shaped = replace(evidence.refit, train=missed[:1], test=missed[1:])
    assert located(evidence.study, shaped, evidence.screened)["regime"] == "reversals"


@pytest.mark.parametrize("word", ["none", "parameters", "unknown"])
def test_every_verdict_has_a_report(word: str, jammed: Verdict, tmp_path: Path) -> None:
    text = ia.diagnosis.write_report(replace(jammed, verdict=word), tmp_path / "gap.html").read_text(
        encoding="utf-8"
    )
    read = Sections()
    read.feed(text)
    assert read.found == [name for name in SECTIONS if name != "force"]
    assert f'class="verdict {word}"' in text


def test_effect_on_a_channel_has_a_report(verdict: Verdict, tmp_path: Path) -> None:
    delay = next(c for c in verdict.evidence.screened if c.effect.kind == "sensor_delay")
    placed = Hypothesis(effect_of("sensor_delay"), delay.site, "sensor_delay_1", {"delay": 0.004})
    text = ia.diagnosis.write_report(replace(verdict, effects=(placed,)), tmp_path / "gap.html").read_text(
        encoding="utf-8"
    )
    assert "# sensor_delay on channel x: delay = 0.004" in text
    assert "x: sensor delay" in text


def test_docs_list_every_effect_with_its_parameters() -> None:
    page = (Path(__file__).parents[3] / "docs" / "diagnosis.md").read_text(encoding="utf-8")
    rows = {row.split("`")[1]: row for row in page.splitlines() if row.startswith("| `")}
    for kind, effect in EFFECTS.items():
        names = {q.name for quantities in effect.quantities.values() for q in quantities}
        assert {name for name in names if f"`{name}`" not in rows.get(kind, page)} == set(), kind


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium to open the report in")
def test_browser_draws_it_without_error_or_network(page: Path, tmp_path: Path) -> None:
    probed = tmp_path / "gap.html"
    probed.write_text(
        page.read_text(encoding="utf-8").replace("</body>", f"{PROBE}</body>"), encoding="utf-8"
    )
    done = subprocess.run(
        [
            str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
            "--disable-component-update", "--window-size=500,900", f"--user-data-dir={tmp_path / 'profile'}",
            "--enable-logging=stderr", "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=5000",
            "--dump-dom", probed.as_uri(),
        ],
        capture_output=True, text=True, check=True, timeout=120,
    )  # fmt: skip
    assert [line for line in done.stderr.splitlines() if "CONSOLE" in line] == []
    found = re.search(r'<pre id="probe">(.*?)</pre>', done.stdout, re.DOTALL)
    assert found is not None, "the page's scripts failed"
    plots, whole, near, other, width, requests = json.loads(found[1])
    assert [address for address in requests if not address.startswith("data:")] == []
    assert plots == 7
    assert whole == other == "801 points from 0.00"
    assert near == "105 points from 0.99"
    assert width == "fits"


def test_figures_are_said_to_be_of_the_runs_they_are_of(verdict: Verdict) -> None:
    evidence = verdict.evidence
    alone = copy(evidence.campaign)
    alone.testing = []
    assert evidence.judged == "test runs"
    assert replace(evidence, study=replace(evidence.study, campaign=alone)).judged == "training runs"


def test_sentence_names_the_class(verdict: Verdict) -> None:
    assert "cannot tell" not in verdict.sentence
    tied = replace(verdict, equivalent=(("coulomb_friction", "spring"),))
    assert tied.sentence.endswith("These data cannot tell it from coulomb friction at spring.")
