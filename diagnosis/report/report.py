"""The report of a verdict: one HTML file with everything in it, plotly included."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from pathlib import Path
from string import Template

from ...base import check_output, demand, instance, rate_unit, write_text
from ...networks import pretty_unit
from ..criteria import MOVED_STANDARD_DEVIATIONS
from ..verdict.localisation import moved
from ..verdict.ranked import Ranked
from ..verdict.verdict import Verdict
from .figures import MEASURED_COLOUR, STAGE_COLOURS, Figure, Stages, bars, clouds, over_time, spectra
from .force_section import force_blocks, force_title
from .network_drawing import drawings
from .text import (
    advice,
    believed,
    chance,
    code,
    conclusion,
    deviations,
    methods,
    number,
    ruled_out,
    screened_out,
)

FOLDER = Path(__file__).parent
PAGES = (".html", ".htm")
Rows = Sequence[Sequence[str]]


def write_report(verdict: Verdict, path: str | Path) -> Path:
    """Write the report of a verdict, one HTML file that needs nothing else, and return its path.

    Args:
        verdict: of `diagnose`.
        path: of the file, .html or .htm.

    Raises:
        ModelError: for what is no verdict or no page.
        OutputError: if the file cannot be written.
    """
    demand("write_report()", verdict=(verdict, instance(Verdict)))
    from plotly.offline import get_plotlyjs

    check_output(path, PAGES)
    figures = dict[str, Figure]()
    body = "\n".join(_sections(verdict, figures))
    page = Template((FOLDER / "report.html").read_text(encoding="utf-8"))
    return write_text(
        path,
        page.substitute(
            title=escape(f"Sim-to-real gap of {verdict.network.name}"),
            css=(FOLDER / "report.css").read_text(encoding="utf-8"),
            js=(FOLDER / "report.js").read_text(encoding="utf-8"),
            plotly=get_plotlyjs(),
            body=body,
            figures=json.dumps(figures, separators=(",", ":")).replace("</", "<\\/"),
        ),
    )


def _sections(verdict: Verdict, figures: dict[str, Figure]) -> Iterator[str]:
    evidence = verdict.evidence
    stages = {"nominal": evidence.nominal, "refit": evidence.refit}  # by what they are called in the report
    if evidence.after is not evidence.refit:
        stages[_last_stage(verdict)] = evidence.after
    told = "".join(f"<p>{escape(line)}</p>" for line in conclusion(verdict))
    yield f'<section id="verdict" class="verdict {verdict.verdict}">{told}</section>'
    force = "".join(_force(verdict, figures))
    if force:
        yield _section("force", force_title(verdict), [force])
    yield _section("where", "Where", drawings(verdict))
    yield _section("gap", "Gap before and after", _gap(verdict, stages, figures))
    if verdict.counterfactual:
        yield _section("counterfactual", "The machine after a change", _counterfactual(verdict))
    yield _section("signals", "Measured and simulated", _signals(verdict, stages, figures))
    yield _section("residual", "What is left, before and after", _residual(verdict, stages, figures))
    yield _section("ranking", "Ranking", _ranking(verdict))
    yield _section("ruled-out", "Ruled out", _ruled_out(verdict))
    yield _section("correction", "The correction", _correction(verdict))
    yield _section("next", "What to measure next", [f"<p>{escape(advice(verdict))}</p>"])
    yield _section("parameters", "Parameters", _parameters(verdict))
    notes = [*verdict.notes, *evidence.campaign.notes, *methods(verdict)]
    yield _section("notes", "Notes", ["<ul>", *(f"<li>{escape(note)}</li>" for note in notes), "</ul>"])


def _section(name: str, title: str, blocks: Iterator[str] | Sequence[str]) -> str:
    return f'<section id="{name}"><h2>{title}</h2>{"".join(blocks)}</section>'


def _last_stage(verdict: Verdict) -> str:
    """Return what the model with all that was found is called."""
    if verdict.law is not None:
        return "with the law"
    return "with the effect" if verdict.effects else "with the best candidate"


def _force(verdict: Verdict, figures: dict[str, Figure]) -> Iterator[str]:
    for block in force_blocks(verdict):
        yield block if isinstance(block, str) else _figure(*block, figures)


def _gap(verdict: Verdict, stages: Stages, figures: dict[str, Figure]) -> Iterator[str]:
    campaign, runs = verdict.evidence.campaign, verdict.evidence.judged
    yield f"<p>Root mean square of what the model misses on the {runs}, over that of the noise.</p>"
    yield _figure("gap", bars(verdict, stages), figures, width=220 + 160 * len(verdict.gap))
    rows = []
    for name, gap in verdict.gap.items():
        values = [gap.nominal, gap.refit, gap.after][: len(stages)]
        unit = pretty_unit(campaign.measured[name].si)
        cells = [f"{value:.3%}<br>{number(value * gap.size)} {unit}" for value in (*values, gap.floor)]
        rows.append([escape(name), *cells, escape(gap.left)])
    yield _table(["channel", *stages, "noise", "left"], rows, numbers=range(1, len(stages) + 2))
    yield '<p class="faint">First line: share of the root mean square of the measured signal about its mean '
    yield "(NRMSE). "
    closed = f" Closed: {verdict.closed:.1%} of what lies between refit and noise." if verdict.missing else ""
    yield f"Second line: in the unit of the channel.{closed}</p>"


def _counterfactual(verdict: Verdict) -> Iterator[str]:
    yield "<p>Records of the machine after a change, none of them fitted: what the refitted model and the "
    yield "verdict's network miss, as a share of the signal's root mean square about its mean (NRMSE).</p>"
    rows = []
    for one in verdict.counterfactual:
        told = [escape(text) for text in (one.record, one.channel, one.change)]
        shares = ["–" if value is None else f"{value:.3%}" for value in (one.refit, one.after, one.floor)]
        over = "–" if one.over_noise is None else number(one.over_noise)
        rows.append([*told, *shares, over, escape(one.problem)])
    headers = ["record", "channel", "change", "refit", "after", "noise", "after over noise", ""]
    yield _table(headers, rows, range(3, 7))
    yield from (f"<p>{escape(one.told)}.</p>" for one in verdict.parted)


def _signals(verdict: Verdict, stages: Stages, figures: dict[str, Figure]) -> Iterator[str]:
    keys = {f"record-{n}": record for n, record in enumerate(over_time(verdict, stages))}
    figures |= {key: figure for key, (_, figure) in keys.items()}
    yield "<p>Drag over a stretch to look closer (on a touch screen, choose the magnifier first); a double "
    yield "click shows all again. The grey band is twice the noise.</p>"
    options = "".join(f'<option value="{key}">{escape(name)}</option>' for key, (name, _) in keys.items())
    yield f'<p><label>Record <select data-shows="figure-record-0">{options}</select></label></p>'
    yield _figure("record-0", figures["record-0"], figures)


def _residual(verdict: Verdict, stages: Stages, figures: dict[str, Figure]) -> Iterator[str]:
    evidence, campaign = verdict.evidence, verdict.evidence.campaign
    leading = [placed.site.path for placed in verdict.effects]
    if verdict.sought is not None and not leading:
        leading = [verdict.sought.missing.site.path]
    elif not leading and verdict.verdict == "unknown":
        leading = list(verdict.where)
    place = next((c.site for c in evidence.screened if c.site.path in leading[:1]), None)
    motions, units = [], ("", "", "")
    if place is not None:
        motions = moved(evidence.study, evidence.refit, place, evidence.study.judged)
        if place.domain == "channel":
            si = campaign.measured[place.path].si
            units = si, rate_unit(si), rate_unit(si, 2)
        else:
            units = place.mechanics.motion_units
    shown = [*zip(stages, STAGE_COLOURS, strict=False)][-2:]
    colours = [*shown, ("noise (dashed)", MEASURED_COLOUR)]
    key = (f'<span><i style="background:{colour}"></i>{escape(name)}</span>' for name, colour in colours)
    yield f'<p class="key">{"".join(key)}</p>'
    at = f" against how {escape(place.path)} moves in the refitted model and" if place is not None else ""
    yield f"<p>Measured minus simulated{at} over frequency; thick lines are means. Over time it stands "
    yield "above.</p>"
    for name in campaign.outputs:
        yield f'<h3>{escape(name)}</h3><div class="grid">'
        plots = {**clouds(verdict, stages, name, motions, units), "frequency": spectra(verdict, stages, name)}
        for against, figure in plots.items():
            yield _figure(f"{against}-{campaign.outputs.index(name)}", figure, figures)
        yield "</div>"


def _ranking(verdict: Verdict) -> Iterator[str]:
    if not verdict.ranking:
        yield "<p>No effect was worth a fit.</p>"
        return
    yield "<p>Effects that were fitted together with the parameters, by what they take off the squared "
    yield f"residual of the {verdict.evidence.judged}; p is the chance of as much without the effect.</p>"
    yield _ranked(verdict.ranking, [placed.key for placed in verdict.effects])
    if verdict.further:
        yield "<p>On top of what was found, of what that leaves:</p>"
        yield _ranked(verdict.further)


def _ranked(ranking: Sequence[Ranked], chosen: Sequence[tuple[str, str]] = ()) -> str:
    marked = [n for n, ranked in enumerate(ranking) if (ranked.kind, ranked.site) in chosen]
    rows = []
    for n, ranked in enumerate(ranking, start=1):
        gain, told = f"{ranked.test_gain:.2%}", escape(ranked.parameters)
        rows.append([str(n), _kind(ranked.kind), escape(ranked.site), gain, chance(ranked.p), told])
    return _table(["", "effect", "site", "test gain", "p", "parameters"], rows, (0, 3, 4), marked)


def _ruled_out(verdict: Verdict) -> Iterator[str]:
    if verdict.verdict == "interrupted":
        yield "<p>Nothing: the diagnosis was stopped before its end.</p>"
        return
    fitted = [
        [_kind(k), escape(s), f"{gain:.2%}", chance(p), why] for k, s, gain, p, why in ruled_out(verdict)
    ]
    if fitted:
        yield "<h3>After a fit</h3>"
        yield _table(["effect", "site", "test gain", "p", "why"], fitted, (2, 3))
    screened = [[_kind(kind), escape(site), gain, why] for kind, site, gain, why in screened_out(verdict)]
    if screened:
        yield "<h3>On screening, at the best of all sites, or by a fit that came to nothing</h3>"
        yield _table(["effect", "site", "gain", "why"], screened, (2,))
        yield '<p class="faint">Gain: the share of the squared residual of the training runs that it would '
        yield "take off, by the one-sided score test, beyond what the parameters can.</p>"
    if not fitted and not screened:
        yield "<p>Nothing was screened.</p>"


def _correction(verdict: Verdict) -> Iterator[str]:
    lines = escape("\n".join(code(verdict)))
    yield "<p>For the network <code>net</code> of this campaign:</p>"
    yield '<div class="code"><button type="button" data-copies="lines">Copy</button>'
    yield f'<pre id="lines">{lines}</pre></div>'


def _parameters(verdict: Verdict) -> Iterator[str]:
    campaign = verdict.evidence.campaign
    rows = []
    for name, after in verdict.parameters.items():
        prior, unit = campaign.priors[name], pretty_unit(campaign.machine.unit(name))
        before, fitted = campaign.start[name], verdict.evidence.refit.parameters[name]
        change = f"{after / before - 1:+.2%}" if before else ""
        assumed, moved = believed(prior), ("", "")
        if prior.sd < float("inf"):
            moved = deviations(prior, fitted), deviations(prior, after)
        values = [number(value) for value in (before, fitted, after)]
        rows.append([escape(name), assumed, *values, _error(verdict, name), unit, change, *moved])
    for own in verdict.evidence.own_values:
        named = escape(f"{own.parameter} of {own.record}")
        assumed, unit = believed(campaign.per_record[own.parameter]), pretty_unit(own.unit)
        rows.append([named, assumed, "", "", number(own.value), "", unit, "", "", ""])
    for placed, confidence in zip(verdict.effects, verdict.confidence, strict=True):
        for quantity, unit in placed.units(campaign).items():
            named, value = f"{placed.name}.{quantity}", number(placed.values[quantity])
            told = value, _error(verdict, named), pretty_unit(unit), f"{confidence:.0%}"
            rows.append([escape(named), "", "", "", *told, "", ""])
    if not rows:
        yield "<p>None is uncertain.</p>"
        return
    headers = ["parameter", "prior", "before", "refit", "after", "±", "unit", "change", "refit", "after"]
    yield _table(headers, rows, (2, 3, 4, 5, 7, 8, 9))
    yield '<p class="faint">±: the standard error, by which it would scatter if runs were measured again. '
    yield "Change: of an effect, the confidence in it. The last two columns: how far refit "
    yield "and result are from the prior, in its standard deviations; a refit beyond "
    yield f"{MOVED_STANDARD_DEVIATIONS:g} makes up for what is missing.</p>"
    if verdict.ties:
        yield f'<p class="faint">{escape(". ".join(verdict.ties))}.</p>'


def _error(verdict: Verdict, name: str) -> str:
    error = verdict.standard_errors.get(name)
    return "" if error is None else f"{error:.2g}"


def _figure(name: str, figure: Figure, figures: dict[str, Figure], width: int | None = None) -> str:
    figures[name] = figure
    style = f"height:{figure['layout']['height']}px" + (f";width:{width}px" if width else "")
    return f'<div class="figure" id="figure-{name}" data-figure="{name}" style="{style}"></div>'


def _kind(kind: str) -> str:
    return escape(kind.replace("_", " "))


def _table(
    headers: Sequence[str],
    rows: Sequence[Sequence[str]],
    numbers: Iterable[int] = (),
    marked: Sequence[int] = (),
) -> str:
    """Return a table; the columns of `numbers` are aligned right, rows that are marked stand out."""

    def row(cells: Sequence[str], tag: str) -> str:
        kinds = {n: ' class="number"' for n in numbers}
        return "".join(f"<{tag}{kinds.get(n, '')}>{cell}</{tag}>" for n, cell in enumerate(cells))

    body = "".join(
        f"<tr{' class=chosen' if n in marked else ''}>{row(cells, 'td')}</tr>" for n, cells in enumerate(rows)
    )
    head = f"<thead><tr>{row(headers, 'th')}</tr></thead>"
    return f'<div class="wide"><table>{head}<tbody>{body}</tbody></table></div>'
