"""What a vehicle or a building is judged by. Each takes `parameters=`, so that `tune` can change them."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi, sqrt

from ..dae import DAE
from ..network import Network
from .comfort import weighted
from .linearise import linearise
from .norms import Norm

V, KAPPA = 25.0, 5e-7


def ride_j1(
    car: Network | DAE,
    *,
    body: str = "body",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    parameters: Mapping[str, float] | None = None,
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
    return _scaled(linearise(car, [f"{road}.s_ref"], [f"{body}.v"], parameters=parameters).h2(), V, kappa)


def tyre_j3(
    car: Network | DAE,
    *,
    tyre: str = "tyre",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    parameters: Mapping[str, float] | None = None,
) -> Norm:
    """Return the rms dynamic tyre load [N], J3 = 2 pi sqrt(V kappa) ||(1/s) T(z_r -> k_t (z_u - z_r))||_2.

    Args:
        car: the vehicle, with an input `road`.s_ref and a spring `tyre`.
        tyre: path of the spring.
        road: path of the road.
        V: speed [m/s].
        kappa: roughness of the road [m3/cycle].
        parameters: changed parameters by name.

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257, eq. (5).
    """
    return _scaled(
        linearise(car, [f"der({road}.s_ref)"], [f"{tyre}.f"], parameters=parameters).h2(), V, kappa
    )


def load_j5(
    car: Network | DAE,
    *,
    body: str = "body",
    load: str = "load",
    parameters: Mapping[str, float] | None = None,
) -> Norm:
    """Return how much a load on the body moves it at worst, J5 = ||T(F_s -> z_s)||_inf [m/N].

    Args:
        car: the vehicle, with a force `load`.f on a mass `body`.
        body: path of the mass.
        load: path of the force.
        parameters: changed parameters by name.

    Source: Smith & Wang, Vehicle System Dynamics 42 (2004) 235-257.
    """
    return linearise(car, [f"{load}.f"], [f"{body}.s"], parameters=parameters).hinf()


def suspension_travel(
    car: Network | DAE,
    *,
    strut: str = "strut",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    parameters: Mapping[str, float] | None = None,
) -> Norm:
    """Return the rms travel of a suspension on a random road [m]."""
    return _scaled(
        linearise(car, [f"der({road}.s_ref)"], [f"{strut}.s_rel"], parameters=parameters).h2(), V, kappa
    )


def ride_comfort(
    car: Network | DAE,
    *,
    body: str = "body",
    road: str = "road",
    V: float = V,
    kappa: float = KAPPA,
    weighting: str = "Wk",
    parameters: Mapping[str, float] | None = None,
) -> Norm:
    """Return the rms acceleration of the body on a random road, weighted after ISO 2631-1 [m/s2]."""
    system = linearise(car, [f"der({road}.s_ref)"], [f"{body}.a"], parameters=parameters)
    return _scaled(weighted(system, weighting).h2(), V, kappa)


def base_shear(
    frame: Network | DAE,
    *,
    storey: str = "storey1",
    ground: str = "ground",
    parameters: Mapping[str, float] | None = None,
) -> Norm:
    """Return the greatest force in the first storey for a unit harmonic ground acceleration [N.s2/m]."""
    return linearise(frame, [f"der(der({ground}.s_ref))"], [f"{storey}.f"], parameters=parameters).hinf()


def drift(
    frame: Network | DAE,
    *,
    storey: str = "storey1",
    ground: str = "ground",
    parameters: Mapping[str, float] | None = None,
) -> Norm:
    """Return the greatest drift of a storey for a unit harmonic ground acceleration [s2]."""
    return linearise(frame, [f"der(der({ground}.s_ref))"], [f"{storey}.s_rel"], parameters=parameters).hinf()


def _scaled(norm: Norm, V: float, kappa: float) -> Norm:
    return Norm(2 * pi * sqrt(V * kappa) * norm, norm.frequency, norm.reason)
