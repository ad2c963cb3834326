"""Base isolation: a building on soft bearings, with an absorber that keeps them from wandering far."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np

from ...base import above, at_least, demand, numbers, optional
from ...components import Component
from ..network import Network
from .frames import shear_frame


def isolated_building(
    m: Sequence[float],
    k: Sequence[float],
    d: Sequence[float] | None = None,
    *,
    m_b: float = 300e3,
    T_b: float = 2.5,
    zeta_b: float = 0.05,
    absorber: Component | None = None,
) -> Network:
    """Return a building on bearings: a `shear_frame` whose `floor1` is the base, `storey1` the bearings.

    The bearings are tuned with all above them as one rigid body: k_b = M (2 pi/T_b)^2 and
    d_b = 2 zeta_b M 2 pi/T_b. The absorber, `absorber1`, joins ground and base. To the motion against the
    ground its acceleration is a force, so that `den_hartog(b/M)` tunes a `tid` there.

    Args:
        m: masses of the floors from below [kg].
        k: stiffnesses of the storeys from below [N/m].
        d: their damping constants [N.s/m]; none if None.
        m_b: mass of the base [kg].
        T_b: period on the bearings [s].
        zeta_b: damping ratio of the bearings.
        absorber: two-terminal, such as `tid(...)`.

    Raises:
        ModelError: for lengths that differ.

    Source: the tuned inerter damper of Lazar, Neild & Wagg (see `tid`), below the base.
    """
    floors = numbers(above(0, "kg"))
    demand(
        "isolated_building()",
        m=(m, floors),
        k=(k, numbers(at_least(0, "N/m"))),
        d=(d, optional(numbers(at_least(0, "N.s/m")))),
        m_b=(m_b, above(0, "kg")),
        T_b=(T_b, above(0, "s")),
        zeta_b=(zeta_b, at_least(0)),
    )
    masses, stiffness = (np.ravel(np.asarray(given, dtype=float)).tolist() for given in (m, k))
    damping = [0.0] * len(masses) if d is None else np.ravel(np.asarray(d, dtype=float)).tolist()
    M, w = m_b + sum(masses), 2 * pi / T_b
    return shear_frame(
        [m_b, *masses],
        [M * w**2, *stiffness],
        [2 * zeta_b * M * w, *damping],
        {(0, 1): absorber} if absorber is not None else None,
    )
