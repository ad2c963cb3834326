"""To python-control and SciPy, and back."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base import ModelError
from .statespace import StateSpace


def to_control(system: StateSpace) -> Any:
    """Return the system as `control.StateSpace`; see `StateSpace.to_ss`."""
    matrices = _proper_matrices(system)
    try:
        import control  # type: ignore[import-untyped, import-not-found, unused-ignore]
    except ImportError as error:
        raise ModelError(
            f"'{system.name}': to_ss() needs python-control: pip install control, or use to_scipy()"
        ) from error
    kinds = ("states", "inputs", "outputs")
    labels = {kind: [_plain(name) for name in getattr(system, kind)] for kind in kinds}
    return control.ss(*matrices, name=_plain(system.name), **labels)


def to_scipy(system: StateSpace) -> Any:
    """Return the system as `scipy.signal.StateSpace`; see `StateSpace.to_scipy`."""
    from scipy.signal import StateSpace as ScipyStateSpace

    return ScipyStateSpace(*_proper_matrices(system))


def from_other(system: Any, name: str = "system") -> StateSpace:
    """Return a system of python-control or SciPy as a `StateSpace`; see `StateSpace.from_ss`."""
    if not hasattr(system, "A") and hasattr(system, "to_ss"):
        system = system.to_ss()
    elif not hasattr(system, "A") and hasattr(system, "num"):
        import control

        system = control.tf2ss(system)
    if any(not hasattr(system, letter) for letter in "ABCD"):
        raise ModelError(f"from_ss() takes a system of python-control or scipy.signal, got {system!r}")
    if getattr(system, "dt", None) not in (None, 0):
        raise ModelError(f"from_ss() takes a continuous system, got one with dt = {system.dt} s")
    A, B, C, D = (np.array(getattr(system, letter), dtype=float) for letter in "ABCD")
    labels: dict[str, Any] = {
        f"{kind}s": getattr(system, f"{kind}_labels", None) or () for kind in ("state", "input", "output")
    }
    return StateSpace(A, B, C, D, name=name, **labels)


def _proper_matrices(system: StateSpace) -> tuple[Any, ...]:
    if not system.proper:
        raise ModelError(
            f"'{system.name}' is improper: {', '.join(system.outputs)} contain derivatives of "
            f"{', '.join(system.inputs)} up to order {len(system.D_s)}. Take a derivative as input, as in "
            f"'{'der(' * len(system.D_s)}{system.inputs[0]}{')' * len(system.D_s)}'"
        )
    return system.A, system.B, system.C, system.D


def _plain(name: str) -> str:
    return name.replace(".", "_").replace(" ", "_")
