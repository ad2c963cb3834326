"""The suspension layouts S1 to S8: a spring, and beside it what damper, inerter and further springs make.

Source of the layouts: Smith & Wang, Performance benefits in passive vehicle suspensions employing inerters,
Vehicle System Dynamics 42 (2004) 235-257. The numbers S2 to S8 are this library's: they were not compared
with the paper's figure, so compare by what a layout is made of.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...base import demand, finite, text
from ...components import Component, Damper, Inerter, ModelError, Spring
from ..two_terminal import parallel, series


def suspension(
    layout: str,
    k: float,
    d: float | Component,
    b: float | Component = 0.0,
    k_b: float = 0.0,
    k_1: float = 0.0,
    k_2: float = 0.0,
) -> Any:
    """Return a strut of two flanges: `spring` of stiffness k parallel to `rest`, by layout.

        S1: d                 S5: (d parallel b) - k_b
        S2: d - k_b           S6: k_b - d - b
        S3: d parallel b      S7: (d parallel k_1) - (b parallel k_2)
        S4: d - b             S8: k_b - (d parallel k_1) - (b parallel k_2)

    where - is in series, from the wheel up. So the housing of a real inerter, which has no mass of its own,
    is on the body or on a damper, and its play leaves it on no spring alone. Parts are called `damper`,
    `inerter`, `relaxation` (k_b) and `centring` (k_1, k_2).

    Args:
        layout: "S1" to "S8".
        k: static stiffness [N/m].
        d: damping constant [N.s/m], or a damper of your own.
        b: inertance [kg], or an inerter of your own, such as `ge_wang.planetary_inerter()`.
        k_b: stiffness of the relaxation spring [N/m].
        k_1: stiffness of the centring spring beside the damper [N/m].
        k_2: stiffness of the centring spring beside the inerter [N/m].

    Raises:
        ModelError: for an unknown layout.
    """
    demand(
        "suspension()",
        layout=(layout, text),
        k=(k, finite("N/m")),
        d=(d, _number_or_component),
        b=(b, _number_or_component),
        k_b=(k_b, finite("N/m")),
        k_1=(k_1, finite("N/m")),
        k_2=(k_2, finite("N/m")),
    )
    damper = d if isinstance(d, Component) else Damper(d=d)
    inerter = b if isinstance(b, Component) else Inerter(b=b)
    layouts = _layouts(damper, inerter, Spring(k=k_b), Spring(k=k_1), Spring(k=k_2))
    if layout not in layouts:
        raise ModelError(f"suspension layouts are {', '.join(layouts)}, got {layout!r}")
    return parallel(spring=Spring(k=k), rest=layouts[layout]())


def _layouts(
    damper: Component, inerter: Component, relaxation: Spring, centring_d: Spring, centring_b: Spring
) -> dict[str, Callable[[], Any]]:
    """Return what makes each layout; only one is made, as a part belongs to one assembly."""

    def centred() -> dict[str, Component]:
        return {
            "upper": parallel(damper=damper, centring=centring_d),
            "lower": parallel(inerter=inerter, centring=centring_b),
        }

    return {
        "S1": lambda: damper,
        "S2": lambda: series(damper=damper, relaxation=relaxation),
        "S3": lambda: parallel(damper=damper, inerter=inerter),
        "S4": lambda: series(damper=damper, inerter=inerter),
        "S5": lambda: series(pair=parallel(damper=damper, inerter=inerter), relaxation=relaxation),
        "S6": lambda: series(relaxation=relaxation, damper=damper, inerter=inerter),
        "S7": lambda: series(**centred()),
        "S8": lambda: series(relaxation=relaxation, **centred()),
    }


def _number_or_component(value: Any) -> str:
    return "" if isinstance(value, Component) or not finite()(value) else "must be a number or a component"
