"""Measures: what a vehicle or a building is judged by, and what comes of measures that fail.

Each takes `parameters=`, so that `tune` can change them.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi, sqrt
from typing import Protocol

import numpy as np

from ...base import InertanceError, ModelError, above, at_least, demand, number, one_of, shown
from ..dae import DAE
from ..network import Network
from .comfort import WEIGHTINGS, weighted
from .linearise import linearise
from .norms import Norm

Changes = Mapping[str, float] | None
V, KAPPA = 25.0, 5e-7
NO_VALUE = 1e30  # stands for a measure that has none


class Measure(Protocol):
    """What is to be small: a function of the equations and of changed parameters, such as `ride_j1`."""

    def __call__(self, dae: DAE, /, *, parameters: Mapping[str, float]) -> float:
        """Return the measure for some parameters."""
        ...


def ride_j1(
    car: Network | DAE,
    *,
    body: str = "body",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    parameters: Changes = None,
) -> Norm:
    """Return the rms acceleration of the body on a road, J1 = 2 pi sqrt(V kappa) ||s T(z_r, z_s)||_2 [m/s2].

    Args:
        car: the vehicle, with an input `road`.s_ref and a mass `body`.
        body: path of the mass.
        road: path of the road.
        V: speed [m/s].
        kappa: roughness of the road [m3/cycle], see `roughness`.
        parameters: changed parameters by name.

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257, eq. (4).
    """
    return _on_road(car, f"{road}.s_ref", f"{body}.v", V, kappa, parameters)


def tyre_j3(
    car: Network | DAE,
    *,
    tyre: str = "tyre",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    parameters: Changes = None,
) -> Norm:
    """Return the rms dynamic tyre load [N], J3 = 2 pi sqrt(V kappa) ||(1/s) T(z_r -> k_t (z_u - z_r))||_2.

    `tyre` is the path of a spring; all other arguments are as for `ride_j1`.

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257, eq. (5).
    """
    return _on_road(car, f"der({road}.s_ref)", f"{tyre}.f", V, kappa, parameters)


def load_j5(
    car: Network | DAE, *, body: str = "body", load: str = "load", parameters: Changes = None
) -> Norm:
    """Return how much a load on the body moves it at worst, J5 = ||T(F_s -> z_s)||_inf [m/N].

    Args:
        car: the vehicle, with a force `load`.f on a mass `body`.
        body: path of the mass.
        load: path of the force.
        parameters: changed parameters by name.

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257.
    """
    return _at_worst(car, f"{load}.f", f"{body}.s", parameters)


def suspension_travel(
    car: Network | DAE,
    *,
    strut: str = "strut",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    parameters: Changes = None,
) -> Norm:
    """Return the rms travel of a suspension on a random road [m]."""
    return _on_road(car, f"der({road}.s_ref)", f"{strut}.s_rel", V, kappa, parameters)


def ride_comfort(
    car: Network | DAE,
    *,
    body: str = "body",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    weighting: str = "Wk",
    parameters: Changes = None,
) -> Norm:
    """Return the rms acceleration of the body on a random road, weighted after ISO 2631-1 [m/s2]."""
    demand("ride_comfort()", weighting=(weighting, one_of(WEIGHTINGS)))
    return _on_road(car, f"der({road}.s_ref)", f"{body}.a", V, kappa, parameters, weighting)


def base_shear(
    frame: Network | DAE, *, storey: str = "storey1", ground: str = "ground", parameters: Changes = None
) -> Norm:
    """Return the greatest force in the first storey for a unit harmonic ground acceleration [N.s2/m]."""
    return _at_worst(frame, f"der(der({ground}.s_ref))", f"{storey}.f", parameters)


def storey_drift(
    frame: Network | DAE, *, storey: str = "storey1", ground: str = "ground", parameters: Changes = None
) -> Norm:
    """Return the greatest drift of a storey for a unit harmonic ground acceleration [s2]."""
    return _at_worst(frame, f"der(der({ground}.s_ref))", f"{storey}.s_rel", parameters)


def _on_road(
    car: Network | DAE,
    road: str,
    output: str,
    V: float,
    kappa: float,
    parameters: Changes,
    weighting: str = "",
) -> Norm:
    demand("this measure", V=(V, above(0, "m/s")), kappa=(kappa, at_least(0, "m3/cycle")))
    system = linearise(car, [road], [output], parameters=parameters)
    felt = weighted(system.minimal(), weighting) if weighting else system
    return felt.h2().scaled(2 * pi * sqrt(V * kappa))


def _at_worst(network: Network | DAE, given: str, output: str, parameters: Changes) -> Norm:
    return linearise(network, [given], [output], parameters=parameters).hinf()


class BadMeasureError(ModelError):
    """A measure that raises an error of its own, or returns no number."""


def measured(measure: Measure, dae: DAE, parameters: Mapping[str, float], *, lenient: bool = False) -> float:
    """Return a measure for some parameters; if `lenient`, a large number where the library finds none."""
    name = getattr(measure, "__name__", repr(measure))
    try:
        found = measure(dae, parameters=parameters)
    except (InertanceError, np.linalg.LinAlgError) as error:
        if lenient and not isinstance(error, BadMeasureError):
            return NO_VALUE
        raise
    except Exception as error:
        told = ", ".join(f"{n} = {v:g}" for n, v in parameters.items())
        raise BadMeasureError(
            f"measure '{name}' failed at {told}: {type(error).__name__}: {error}"
        ) from error
    if number(found):
        raise BadMeasureError(f"measure '{name}' must return a number, got {shown(found)}")
    return found
