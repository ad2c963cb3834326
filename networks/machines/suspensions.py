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

LAYOUTS: dict[str, Callable[..., Any]] = {
    "S1": lambda damper, **_: damper,
    "S2": lambda damper, relaxation, **_: series(damper=damper, relaxation=relaxation),
    "S3": lambda damper, inerter, **_: parallel(damper=damper, inerter=inerter),
    "S4": lambda damper, inerter, **_: series(damper=damper, inerter=inerter),
    "S5": lambda damper, inerter, relaxation, **_: series(
        pair=parallel(damper=damper, inerter=inerter), relaxation=relaxation
    ),
    "S6": lambda damper, inerter, relaxation, **_: series(
        relaxation=relaxation, damper=damper, inerter=inerter
    ),
    "S7": lambda damper, inerter, centring_d, centring_b, **_: series(
        upper=parallel(damper=damper, centring=centring_d),
        lower=parallel(inerter=inerter, centring=centring_b),
    ),
    "S8": lambda damper, inerter, centring_d, centring_b, relaxation, **_: series(
        relaxation=relaxation,
        upper=parallel(damper=damper, centring=centring_d),
        lower=parallel(inerter=inerter, centring=centring_b),
    ),
}


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
    if layout not in LAYOUTS:
        raise ModelError(f"suspension layouts are {', '.join(LAYOUTS)}, got {layout!r}")
    rest = LAYOUTS[layout](
        damper=d if isinstance(d, Component) else Damper(d=d),
        inerter=b if isinstance(b, Component) else Inerter(b=b),
        relaxation=Spring(k=k_b),
        centring_d=Spring(k=k_1),
        centring_b=Spring(k=k_2),
    )
    return parallel(spring=Spring(k=k), rest=rest)


def _number_or_component(value: Any) -> str:
    return "" if isinstance(value, Component) or not finite()(value) else "must be a number or a component"
