"""Split: a network cut into two, each side with the causality that the coupling needs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...base import listed, nearest, shown
from ...components import Component, ModelError
from ...components.language import PortRef, parts_of
from ...networks import Network, network_of
from ..export.export import export_fmu
from ..export.terminals import members, publish
from ..fmu import FMU
from .system import Connection, SystemStructure

Flange = tuple[int, str]


@dataclass(frozen=True)
class Split:
    """A network in two; each of its sides becomes an FMU.

    Attributes:
        name: of the whole.
        sides: the two networks by name, as they are, not yet published.
        terminals: by side, the flanges to publish with their causality.
        pairs: flanges that stand for one another, (side, flange) each.
    """

    name: str
    sides: dict[str, Network]
    terminals: dict[str, dict[str, str]]
    pairs: list[tuple[tuple[str, str], tuple[str, str]]]

    def export(self, folder: str | Path, **options: Any) -> SystemStructure:
        """Write both sides as `<side>.fmu` into a folder and return the system that they form.

        Args:
            folder: an existing one.
            options: of `export_fmu`, for both. Names in `outputs` (besides what the coupling needs), `inputs`
                and `start` are those of the whole network; each goes to the sides that have the component.

        Raises:
            ModelError: for names of components that there are not, and whatever `export_fmu` refuses.
        """
        shared: dict[str, dict[str, Any]] = {
            "outputs": dict.fromkeys(options.pop("outputs", ())),
            "inputs": dict.fromkeys(options.pop("inputs", ())),
            "start": dict(options.pop("start", {})),
        }
        self._check(name for names in shared.values() for name in names)
        fmus, published = {}, {}
        for side, network in self.sides.items():
            published[side] = {t.flange: t for t in publish(network, self.terminals[side])[1]}
            own = {
                key: {n: v for n, v in names.items() if n.partition(".")[0] in parts_of(network)}
                for key, names in shared.items()
            }
            path = Path(folder) / f"{side}.fmu"
            outputs = [*own["outputs"], *(o for t in published[side].values() for o in t.outputs)]
            export_fmu(
                network, path, terminals=self.terminals[side], outputs=outputs, inputs=own["inputs"],
                start=own["start"], **options,
            )  # fmt: skip
            fmus[side] = FMU(path)
        system = SystemStructure(self.name, fmus, stop=options.get("stop", 1.0))
        for pair in self.pairs:
            for (a, flange), (b, other) in (pair, pair[::-1]):
                given = members(published[a][flange], fmus[a].outputs)
                taken = members(published[b][other], fmus[b].inputs)
                met = [m for m in taken if m in given]
                system.connections += [Connection(f"{a}.{given[m]}", f"{b}.{taken[m]}") for m in met]
        return system

    def _check(self, names: Iterable[str]) -> None:
        parts = [part for network in self.sides.values() for part in parts_of(network)]
        problems = [
            f"'{name}': there is no component '{part}'{nearest(part, parts)}"
            for name in names
            if (part := name.partition(".")[0]) not in parts
        ]
        if problems:
            raise ModelError(f"'{self.name}' in two cannot be exported:", problems)


def split(
    network: Network,
    first: Iterable[str],
    *,
    through: Iterable[str] = (),
    names: tuple[str, str] = ("first", "second"),
) -> Split:
    """Cut a network into two that exchange forces and motions, for co-simulation.

    Force/displacement: at every node where both sides meet, the first takes a force and gives its motion,
    the second takes the motion and gives the force. The first should have the mass at the cut.

    Displacement/displacement: the cut goes `through` coupling elements, which both sides hold; each is
    told the motion of the other's end. Both sides should have a mass there, and the elements none: what has
    a state inside is simulated twice.

    Args:
        network: stays as it is.
        first: names of the components of the first side; the second has the rest.
        through: names of the coupling elements, which neither side owns.
        names: of the two sides.

    Raises:
        ModelError: for unknown names, sides that do not touch, signals that cross, and a coupling element
            at a node of both sides, which would act twice.

    Example:
        >>> from inertance import Fixed, Mass, Network, Spring
        >>> from inertance.fmu import split
        >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0))
        >>> net = net.connect(net.wall.flange, net.spring.flange_a)
        >>> net = net.connect(net.spring.flange_b, net.mass.flange)
        >>> split(net, ["mass"]).terminals
        {'first': {'mass.flange': 'force-in'}, 'second': {'spring.flange_b': 'motion-in'}}
    """
    if len(listed("names", names)) != 2:
        raise ModelError(f"names are those of the two sides, got {shown(names)}")
    sides = set(listed("first", first)), set(listed("through", through))
    return _Cut(network_of(network).clone(), *sides).split(names)


class _Cut:
    """A network that is being cut; side 0 is the first, 1 the second, 2 the coupling elements."""

    def __init__(self, network: Network, first: set[str], through: set[str]) -> None:
        self.network, self.problems = network, list[str]()
        parts = parts_of(network)
        unknown, twice = sorted((first | through) - set(parts)), sorted(first & through)
        self.problems += [f"there is no component '{n}'{nearest(n, parts)}" for n in unknown]
        self.problems += [f"'{n}' is in `first` and in `through`; give it once" for n in twice]
        self.side = {n: 2 if n in through else 0 if n in first else 1 for n in parts}
        self.paths = {id(c): path for name in parts for c, path in _inside(parts[name], name)}
        self.terminals: tuple[dict[str, str], dict[str, str]] = ({}, {})
        self.pairs: list[tuple[Flange, Flange]] = []

    def split(self, names: tuple[str, str]) -> Split:
        nodes = self._nodes()
        for node in nodes:
            self._cut(node)
        whole = self.network.name
        if not self.problems and not self.pairs:
            self.problems.append("the two sides do not touch; name components of one side in `first`")
        sides = {name: self._half(k, nodes) for k, name in enumerate(names)}
        if self.problems:
            raise ModelError(f"'{whole}' cannot be split:", self.problems)
        pairs = [((names[a], p), (names[b], q)) for (a, p), (b, q) in self.pairs]
        return Split(whole, sides, dict(zip(names, self.terminals, strict=True)), pairs)

    def _nodes(self) -> list[list[PortRef]]:
        """Return the ports that are joined, node by node, however many `connect` they took."""
        nodes: list[dict[str, PortRef]] = []
        for ports in self.network.connections():
            joined = {self._path(port): port for port in ports}
            for met in [node for node in reversed(nodes) if node.keys() & joined.keys()]:
                nodes.remove(met)
                joined = met | joined
            nodes.append(joined)
        return [list(node.values()) for node in nodes]

    def _path(self, port: PortRef) -> str:
        return f"{self.paths[id(port.component)]}.{port.name}"

    def _of(self, port: PortRef) -> int:
        return self.side[self._path(port).partition(".")[0]]

    def _cut(self, node: list[PortRef]) -> None:
        ports = [[self._path(p) for p in node if self._of(p) == k] for k in (0, 1, 2)]
        first, second, coupling = ports
        if sum(map(bool, ports)) < 2:
            return
        if node[0].domain is None:
            self.problems.append(
                f"the signal at '{self._path(node[0])}' crosses the cut; keep it on one side"
            )
        elif first and second and coupling:
            self.problems.append(
                f"'{coupling[0]}' of a coupling element meets both sides ('{first[0]}', '{second[0]}') and "
                "would act twice; give the element to one side"
            )
        elif first and second:
            self._publish((0, first[0], "force-in"), (1, second[0], "motion-in"))
        else:
            owner, other = (0, 1) if first else (1, 0)
            self._publish((owner, ports[owner][0], "motion-out"), (other, coupling[0], "motion-in"))

    def _publish(self, one: tuple[int, str, str], other: tuple[int, str, str]) -> None:
        for side, path, causality in (one, other):
            self.terminals[side][path] = causality
        self.pairs.append((one[:2], other[:2]))

    def _half(self, side: int, nodes: list[list[PortRef]]) -> Network:
        """Return the network of one side, with copies of the coupling elements."""
        inserted = {id(a.component): port for port, a, _ in self.network.insertions()}
        parts = {n: c for n, c in parts_of(self.network).items() if self.side[n] in (side, 2)}
        half = Network(self.network.name, **{n: c for n, c in parts.items() if id(c) not in inserted})
        for node in nodes:
            own = [p for p in node if self._of(p) in (side, 2)]
            if len(own) > 1:
                half.connect(*own)
        for name, element in parts.items():
            if (port := inserted.get(id(element))) is None:
                continue
            if self._of(port) != self.side[name]:
                self.problems.append(f"'{name}' is inserted at '{self._path(port)}'; both go to one side")
            else:
                half.insert(port, **{name: element})
        return half.clone()


def _inside(component: Component, path: str) -> Iterable[tuple[Component, str]]:
    yield component, path
    for name, part in parts_of(component).items():
        yield from _inside(part, f"{path}.{name}")
