"""Driving-point admittance and impedance: what a pair of flanges answers to."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ...base import ModelError, nearest, shown
from ...components import FAMILIES, Component, Domain
from ...components.language import Field, Port, PortRef, RealInput, fields_of, parts_of
from ..given import element_of
from ..network import Network
from .linearise import linearise
from .statespace import StateSpace


def admittance(
    network: Component, flange_a: str = "flange_a", flange_b: str = "flange_b", **options: Any
) -> StateSpace:
    """Return the mechanical admittance between two flanges: force over relative velocity, Y(s) = F/v.

    A spring has Y = k/s, a damper Y = d, an inerter Y = b s. In a network, everything else stays joined and
    other inputs are held.

    Args:
        network: a network, or a two-terminal element.
        flange_a: path of one flange, such as "strut.flange_a".
        flange_b: path of the other.
        options: as for `linearise`: `at`, `start`, `parameters`.

    Raises:
        ModelError: for an unknown flange, or one that cannot be moved against the other.

    Source: M. C. Smith, IEEE Trans. Automat. Contr. 47 (2002) 1648-1662, section II.

    Example:
        >>> from inertance import Damper, Inerter, series
        >>> from inertance.analysis import admittance
        >>> Y = admittance(series(Damper(d=100.0), Inerter(b=10.0)))
        >>> round(abs(Y(1j).item()), 6)  # 1/(1/d + 1/(b s)) at 1 rad/s
        9.950372
    """
    net, domain = _probed(network, flange_a, flange_b, "move")
    drive, force = f"der(probe.{domain.across}_ref)", f"probe.flange.{domain.through}"
    found = linearise(net, [drive], [force], **options).minimal()
    drives, forces = (domain.speed,), (domain.through,)
    return replace(
        found, C=-found.C, D=-found.D, D_s=tuple(-D for D in found.D_s), inputs=drives, outputs=forces
    )


def impedance(
    network: Component, flange_a: str = "flange_a", flange_b: str = "flange_b", **options: Any
) -> StateSpace:
    """Return the mechanical impedance between two flanges: relative velocity over force, Z(s) = v/F = 1/Y.

    Args and errors as for `admittance`.
    """
    net, domain = _probed(network, flange_a, flange_b, "push")
    force, speed = f"probe.{domain.through}", f"meter.{domain.speed}_rel"
    found = linearise(net, [force], [speed], **options).minimal()
    return replace(found, inputs=(domain.through,), outputs=(domain.speed,))


def _probed(network: Component, flange_a: str, flange_b: str, how: str) -> tuple[Network, Domain]:
    """Return a copy with a source between two flanges, and their domain."""
    element_of(network)
    if isinstance(network, Network):
        net = network.clone()
    else:
        net = Network("element", element=network.clone())
        flange_a, flange_b = f"element.{flange_a}", f"element.{flange_b}"
    a, b = (port(net, path) for path in (flange_a, flange_b))
    if not isinstance(a.domain, Domain) or a.domain != b.domain:
        raise ModelError(f"'{flange_a}' and '{flange_b}' must be two flanges that both slide or both turn")
    family = FAMILIES[a.domain]
    if not isinstance(network, Network):
        net.add(ground=family.Fixed()).connect(net.ground.flange, a)
    if how == "move":
        net.add(probe=family.Position())
    else:
        net.add(probe=family.Force(), meter=family.RelativeSpeedSensor())
        net.connect(a, net.meter.flange_a).connect(b, net.meter.flange_b)
    net.connect(a, net.probe.support).connect(b, net.probe.flange)
    return net, a.domain


def port(net: Network, path: str) -> PortRef:
    """Return a port by its path."""
    if not isinstance(path, str):
        raise ModelError(
            f"'{net.name}': a flange is given by its path, such as 'mass.flange', got {shown(path)}"
        )
    part: Any = net
    *parts, name = path.split(".")
    for step in parts:
        if step not in parts_of(part):
            raise ModelError(f"'{net.name}' has no part '{step}' in '{path}'{nearest(step, parts_of(part))}")
        part = parts_of(part)[step]
    ports = [field.name for field in fields_of(part, Field) if isinstance(field, Port | RealInput)]
    if name not in ports:
        raise ModelError(f"'{path}': there is no such flange{nearest(name, ports)}")
    return PortRef(part, name)
