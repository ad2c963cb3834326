"""Steps of the descent grow while they keep their promise."""

import numpy as np
import pytest
from inertance.diagnosis.descent import descend
from numpy.typing import NDArray

Array = NDArray[np.float64]


def test_what_was_expected_far_off_is_reached_in_a_few_steps() -> None:
    asked = []

    def residual(vector: Array, slopes: bool) -> tuple[Array, Array]:
        asked.append(slopes)
        far = vector - [300.0, 1.0]
        return 10 * far + 0.01 * far**2, np.diag(10 + 0.02 * far)

    free = np.array([-np.inf, -np.inf]), np.array([np.inf, np.inf])
    found, cost = descend(residual, np.zeros(2), free)
    assert found == pytest.approx([300.0, 1.0], abs=0.2)
    assert cost < 5.0
    assert len(asked) < 25
