"""Terminals: flanges of a network as signals of an FMU, and what FMI 3 is told of them.

A flange that is asked for as `force-in` takes a force and shows its motion, one as `motion-in` takes
a motion and shows the force it answers with; two FMUs are coupled by joining the one to the other.
One as `motion-out` only shows its motion.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as ET

from ...base import UnknownNameError, nearest
from ...base.checks import by_name, demand, instance
from ...base.checks import text as is_text
from ...components import FAMILIES, Component, Domain, ModelError
from ...components.language import Port, PortRef, parts_of
from ...networks import Network
from .icon import Icon
from .model_description import text

MM_PER_PIXEL = 0.1
CAUSALITIES = ("force-in", "motion-in", "motion-out")


@dataclass(frozen=True)
class Terminal:
    """A published flange: which variable stands for which member."""

    flange: str
    causality: str
    domain: Domain
    members: dict[str, str]

    @property
    def outputs(self) -> list[str]:
        """The members that leave the FMU."""
        through = self.domain.through
        leaving = {"motion-in": [through]}.get(self.causality, [m for m in self.members if m != through])
        return [self.members[m] for m in leaving]


def publish(network: Network, flanges: Mapping[str, str]) -> tuple[Network, list[Terminal]]:
    """Return a copy of a network with flanges turned into signals.

    Args:
        network: stays as it is.
        flanges: `"force-in"`, `"motion-in"` or `"motion-out"` by path of a flange, such as `"body.flange"`.

    A source and sensors are joined to each flange, as a part named after it (`body_flange`). Force-in:
    input f [N], outputs s [m], v [m/s], a [m/s2]; motion-in: input s (with v and a where the network
    needs them), output f, the force that the network puts on what moves it; motion-out: outputs s, v, a.
    Rotational: tau; phi, w, a.

    Raises:
        ModelError: for unknown flanges and causalities.

    Example:
        >>> from inertance import Mass, Network
        >>> from inertance.fmu import publish
        >>> net, terminals = publish(Network("body", mass=Mass(m=2.0)), {"mass.flange": "force-in"})
        >>> terminals[0].members["f"]
        'mass_flange.force.f'
    """
    demand("publish()", network=(network, instance(Network)), flanges=(flanges, by_name(is_text)))
    edited, terminals, problems = network.clone(), [], []
    for path, causality in flanges.items():
        try:
            port, domain = _flange(edited, path)
        except KeyError as error:
            problems.append(str(error.args[0]))
            continue
        if causality not in CAUSALITIES:
            problems.append(f"terminal '{path}' must be one of {', '.join(CAUSALITIES)}, got {causality!r}")
            continue
        name = path.replace(".", "_")
        part, inner, members = _part(domain, causality)
        edited.add(**{name: part})
        edited.connect(port, *inner)
        named = {member: f"{name}.{where}" for member, where in members.items()}
        terminals.append(Terminal(path, causality, domain, named))
    if problems:
        raise ModelError(f"'{network.name}': these flanges cannot be published:", problems)
    return edited, terminals


def _flange(network: Network, path: str) -> tuple[PortRef, Domain]:
    owner: Component = network
    *parts, last = path.split(".")
    for part in parts:
        known = parts_of(owner)
        if part not in known:
            raise UnknownNameError(
                f"there is no flange '{path}': no component '{part}'{nearest(part, known)}"
            )
        owner = known[part]
    flanges = {n: f for n, f in type(owner).fields.items() if isinstance(f, Port)}
    if last not in flanges:
        raise UnknownNameError(f"there is no flange '{path}'{nearest(last, flanges)}")
    domain = flanges[last].domain
    if not isinstance(domain, Domain):
        raise ModelError(f"'{path}' is a {domain} port; a terminal is a flange that slides or turns")
    return PortRef(owner, last), domain


def _part(domain: Domain, causality: str) -> tuple[Network, list[PortRef], dict[str, str]]:
    """Return the sources and sensors that publish a flange, their ports to join to it, and its members."""
    family, across, through = FAMILIES[domain], domain.across, domain.through
    if causality == "motion-in":
        part = Network("terminal", sensor=family.ForceSensor(), motion=family.Position())
        part.connect(part.sensor.flange_b, part.motion.flange)
        return part, [part.sensor.flange_a], {through: f"sensor.{through}", across: f"motion.{across}_ref"}
    parts = {"force": family.Force()} if causality == "force-in" else {}
    parts["position"], parts["speed"] = family.PositionSensor(), family.SpeedSensor()
    parts["acceleration"] = family.AccelerationSensor()
    members = {through: f"force.{through}"} if causality == "force-in" else {}
    members |= {across: f"position.{across}", domain.speed: f"speed.{domain.speed}", "a": "acceleration.a"}
    return Network("terminal", **parts), [PortRef(one, "flange") for one in parts.values()], members


def terminals_xml(terminals: Sequence[Terminal], names: Iterable[str], icon: Icon | None = None) -> bytes:
    """Return terminalsAndIcons.xml; derivatives of a prescribed motion are members where they are inputs."""
    known = set(names)
    root = ET.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    if icon is not None:
        shown = ET.SubElement(root, "GraphicalRepresentation")
        corners = {"x1": "0", "y1": "0", "x2": repr(icon.width), "y2": repr(icon.height)}
        ET.SubElement(
            shown, "CoordinateSystem", corners | {"suggestedScalingFactorTo_mm": repr(MM_PER_PIXEL)}
        )
        ET.SubElement(shown, "Icon", corners)
    listed = ET.SubElement(root, "Terminals") if terminals else root
    for terminal in terminals:
        kind = f"{terminal.domain} flange, {terminal.causality}"
        told = {"name": terminal.flange, "matchingRule": "plug", "terminalKind": kind}
        entry = ET.SubElement(listed, "Terminal", told)
        for member, name in members(terminal, known).items():
            told = {"variableName": name, "memberName": member, "variableKind": "signal"}
            ET.SubElement(entry, "TerminalMemberVariable", told)
    return text(root)


def members(terminal: Terminal, known: Collection[str]) -> dict[str, str]:
    """Return the members of a terminal among known variables; a prescribed motion may come with its rates."""
    told = dict(terminal.members)
    if terminal.causality == "motion-in":
        motion = told[terminal.domain.across]
        told |= {terminal.domain.speed: f"der({motion})", "a": f"der({motion},2)"}
    return {member: name for member, name in told.items() if name in known}
