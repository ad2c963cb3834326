"""Every component there is, with values that suit it: what tests over all elements are made from."""

from typing import Any

import inertance as ia
import numpy as np
from inertance import rotational, thermal
from inertance.cli.catalogue import all_names, is_base
from inertance.components.language import (
    MISSING,
    Domain,
    HeatPort,
    Parameter,
    Part,
    Port,
    RealInput,
    RotationalFlange,
    TranslationalFlange,
)

BODIES: dict[type, tuple[Any, Any, Any]] = {
    TranslationalFlange: (lambda m: ia.Mass(m=m), lambda: ia.Spring(k=3.0), ia.Force),
    RotationalFlange: (
        lambda m: rotational.Inertia(J=m),
        lambda: rotational.Spring(c=3.0),
        rotational.Torque,
    ),
}
LOSSES = ((0.0, 0.9, 0.8, 0.1, 0.2), (5.0, 0.8, 0.7, 0.2, 0.3))
CURVE = ((-0.5, -2.0), (-0.1, -0.3), (0.0, 0.0), (0.05, 0.1), (0.4, 1.0))
MAP = tuple((x, v, 3 * x + (1 + 0.1 * x) * v) for x in (-0.5, -0.1, 0.3) for v in (-1.0, -0.2, 0.1, 1.0))
GAS = {"p_0": 3e5, "V_0": 5e-3}
OIL = {"A_p": 3e-3, "A_r": 1e-3, "A_e": 1e-4, "A_c": 2e-4, "V_r": 2e-3, "beta": 1e8, "p_t": 100.0}
OLEO = GAS | {"A_a": 1e-3, "A_h": 1e-3, "A_o": 1e-4, "C_d": 0.9, "rho": 900.0, "n": 1.2}
STRUTS = {"p_0": 3e5, "V_0": 0.5, "A_b": 3e-3, "A_r": 1e-3, "R": 1e5}
COILED = {
    "alpha_a": 2.0,
    "alpha_b": 3.0,
    "c_0a": 0.2,
    "c_0b": 0.5,
    "eta": 5.0,
    "A": 2.0,
    "beta": 4.0,
    "gamma": 1.0,
}
VALUES: dict[str, dict[str, Any]] = {
    "TabulatedForce": {"table": CURVE, "over": "speed", "interpolation": "smooth"},
    "rotational.TabulatedForce": {"table": CURVE, "over": "position", "phi_rel0": -0.1},
    "DahlFriction": {"f_c": 2.0, "s_p": 0.05},
    "rotational.DahlFriction": {"tau_c": 2.0, "phi_p": 0.05},
    "LargeAngleLever": {"l_a": 10.0, "l_b": 12.0, "alpha": 0.3},
    "HardStop": {"e": 0.4, "s_min": -0.3},
    "MassWithStopAndFriction": {"s_min": -0.2, "s_max": 0.3, "f_c": 0.2, "d": 0.1},
    "VariableDamper": {"d": 1.0, "d_u": 0.5},
    "ShearThinningDamper": {"v_e": 0.1},
    "rotational.LossyGear": {
        "ratio": 2.0,
        "lossTable": LOSSES,
    },
    "BoucWen": {"beta": 0.5, "gamma": 0.3},
    "rotational.BoucWen": {"beta": 0.5, "gamma": 0.3},
    "Iwan": {"p": 1.5, "cells": 3},
    "rotational.Iwan": {"p": 1.5, "cells": 3},
    "EddyCurrentBrake": {"f_nominal": 2.0, "alpha20": 0.004, "T": 350.0},
    "rotational.EddyCurrentBrake": {"tau_nominal": 2.0, "alpha20": 0.004, "T": 350.0},
    "rotational.Gearbox": {"ratio": 2.0, "lossTable": LOSSES, "b": 0.1},
    "rotational.ElastoBacklash2": {"b": 0.1, "c": 20.0, "d": 0.5},
    "RelaxingBacklash": {"b": 0.1, "k": 20.0, "d": 2.0},
    "rotational.RelaxingBacklash": {"b": 0.1, "c": 20.0, "d": 2.0},
    "QuadraticSpeedDependentForce": {"f_nominal": -0.5, "ForceDirection": False},
    "rotational.QuadraticSpeedDependentTorque": {"tau_nominal": -0.5, "TorqueDirection": False},
    "RollingResistance": {"CrConstant": 0.5},
    "Vehicle": {"CrConstant": 0.3, "inclinationConstant": 0.1, "vWindConstant": 1.0},
    "machines.TMDI": {"b": 0.5},
    "machines.BumpStop": {"s_min": -0.1, "s_max": 0.1, "k3": 100.0},
    "PositionDependentFriction": {"f_c": 1.0, "f_1": 0.4, "f_2": 0.4, "f_cos": 0.3, "s_rel0": 0.1},
    "rotational.PositionDependentFriction": {"tau_c": 1.0, "tau_1": 0.4, "tau_2": 0.4, "tau_sin": 0.3},
    "rotational.ArmGravity": {"tau_sin": 2.0, "tau_cos": 0.5},
    "AirSpring": {"A": 1e-3, "p_0": 1.3e5, "V_0": 5e-3, "n": 1.0},
    "MonotubeDamper": GAS | OIL,
    "FluidInerter": {"A_p": 1e-3, "D": 0.01, "L": 0.1, "L_p": 0.2, "D_h": 0.2, "mu": 0.1},
    "SliderCrank": {"r": 0.3, "l": 1.0, "e": 0.1},
    "BoucWenDamper": COILED | {"k_0": 0.7},
    "SpencerDamper": COILED | {"k_0": 0.7, "k_1": 0.4, "c_1a": 4.0, "c_1b": 2.0},
    "LuGreFriction": {"f_c": 1.0, "f_s": 1.5, "v_s": 0.2, "sigma_0": 30.0, "sigma_2": 0.1},
    "rotational.LuGreFriction": {"tau_c": 1.0, "tau_s": 1.5, "w_s": 0.2, "sigma_0": 30.0},
    "WireRope": {"k_1": 1.0, "k_2": 0.2, "k_3": 0.4, "f_y": 1.0, "s_y": 0.1, "n": 1.5, "share": 0.7},
    "ObliqueSprings": {"k": 2.0, "l_0": 1.2, "a": 1.0},
    "Rope": {"k": 20.0, "d": 0.5, "s_rel0": 0.1},
    "VariableInerter": {"b": 1.0, "b_u": 0.8, "T": 0.2},
    "TabulatedSpring": {"table": CURVE, "interpolation": "smooth", "s_rel0": 0.1},
    "rotational.TabulatedSpring": {"table": CURVE, "phi_rel0": -0.1},
    "TabulatedDamper": {"table": CURVE, "interpolation": "smooth"},
    "MapSpringDamper": {"table": MAP, "interpolation": "smooth", "s_rel0": 0.1},
    "rotational.BeltDrive": {"r_a": 0.5, "r_b": 0.8, "k": 40.0, "d": 1.0, "e_0": -0.05},
    "rotational.HarmonicDrive": {"ratio": 2.0, "c": 5.0, "c3": 2.0, "d": 0.2, "e_1": 0.05},
    "rotational.DCMotor": {"k": 0.5, "R": 0.3, "L": 0.05, "u_max": 1.0, "i_max": 0.9},
    "rotational.ShuntedMotor": {"k": 1.0, "R": 0.3, "L": 0.2, "elastance": 2.0},
    "ModalRod": {"m": 1.0, "k": 20.0, "d": 0.3, "L": 0.2, "modes": 2},
    "LumpedRod": {"m": 1.0, "k": 20.0, "d": 0.3, "L": 0.2, "segments": 3},
    "rotational.ModalShaft": {"J": 1.0, "c": 20.0, "d": 0.3, "modes": 2},
    "rotational.LumpedShaft": {"J": 1.0, "c": 20.0, "d": 0.3, "segments": 3},
    "Tyre": {"R": 0.5, "F_z": 3.0, "mu": 0.9, "B": 8.0, "C": 1.6, "E": 0.3, "sigma": 0.3},
    "machines.OleoStrut": OLEO,
    "machines.InterconnectedStruts": STRUTS,
    "CubicSpring": {"k": 3.0, "k2": 1.5, "k3": 2.0},
    "rotational.CubicSpring": {"c": 3.0, "c2": -1.5, "c3": 2.0},
    "Gyroscope": {"J_s": 1.0, "w_s": 2.0, "J_t": 0.6, "J_g": 0.3, "J_i": 0.2, "c": 3.0, "d": 0.4},
    "machines.CrankInerter": {
        "crank": ia.SliderCrank(r=0.5, l=2.0),
        "flywheel": ia.DiskFlywheel(m=1.0, R=0.4),
    },
}
STARTS = {"machines.CrankInerter": {"element.crank.phi": np.pi / 2, "element.flywheel.w": 0.0}}
GRAVE = {"Fixed", "rotational.Fixed"}  # hold what they are joined to


def value_of(field: Parameter) -> float:
    bounds = [b for b in (field.min, field.above, field.max) if b is not None]
    tried = [0.7, *(b / 2 for b in bounds), *(b + 0.7 for b in bounds), *(b - 0.7 for b in bounds)]
    return next(v for v in tried if not field.problem(v))


def made(name: str, still: bool = False, **others: Any) -> Any:
    """Return a component with values for what must be given, and signals that move, or stand still."""
    kind, values = all_names()[name], dict[str, Any]()
    for phase, (key, field) in enumerate(kind.fields.items()):
        if field.when:
            continue
        if isinstance(field, Parameter) and field.default is MISSING:
            values[key] = value_of(field)
        elif isinstance(field, RealInput):
            values[key] = 0.4 if still else lambda t, k=phase: 0.3 + 0.2 * np.sin(3 * t + k)
        elif isinstance(field, Part) and any(field.default.problems()):
            given = {
                k: value_of(f) for k, f in type(field.default).fields.items() if isinstance(f, Parameter)
            }
            values[key] = type(field.default)(**given)
    return kind(**values | VALUES.get(name, {}) | others)


def ports(name: str) -> list[Port]:
    return [f for f in all_names()[name].fields.values() if isinstance(f, Port) and not f.when]


def flanges(name: str) -> list[Port]:
    return [port for port in ports(name) if isinstance(port.domain, Domain)]


def rig(name: str, still: bool = False, **others: Any) -> ia.Network:
    """Return a component whose every flange carries a body on a spring that a force shakes, or pushes.

    What has heat to give warms a body; what has a temperature is joined to one by a conductor.
    """
    net = ia.Network(name.replace(".", " "), element=made(name, still, **others))
    ground = {TranslationalFlange: ia.Fixed(), RotationalFlange: rotational.Fixed()}
    for kind in {type(port) for port in flanges(name)}:
        net.add(**{f"ground_{kind.__name__.lower()}": ground[kind]})
    for k, port in enumerate(flanges(name)):
        body, spring, force = BODIES[type(port)]
        net.add(**{f"body{k}": body(1.0 + 0.3 * k), f"spring{k}": spring()})
        push = 1.1 - k if still else lambda t, k=k: (2.0 - k) * np.sin((2.1 + 0.7 * k) * t + k)
        net.add(**{f"push{k}": force(**{port.through: push})})
        hold = getattr(net, f"ground_{type(port).__name__.lower()}").flange
        parts = [getattr(net, f"{part}{k}") for part in ("body", "spring", "push")]
        net.connect(getattr(net.element, port.name), parts[0].flange, parts[1].flange_b, parts[2].flange)
        net.connect(parts[1].flange_a, hold)
    for k, port in enumerate(port for port in ports(name) if isinstance(port, HeatPort)):
        net.add(**{f"path{k}": thermal.ThermalConductor(G=0.5), f"store{k}": thermal.HeatCapacitor(C=2.0)})
        net.connect(getattr(net.element, port.name), getattr(net, f"path{k}").port_a)
        net.connect(getattr(net, f"path{k}").port_b, getattr(net, f"store{k}").port)
    if others.get("useHeatPort"):
        net.add(store=thermal.HeatCapacitor(C=2.0)).connect(net.element.heatPort, net.store.port)
    return net


def elements() -> list[str]:
    """Return all components that are more than bases to derive from."""
    return [name for name, kind in all_names().items() if not is_base(kind)]


def with_flanges() -> list[str]:
    return [name for name in elements() if name not in GRAVE and flanges(name)]
