"""Sites: where in a network an effect may hide."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any

from ...components import (
    FAMILIES,
    Compliant,
    Component,
    Domain,
    Fixed,
    Friction,
    Spring,
    SpringDamper,
    rotational,
)
from ...components.language import Parameter, Port, fields_of, parts_of
from ...networks import Network

# Pairs of ports that face each other: the one that reacts and the one that moves.
_PAIRS = (
    ("support", "flange_b"),
    ("flange_a", "flange_b"),
    ("support_t", "flange_t"),
    ("support_r", "flange_r"),
    ("support", "flange"),
)
SPRINGS = Spring, SpringDamper, rotational.Spring, rotational.SpringDamper
STIFFNESS_UNITS: dict[str, str] = {Domain.TRANSLATIONAL: "N/m", Domain.ROTATIONAL: "N.m/rad"}
GROUND = "ground"
BETWEEN = frozenset({"across", "loaded", "series"})


@dataclass(frozen=True)
class Site:
    """Two flanges between which something may act, or the flange of what has inertia.

    Attributes:
        path: the component's path, by which the site is named.
        domain: that of its flanges, or "channel".
        moving: path of the flange to which an effect in series, or an inertia, is joined.
        fixed: path of the flange that faces it, "ground" if there is none.
        places: what may be put here: "across", "loaded" (across, by a force that loads it), "series", "node".
        rank: 2 if the component dissipates, 1 if it lies between two flanges; such a name says most.
        same: paths of other components between the same two nodes.
        sticks: whether it is dry friction, beside which something must have inertia.
        load: path of the flange through which the force comes that loads it; `moving` if not given.
        neighbours: paths of the sites at one of its nodes, whose forces may load it, too.
        line: paths of the sites that bear its force, too, nothing else being joined between them and it.
        passes_on: whether a force comes through it from a third node, as through a gear or a screw.
        rubs: whether dry friction acts between its flanges, whatever part that is of.
        rest: distance at the start of a run of the nominal model that begins at rest; without one, the mean,
            or where a spring is unstretched if inputs prescribe all motion.
        middle: middle of the range of the distance, in all its runs.
        speed, travel: usual relative speed, and half the range of the distance, in it; of a channel the
            largest size of its signal.
        force: largest force through the site in it.
        passes: how often the motion that returns most passes a place of its range: once, if it never turns.
        largest: largest force through any site of its domain in it.
        inertia: largest inertia of another domain as this site feels it: with as much energy at its speed.
        instant: whether only forces that depend on the present motion can act here.
        grounded: whether one of its flanges is held by the ground.
        spring: what it is made with, by name, if it is a linear spring, with or without a damper.
        yields: whether a part that bears its force has a stiffness.
        unstretched: distance at which a linear spring between its nodes bears nothing; None without one.
    """

    path: str
    domain: str
    moving: str
    fixed: str
    places: frozenset[str]
    rank: int = 0
    same: tuple[str, ...] = ()
    sticks: bool = False
    load: str = ""
    neighbours: tuple[str, ...] = ()
    line: tuple[str, ...] = ()
    passes_on: bool = False
    rubs: bool = False
    rest: float = 0.0
    middle: float = 0.0
    speed: float = 1.0
    force: float = 1.0
    travel: float = 1.0
    passes: float = inf
    largest: float = inf
    inertia: float = 0.0
    instant: bool = False
    grounded: bool = False
    spring: tuple[tuple[str, float], ...] = ()
    yields: bool = False
    unstretched: float | None = None

    @property
    def mechanics(self) -> Domain:
        """What its domain calls things; a channel has none."""
        return Domain(self.domain)

    @property
    def family(self) -> Any:
        """The elements of its domain."""
        return FAMILIES[self.domain]

    def holds(self, other: Site) -> bool:
        """Tell whether another site is a part of this one."""
        return other.path.startswith(f"{self.path}.")


def sites_of(network: Network) -> list[Site]:
    """Return the sites of a network; components between the same two nodes are one, named by the deepest."""
    parts = dict(walk(network, ""))
    nodes, held = _nodes(network, parts), set(_held(network, parts))
    node_of = {port: -1 if node & held else number for number, node in enumerate(nodes) for port in node}
    found: dict[frozenset[object], list[Site]] = {}
    for path, part in parts.items():
        site = _site(path, part, node_of)
        if site is not None:
            ends = frozenset(
                node_of.get(port, -1 if port == GROUND else port) for port in (site.fixed, site.moving)
            )
            found.setdefault(ends, []).append(replace(site, grounded=-1 in ends))
    merged = [(ends, site) for ends, group in found.items() if len(ends) == 2 for site in _merged(group)]
    joints = [joint for node in nodes if (joint := _joint(node, parts))]
    yielding = {site.path for _, site in merged if site.yields}
    found_in = ((ends, site, _line(site.path, joints)) for ends, site in merged)
    return [
        replace(
            site,
            neighbours=tuple(_neighbours(ends, merged)),
            line=line,
            yields=not yielding.isdisjoint((site.path, *line)),
        )
        for ends, site, line in found_in
    ]


def _joint(node: set[str], parts: Mapping[str, Component]) -> set[str]:
    """Return the paths of the two parts that a node joins, if each passes on its force; else none."""
    ported = {port.rpartition(".")[0] for port in node}
    joined = {path for path in ported if path not in parts or not parts_of(parts[path])}
    passing = all(isinstance(parts.get(path), Compliant | rotational.Compliant) for path in joined)
    return joined if passing and len(joined) == 2 else set()


def _line(path: str, joints: Sequence[set[str]]) -> tuple[str, ...]:
    """Return the other paths of the line that a path is in."""
    line = {path}
    while more := [joint - line for joint in joints if len(joint & line) == 1]:
        line = line.union(*more)
    return tuple(sorted(line - {path}))


def _neighbours(ends: frozenset[object], sites: Sequence[tuple[frozenset[object], Site]]) -> Iterator[str]:
    """Yield the paths of what passes a force into one of two nodes from elsewhere."""
    for others, site in sites:
        elsewhere = others != ends or site.passes_on
        if elsewhere and others & ends - {-1} and "series" in site.places:
            yield site.path


def surrounded(sites: Sequence[Site], inertias: Mapping[tuple[str, str], float]) -> list[Site]:
    """Return sites that know the largest force through any of their domain, and the inertia behind a screw.

    The inertias of parts are told by their paths and domains: a turning part may have a mass, too.
    """
    forces = {site.domain: max(s.force for s in sites if s.domain == site.domain) for site in sites}
    parts = ((site, (path, site.domain)) for site in sites for path in (site.path, *site.same))
    energies = [(site.domain, inertias[part] * site.speed**2) for site, part in parts if part in inertias]
    found = []
    for site in sites:
        most = max((energy for domain, energy in energies if domain != site.domain), default=0.0)
        felt = most / site.speed**2 if site.speed else 0.0
        found.append(replace(site, largest=forces[site.domain] or inf, inertia=felt))
    return found


def _merged(group: list[Site]) -> Iterator[Site]:
    """Yield one site for what acts between two nodes, one in series with each part, one for each inertia."""
    rubs = any(site.sticks for site in group)
    group = [replace(site, rubs=rubs) for site in group]
    acting = [site for site in group if "series" in site.places]
    inert = [site for site in group if "node" in site.places]
    if acting:
        chosen = max(acting, key=lambda site: (site.path.count("."), site.rank))
        same = tuple(site.path for site in group if site is not chosen)
        yield replace(chosen, same=same, unstretched=_unstretched(chosen, group))
        for site in acting:
            if site is not chosen and not site.holds(chosen):
                yield replace(site, places=frozenset({"series", "loaded"}))
    for number, site in enumerate(inert):
        yield site if number == 0 and not acting else replace(site, places=site.places - {"across"})


def _unstretched(site: Site, group: Sequence[Site]) -> float | None:
    """Return where a spring of a site, or beside it, bears nothing; one beside it may face the other way."""
    name = f"{site.mechanics.across}_rel0"
    if site.spring:
        return dict(site.spring)[name]
    return 0.0 if any(dict(other.spring).get(name) == 0.0 for other in group) else None


def _site(path: str, component: Component, node_of: dict[str, int]) -> Site | None:
    if not component.has_law:
        return None
    fields = type(component).fields
    for fixed, moving in _PAIRS:
        port, facing = fields.get(moving), fields.get(fixed)
        if not isinstance(port, Port):
            continue
        if facing is None and moving == "flange":
            places = frozenset({"across", "node"})
            return Site(path, port.domain, f"{path}.{moving}", GROUND, places)
        if type(facing) is type(port):
            far = f"{path}.{fixed}" if f"{path}.{fixed}" in node_of else GROUND
            rank = 2 if "d" in fields else int("s_rel" in fields or "phi_rel" in fields)
            sticks = isinstance(component, Friction | rotational.Friction)
            found = Site(path, port.domain, f"{path}.{moving}", far, BETWEEN, rank, sticks=sticks)
            passes_on, spring = _passes_on(component, moving, fixed), tuple(_spring(component))
            return replace(found, passes_on=passes_on, spring=spring, yields=_yields(component, port.domain))
    return None


def _passes_on(component: Component, *ends: str) -> bool:
    """Return whether a component has a flange, not a housing, besides those it acts between."""
    ports = fields_of(component, Port)
    return any(isinstance(p.domain, Domain) and not p.optional and p.name not in ends for p in ports)


def _spring(component: Component) -> Iterator[tuple[str, float]]:
    """Yield what a linear spring is made with, by name; nothing of other components."""
    if type(component) not in SPRINGS or getattr(component, "useHeatPort", False):
        return
    made = {field.name: getattr(component, field.name) for field in fields_of(component, Parameter)}
    if all(isinstance(value, float) for value in made.values()) and made.get("k", made.get("c", 0.0)) > 0:
        yield from made.items()


def _yields(component: Component, domain: str) -> bool:
    """Tell whether a component has a stiffness in a domain, not of zero."""
    unit = STIFFNESS_UNITS.get(domain)
    return any(f.unit == unit and getattr(component, f.name) != 0 for f in fields_of(component, Parameter))


def walk(component: Component, path: str) -> Iterator[tuple[str, Component]]:
    """Yield path and component of all parts, outer ones first."""
    for name, part in parts_of(component).items():
        inner = f"{path}.{name}" if path else name
        yield inner, part
        yield from walk(part, inner)


def _held(network: Network, parts: Mapping[str, Component]) -> Iterator[str]:
    """Yield the ports that are the ground's: of a Fixed, or of a housing that nothing is joined to."""
    for path, part in parts.items():
        owner = parts.get(path.rpartition(".")[0], network)
        joined = {
            (id(port.component), port.name)
            for composite in (owner, network)
            for ports in composite.connections()
            for port in ports
        }
        for name, declared in type(part).fields.items():
            if not isinstance(declared, Port):
                continue
            free = declared.optional and (id(part), name) not in joined
            if free or isinstance(part, Fixed | rotational.Fixed):
                yield f"{path}.{name}"


def _nodes(network: Network, parts: dict[str, Component]) -> list[set[str]]:
    """Return the sets of port paths that are one node."""
    paths = {id(part): path for path, part in parts.items()}
    nodes: list[set[str]] = []
    for component in (network, *parts.values()):
        for ports in component.connections():
            node = {f"{paths.get(id(p.component), '')}.{p.name}" for p in ports}
            apart = [other for other in nodes if not other & node]
            nodes = [*apart, node.union(*(other for other in nodes if other & node))]
    return nodes
