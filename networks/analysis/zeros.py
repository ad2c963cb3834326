"""Transmission zeros: where a square system passes nothing on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...base import ModelError

if TYPE_CHECKING:
    from .statespace import StateSpace


def transmission_zeros(system: StateSpace) -> NDArray[np.complex128]:
    """Return the finite generalised eigenvalues of [[A, B], [C, D]], slowest first.

    Raises:
        ModelError: if there are not as many inputs as outputs, or the system is improper.
    """
    import scipy.linalg

    n, m = system.B.shape
    if len(system.C) != m or not system.proper:
        raise ModelError(
            f"'{system.name}': zeros are those of a proper system with as many inputs as outputs; pick "
            "a pair: system[output, input]"
        )
    pencil = np.block([[system.A, system.B], [system.C, system.D]])
    weight = scipy.linalg.block_diag(np.eye(n), np.zeros((m, m)))
    alpha, beta = np.asarray(scipy.linalg.eigvals(pencil, weight, homogeneous_eigvals=True), dtype=complex)
    finite = np.abs(beta) > 1e-10 * np.abs(alpha)
    found = alpha[finite] / beta[finite]
    scale = max(np.abs(np.linalg.eigvals(system.A)).max(initial=1.0), 1.0)
    found = found[np.abs(found) < 1e6 * scale]
    ordered: NDArray[np.complex128] = found[np.lexsort((found.imag, np.abs(found)))]
    return ordered
