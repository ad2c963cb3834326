"""The points of a law are apart, wherever its motion ends."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from inertance.diagnosis.criteria import LAW_SLOW_SHARE
from inertance.diagnosis.effects.effect import Motion
from inertance.diagnosis.law.axes import Axis


@given(st.floats(1e-6, 1e6), st.floats(0.01, 1.0), st.booleans(), st.booleans())
def test_points_of_speed_are_apart_and_span_what_was_visited(
    most: float, share: float, down: bool, pair: bool
) -> None:
    v = np.array([-most, share * most] if down else [-share * most, most])
    axis = Axis.over("speed", [Motion(np.arange(2.0), np.zeros(2), v, np.zeros(2), np.zeros(2))], pair)
    assert (axis.points[0], axis.points[-1]) == (v.min(), v.max())
    assert np.diff(axis.points).min() > 0.1 * LAW_SLOW_SHARE * most
