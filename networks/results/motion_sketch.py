"""The sketch of a machine, its nodes anywhere: bodies, discs, and what joins them."""

from __future__ import annotations

import re
from math import pi
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ...base import Array
from .motion_layout import Link, Place

COLUMN_INCHES, ROW_INCHES = 1.5, 0.9
BAR = 0.09  # half the width of a body, in columns
SPRING, DAMPER, OTHER, BODY, TURNING = "#4477aa", "#228833", "#aa3377", "#bbccee", "#ffccbb"
ZIGZAG = np.array([0, 0, 1, -1, 1, -1, 1, -1, 0, 0]) * 0.13
ALONG = np.array([0, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 1]) + np.array([0] * 2 + [0.05] * 6 + [0.1, 0])
POT = np.array([[-0.1, 0.12, 0.12, -0.1], [-0.12, -0.12, 0.12, 0.12]])


class Sketch:
    """A picture of a machine, drawn anew for each frame.

    Args:
        name: of the machine.
        places: its nodes.
        links: what joins them.
        motions: how far each node is from its place, in columns, or its angle [rad], by frame.
    """

    def __init__(
        self, name: str, places: list[Place], links: list[Link], motions: dict[Place, Array]
    ) -> None:
        self.name, self.places, self.links, self.motions = name, places, links, motions
        columns = max(place.x for place in places)
        rows = max(max(place.rows) for place in places)
        size = (1.5 + COLUMN_INCHES * (columns + 1), 1.0 + ROW_INCHES * (rows + 1))
        self.figure = Figure(figsize=size, layout="constrained")
        self.ax: Any = self.figure.subplots()
        self.limits = (-0.8, columns + 0.8), (rows + 0.7, -0.7)

    def draw(self, number: int, time: float) -> None:
        """Draw a frame."""
        ax = self.ax
        ax.clear()
        ax.set_axis_off()
        ax.set(xlim=self.limits[0], ylim=self.limits[1])
        ax.set_title(f"{self.name}, {time:.3f} s", fontsize="medium", family="monospace")
        for link in self.links:
            left, right = sorted(self._x(place, number) for place in (link.left, link.right))
            draw_link(ax, link, left + BAR, right - BAR)
        for place in self.places:
            self._draw_place(place, number)

    def _x(self, place: Place, number: int) -> float:
        return place.x + (0.0 if place.turns else float(self.motions[place][number]))

    def _draw_place(self, place: Place, number: int) -> None:
        x, top, bottom = self._x(place, number), min(place.rows) - 0.3, max(place.rows) + 0.3
        self.ax.fill_between(
            [x - BAR, x + BAR], top, bottom, facecolor=TURNING if place.turns else BODY, edgecolor="0.2",
            hatch="////" if place.held else None, linewidth=1.0, zorder=3,
        )  # fmt: skip
        self.ax.text(
            x, top - 0.04, "\n".join(place.bodies[:3]), ha="center", va="bottom", fontsize=8, zorder=4
        )
        if place.turns:
            middle, angle = (top + bottom) / 2, float(self.motions[place][number])
            dial = np.linspace(0, 2 * pi, 33)
            ratio = COLUMN_INCHES / ROW_INCHES
            self.ax.fill(
                x + 0.15 * np.cos(dial), middle + 0.15 * ratio * np.sin(dial), fc="white", ec="0.2", zorder=5
            )
            hand = 0.15 * np.exp(1j * angle)
            self.ax.plot(
                [x, x + hand.real], [middle, middle - ratio * hand.imag], color="#cc3311", lw=2, zorder=6
            )


def draw_link(ax: Any, link: Link, left: float, right: float) -> None:
    """Draw a part between two places: springs as zigzags, dampers as pots, the rest as boxes."""
    row = float(link.row)
    shown = re.findall("Spring|Damper", type(link.part).__name__)
    shifts = [0.0] if len(shown) < 2 else [-0.16, 0.16]
    for what, shift in zip(shown, shifts, strict=False):
        y = row + shift
        if what == "Spring":
            ax.plot(left + (right - left) * ALONG, y + ZIGZAG, color=SPRING, lw=1.4)
        else:
            middle = (left + right) / 2
            ax.plot([left, middle + 0.04], [y, y], color=DAMPER, lw=1.4)
            ax.plot([middle + 0.04] * 2, [y - 0.08, y + 0.08], color=DAMPER, lw=2)
            ax.plot(middle + POT[0], y + POT[1], color=DAMPER, lw=1.4)
            ax.plot([middle + 0.12, right], [y, y], color=DAMPER, lw=1.4)
    if not shown:
        a, b = left + 0.25 * (right - left), right - 0.25 * (right - left)
        ax.plot([left, a], [row, row], color=OTHER, lw=1.4)
        ax.plot([b, right], [row, row], color=OTHER, lw=1.4)
        ax.fill_between([a, b], row - 0.13, row + 0.13, facecolor="white", edgecolor=OTHER, lw=1.4)
    ax.text((left + right) / 2, row + 0.2 + abs(shifts[-1]), link.name, ha="center", va="top", fontsize=8)
