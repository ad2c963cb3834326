"""Draw the pictures of gallery.md: `python docs/make_gallery.py [ranking] [inerters] [page]`, or all of them.

`ranking` takes half an hour; `inerters` takes minutes and writes its table and its shares into the page, too;
`page` runs the lines of the page and saves what they draw.
"""

import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
from inertance.analysis import Tuned
from inertance.machines import ge_wang
from matplotlib import pyplot

PAGE = Path(__file__).parent / "gallery.md"
IMAGES = PAGE.parent / "images"
PICTURE = re.compile(r"\(images/(\w+)\.png\)|^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RANGES = {"d": (50.0, 30e3), "b": (0.1, 3000.0), "k": (10.0, 1e8)}
STIFFNESS = np.linspace(10e3, 120e3, 12)


def best(layout: str, k: float, measure: Any, starts: list[dict[str, float]]) -> Tuned:
    """Return the best parameters of a layout at a static stiffness, starting from others."""
    car = ia.machines.quarter_car(
        ia.machines.suspension(layout, k, 2e3, 200.0, k_b=1e6, k_1=1e2, k_2=1e2)
    ).dae()
    bounds = {
        n: RANGES[n[-1]] for n in car.parameter_values if n[-1] in RANGES and n.startswith("strut.rest")
    }
    tried = []
    for number, start in enumerate([{}, *starts]):
        given = {_last(n): value for n, value in start.items()}
        begin = {n: start.get(n, given.get(_last(n), car.parameter_values[n])) for n in bounds}
        if np.isfinite(measure(car, parameters=begin)):
            tried.append(ia.analysis.tune(car, measure, bounds, start=begin, starts=1 if number else 4))
    return min(tried, key=lambda tuned: tuned.value)


def _last(name: str) -> str:
    return ".".join(name.split(".")[-2:]) if "centring" not in name else name


def tuned_over_stiffness(measure: Any) -> dict[str, list[float]]:
    """Return the least measure of each layout over static stiffness.

    Searches start in the middle, at random, where simpler layouts are best, and where they ended before.
    """
    values: dict[str, list[float]] = {f"S{number}": [] for number in range(1, 9)}
    last: dict[str, list[dict[str, float]]] = {layout: [] for layout in values}
    for k in STIFFNESS:
        simpler: list[dict[str, float]] = []
        for layout, found in values.items():
            tuned = best(layout, float(k), measure, simpler + last[layout])
            found.append(tuned.value)
            last[layout] = [tuned.parameters]
            print(measure.__name__, layout, round(k), tuned.value, flush=True)
            if layout in ("S2", "S4", "S6"):
                simpler.append(tuned.parameters)
    return values


def ranking() -> None:
    """Draw J1 and J3 of S1 to S8 over static stiffness."""
    figure, axes = pyplot.subplots(1, 2, figsize=(11.0, 4.6), layout="constrained")
    for ax, measure, title in (
        (axes[0], ia.analysis.ride_j1, "J1 [m/s²]"),
        (axes[1], ia.analysis.tyre_j3, "J3 [N]"),
    ):
        for number, (layout, values) in enumerate(tuned_over_stiffness(measure).items()):
            style = "o-" if number % 2 == 0 else "s--"
            ax.plot(STIFFNESS / 1e3, values, style, markersize=3, label=layout)
        ax.set_xlabel("static stiffness [kN/m]")
        ax.set_ylabel(title)
        ax.grid(alpha=0.3)
    axes[0].legend(ncols=2, frameon=False)
    figure.savefig(IMAGES / "suspension_ranking.png", dpi=110)


INERTERS: dict[str, Callable[[], ia.Component]] = {
    "ideal": lambda: ia.Inerter(b=ge_wang.B),
    "disk": ge_wang.disk_inerter,
    "planetary": ge_wang.planetary_inerter,
}


ROADS, FORCES = "ABCD", (300.0, 3e3, 30e3)
TABLE = re.compile(r"^\| none \(S1; no TID\).*?(?=^$)", re.MULTILINE | re.DOTALL)
KEPT = re.compile(r"the disk keeps\s.*?on D\.", re.DOTALL)


def real_car(strut: ia.Component, road: str) -> float:
    """Return the rms acceleration of a quarter car on a road [m/s2]."""
    car = ia.machines.quarter_car(strut)
    profile = ia.analysis.road_profile(road, 25.0, 8.0, seed=1)
    return car.simulate(8.0, inputs={"road.s_ref": profile}, step=2e-3).rms("body.a")


def bare_car(road: str) -> float:
    """Return the rms acceleration without an inerter, damped best for ride [m/s2]."""
    return real_car(
        ia.machines.suspension("S1", 60e3, ia.analysis.quarter_car_damping(60e3, 250.0, 35.0, 150e3)), road
    )


def inerter_car(name: str, road: str) -> float:
    """Return the rms acceleration with one of the inerters in S4 [m/s2]."""
    return real_car(ia.machines.suspension("S4", 60e3, 3200.0, INERTERS[name]()), road)


def real_tid(inerter: ia.Component | None, force: float) -> float:
    """Return the rms displacement [m] of a structure of 7.7 t and 1.5 Hz in random wind."""
    m, w = 7700.0, 3 * np.pi
    rule, b = ia.analysis.den_hartog(ge_wang.B / m), ge_wang.B
    absorbers = (
        {(0, 1): ia.machines.tid(rule.stiffness(b, w), rule.damping(b, w), inerter)} if inerter else None
    )
    frame = ia.machines.shear_frame([m], [m * w**2], [2 * 0.01 * m * w], absorbers)
    dae, t, power = frame.dae(), np.linspace(0.0, 20.0, 401), 0.0
    for seed in range(3):
        gusts = ia.Sampled(t, force * np.random.default_rng(seed).standard_normal(len(t)))
        power += ia.simulate(dae, 20.0, inputs={"wind.f": gusts}, step=5e-3).rms("floor1.s") ** 2 / 3
    return float(np.sqrt(power))


def shares_kept(bare: list[float], cars: dict[str, list[float]]) -> str:
    """Say what real inerters keep, on the smoothest and the roughest road, of what an ideal one gains."""
    a, b, c, d = (
        round(100 * (bare[k] - cars[name][k]) / (bare[k] - cars["ideal"][k]))
        for name in ("disk", "planetary")
        for k in (0, -1)
    )
    return (
        f"the disk keeps\n{a} % on a road of class A and {b} % on D, the planets {c} % on A and {d} % on D."
    )


def table_rows(bare: list[float], cars: dict[str, list[float]], winds: dict[str, list[float]]) -> str:
    """Return the rows of the page's table."""
    rows = [f"| none (S1; no TID) | {' | '.join(f'{a:.3f}' for a in bare)} | 1 | 1 | 1 |"]
    for name, values in cars.items():
        rows.append(f"| {name} | {' | '.join(f'{value:.3f}' for value in values + winds[name])} |")
    return "\n".join(rows) + "\n"


def real_inerters() -> None:
    """Draw what friction and backlash leave of an inerter's promise, and write its figures into the page."""
    free = [real_tid(None, force) for force in FORCES]
    bare = [bare_car(road) for road in ROADS]
    cars, winds = {}, {}
    for name, make in INERTERS.items():
        cars[name] = [inerter_car(name, road) for road in ROADS]
        winds[name] = [real_tid(make(), force) / alone for force, alone in zip(FORCES, free, strict=True)]
        print(name, np.round(cars[name], 4), np.round(winds[name], 4), flush=True)
    text = TABLE.sub(lambda _: table_rows(bare, cars, winds), PAGE.read_text(encoding="utf-8"))
    PAGE.write_text(KEPT.sub(lambda _: shares_kept(bare, cars), text), encoding="utf-8")
    draw_inerters(bare, cars, winds)


def draw_inerters(bare: list[float], cars: dict[str, list[float]], winds: dict[str, list[float]]) -> None:
    """Draw ride over road class, and motion with a TID over wind."""
    figure, axes = pyplot.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    as_on_a = 2.0 ** np.arange(len(ROADS))
    axes[0].plot(list(ROADS), np.array(bare) / as_on_a, "--", color="gray", label="without, S1")
    axes[1].axhline(1.0, color="gray", linestyle="--", label="without")
    for name, on_road in cars.items():
        axes[0].plot(list(ROADS), np.array(on_road) / as_on_a, "o-", label=name)
        axes[1].semilogx(FORCES, winds[name], "o-", label=name)
    axes[0].set_xlabel("road, ISO 8608")
    axes[0].set_ylabel("rms acceleration, as on A [m/s²]")
    axes[1].set_xlabel("rms force of wind [N]")
    axes[1].set_ylabel("displacement, with TID over without")
    axes[0].set_title("quarter car, S4", fontsize="medium")
    axes[1].set_title("TID, b/m = 0.05", fontsize="medium")
    for ax in axes:
        ax.grid(alpha=0.3)
        ax.legend(frameon=False)
    figure.savefig(IMAGES / "real_inerters.png", dpi=110)


def page() -> None:
    """Run the lines of gallery.md, and save what they draw below a picture that is not drawn above."""
    text = PAGE.read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    picture = ""
    for found in PICTURE.finditer(text):
        if found[1]:
            picture = found[1]
            continue
        exec(found[2], names)
        if picture not in ("suspension_ranking", "real_inerters"):
            names["figure"].savefig(IMAGES / f"{picture}.png", dpi=100)


PARTS = {"ranking": ranking, "inerters": real_inerters, "page": page}

if __name__ == "__main__":
    for part in sys.argv[1:] or PARTS:
        PARTS[part]()
