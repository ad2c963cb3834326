"""Icon: the sketch of a network as the picture by which tools show an FMU."""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from io import BytesIO
from typing import Any
from xml.etree import ElementTree as ET

from ...components import Component
from ...networks import svg_sketch

NAMESPACE = "http://www.w3.org/2000/svg"
PNG_WIDTH = 480  # pixels
POINTS = 0.75  # of a pixel of the drawing


@dataclass(frozen=True)
class Icon:
    """A picture, as PNG and SVG, and its size in pixels of the drawing."""

    png: bytes
    svg: bytes
    width: float
    height: float

    def files(self, fmi_version: str) -> dict[str, bytes]:
        """Return what lies where in an FMU: FMI 2 has one place, for PNG."""
        if fmi_version == "2.0":
            return {"model.png": self.png}
        return {"terminalsAndIcons/icon.png": self.png, "terminalsAndIcons/icon.svg": self.svg}


def icon(network: Component) -> Icon | None:
    """Return the picture of a network, if it has not too many parts for a sketch."""
    drawn = svg_sketch(network)
    if not drawn:
        return None
    text = drawn.replace("<svg ", f'<svg xmlns="{NAMESPACE}" ', 1)
    root = ET.fromstring(text)
    width, height = (float(root.get(name, 0)) for name in ("width", "height"))
    return Icon(_png(root, width, height), text.encode(), width, height)


def _png(root: Any, width: float, height: float) -> bytes:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / 72, height / 72), dpi=72 * PNG_WIDTH / width)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0, width), ylim=(height, 0))
    axes.axis("off")
    for shape in root:
        _draw(axes, shape.tag.rpartition("}")[2], shape)
    target = BytesIO()
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph")  # of a name in a script that the font has not
        figure.savefig(target, format="png", metadata={"Software": None})
    return target.getvalue()


def _draw(axes: Any, tag: str, shape: Any) -> None:
    from matplotlib.patches import Circle, FancyBboxPatch, PathPatch
    from matplotlib.path import Path

    def at(*names: str) -> list[float]:
        return [float(shape.get(name)) for name in names]

    if tag == "text":
        x, y = at("x", "y")
        shade = float(shape.get("fill-opacity", 1.0))
        axes.text(x, y, shape.text, ha="center", va="baseline", fontsize=12 * POINTS, alpha=shade)
    elif tag == "circle":
        axes.add_patch(Circle((at("cx", "cy")[0], at("cx", "cy")[1]), *at("r"), color="black"))
    elif tag == "path":
        numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", shape.get("d"))]
        points = list(zip(numbers[::2], numbers[1::2], strict=True))
        line = Path(points, [Path.MOVETO, *[Path.CURVE4] * 3])
        style = "--" if shape.get("stroke-dasharray") else "-"
        axes.add_patch(PathPatch(line, fill=False, edgecolor="#00000088", linewidth=1.2, linestyle=style))
    elif tag == "rect":
        x, y, width, height = at("x", "y", "width", "height")
        colour = shape.get("stroke").replace("currentColor", "black")
        look = {"boxstyle": "round,pad=0,rounding_size=4", "facecolor": f"{colour}1f", "edgecolor": colour}
        look["facecolor"] = "none" if colour == "black" else look["facecolor"]
        axes.add_patch(FancyBboxPatch((x, y), width, height, linewidth=1.2, **look))
