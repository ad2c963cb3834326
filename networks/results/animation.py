"""A machine in motion: its sketch, nodes moving as they did in a run."""

from __future__ import annotations

from base64 import b64encode
from functools import cached_property
from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any
from uuid import uuid4

import numpy as np

from ...base import Array, ModelError, UnknownNameError, above, check_output, demand, path_of, whole, writing
from .motion_layout import Place, laid_out

if TYPE_CHECKING:
    from .motion_sketch import Sketch
    from .result import Result

REACH = 0.32  # how far what moves most goes to either side, in columns
SHORTEST_INTERVAL = 20.0  # ms
DPI = 80
PLAYER = """<div id="{key}">{pictures}<br><button type="button">❚❚</button>
<input type="range" min="0" max="{last}" value="0" style="width:60%"><script>{{
const all = document.getElementById("{key}"), [button] = all.getElementsByTagName("button");
const [slider] = all.getElementsByTagName("input"), pictures = all.getElementsByTagName("img");
const show = () => [...pictures].forEach((each, k) => each.hidden = k != slider.value);
const step = () => {{ slider.value = (+slider.value + 1) % pictures.length; show(); }};
let timer = setInterval(step, {interval});
button.onclick = () => {{
  timer = timer ? clearInterval(timer) : setInterval(step, {interval});
  button.textContent = timer ? "❚❚" : "▶";
}};
slider.oninput = show;
}}</script></div>"""
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{name}</title>{player}</html>"""


class Motion:
    """A machine in motion, as `Result.animate` returns it: a notebook plays it, `save` keeps it.

    Attributes:
        times: the instants that are shown [s].
        interval: how long each is shown [ms].
    """

    def __init__(self, sketch: Sketch, times: Array, interval: float) -> None:
        self._sketch, self.times, self.interval = sketch, times, interval

    @cached_property
    def pictures(self) -> list[bytes]:
        """The pictures, as PNG."""
        return [self._picture(number, float(time)) for number, time in enumerate(self.times)]

    def _picture(self, number: int, time: float) -> bytes:
        self._sketch.draw(number, time)
        file = BytesIO()
        self._sketch.figure.savefig(file, format="png", dpi=DPI)
        return file.getvalue()

    def save(self, path: str | Path) -> Path:
        """Write it as a .gif, or as an .html with all in it that plays in any browser; return the path.

        Raises:
            OutputError: for another ending, or a file that cannot be written.
        """
        path = path_of(path, "an animation")
        ending = check_output(path, (".gif", ".html"))
        with writing(path) as part:
            if ending == ".gif":
                self._write_gif(part)
            else:
                page = PAGE.format(name=escape(self._sketch.name), player=self._repr_html_())
                part.write_text(page, encoding="utf-8")
        return path

    def _write_gif(self, path: Path) -> None:
        from PIL import Image

        first, *others = (Image.open(BytesIO(picture)).convert("RGB") for picture in self.pictures)
        first.save(
            path, format="GIF", save_all=True, append_images=others, duration=round(self.interval), loop=0
        )

    def _repr_html_(self) -> str:
        sources = (f"data:image/png;base64,{b64encode(picture).decode()}" for picture in self.pictures)
        pictures = "".join(f'<img alt="" src="{s}"{" hidden" * (k > 0)}>' for k, s in enumerate(sources))
        last, interval = len(self.times) - 1, round(self.interval)
        return PLAYER.format(key=f"motion-{uuid4()}", pictures=pictures, last=last, interval=interval)

    def __repr__(self) -> str:
        span = f"{self.times[0]:g} to {self.times[-1]:g} s"
        return f"<Motion of '{self._sketch.name}': {span}, {len(self.times)} pictures>"


def animated(run: Result, frames: int, slower: float) -> Motion:
    """Return a run's machine in motion; see `Result.animate`."""
    from .motion_sketch import Sketch

    demand("animate()", frames=(frames, whole(2)), slower=(slower, above(0)))
    places, links = laid_out(run.dae.flat.instances[""].component)
    times = np.linspace(run.time[0], run.time[-1], frames)
    interval = max(SHORTEST_INTERVAL, 1e3 * slower * float(times[-1] - times[0]) / frames)
    return Motion(Sketch(run.name, places, links, motions(run, places, times)), times, interval)


def motions(run: Result, places: list[Place], times: Array) -> dict[Place, Array]:
    """Return how nodes move: about the middle of their range in columns, all at one scale; angles in rad."""
    found = {place: np.asarray(_signal(run, place.signal, times)) for place in places}
    moved = {p: y - (y.min() + y.max()) / 2 for p, y in found.items() if not p.turns}
    most = max((float(np.abs(y).max()) for y in moved.values()), default=0.0)
    scale = REACH / most if most > 0 else 0.0
    return {p: scale * moved[p] if p in moved else y for p, y in found.items()}


def _signal(run: Result, name: str, times: Array) -> Any:
    try:
        return run.at(name, times)
    except UnknownNameError as error:
        raise ModelError(f"'{run.name}' cannot be drawn in motion: {error}") from error
