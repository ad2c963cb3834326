"""`Network`: components joined at their ports."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import inf
from typing import TYPE_CHECKING, Any, Never, Self

from ..base import ModelError, check_keywords, interruptible, listed, text
from ..components.language import Component, PortRef, parts_of
from .simulation.settings import ATOL, RTOL

if TYPE_CHECKING:
    from .dae import DAE
    from .results.result import Result


class Network(Component):
    """A machine: named components and the nodes that join their ports.

    Args:
        name: what the machine is called in reports and errors.
        components: its components by name; a network may itself be a component of another.

    Example:
        >>> from inertance import Fixed, Mass, Network, Spring
        >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0))
        >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
        >>> _ = net.connect(net.spring.flange_b, net.mass.flange)
        >>> run = net.simulate(1.0, start={"mass.s": 0.1})
        >>> round(float(run["mass.s"][-1]), 4)
        -0.0839
    """

    def __init__(self, name: str = "network", /, **components: Component) -> None:
        super().__init__()
        problem = text(name) or ("" if name.strip() else "must not be empty")
        if problem:
            raise ModelError(f"the name of a Network {problem}, got {name!r}")
        self.name = name
        self._joined: list[tuple[PortRef, ...]] = []
        self._inserted: list[tuple[PortRef, str]] = []
        self.add(**components)

    def add(self, **components: Component) -> Self:
        """Add components by name and return the network."""
        for name, component in components.items():
            if not isinstance(component, Component):
                raise ModelError(f"Network '{self.name}': '{name}' is not a component: {component!r}")
            reserved = name.startswith("_") or name in _RESERVED
            if reserved or not _MARKS.isdisjoint(name):
                raise ModelError(f"Network '{self.name}': '{name}' cannot name a component; choose another")
            if name in self._parts:
                raise ModelError(f"Network '{self.name}' already has a component '{name}'")
            self._parts[name] = component
        return self

    def connect(self, *ports: PortRef) -> Self:
        """Join ports at one node and return the network; one port alone is left free on purpose.

        Nothing acts on a free end. A body (`Mass`, `rotational.Inertia`, ...) may also be left unconnected.

        Raises:
            ModelError: if nothing, or something that is no port, is given.
        """
        told = f"Network '{self.name}': connect() joins ports such as `net.mass.flange`"
        for port in ports:
            if not isinstance(port, PortRef):
                raise ModelError(f"{told}, got {port!r}")
        if not ports:
            raise ModelError(f"{told}, got none")
        self._joined.append(ports)
        return self

    def insert(self, port: PortRef, **element: Component) -> Self:
        """Put a two-terminal element between a port and all it is connected to; return the network.

        The port may belong to a part at any depth. The element's flange_a goes to the port, its flange_b to
        what the port was connected to; what was inserted there before stays between the port and it.

        Args:
            port: a flange, such as `net.inerter.screw.flange_t`.
            element: one element by name, with flange_a and flange_b.

        Raises:
            ModelError: if the port or the element is none.

        Example:
            >>> from inertance import Backlash, Fixed, Mass, Network, Spring
            >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0))
            >>> _ = net.connect(net.wall.flange, net.spring.flange_a)
            >>> _ = net.connect(net.spring.flange_b, net.mass.flange)
            >>> _ = net.insert(net.spring.flange_b, play=Backlash(k=1e6, d=100.0, eps=1e-3))
        """
        told = f"Network '{self.name}': insert() puts an element with flange_a and flange_b at a port"
        if not isinstance(port, PortRef):
            raise ModelError(f"{told} such as `net.mass.flange`, got {port!r}")
        joinable = [{"flange_a", "flange_b"} <= type(e).fields.keys() for e in element.values()]
        if joinable != [True]:
            raise ModelError(f"{told}, got {', '.join(map(repr, element.values())) or 'none'}")
        self.add(**element)
        self._inserted.append((self._end_of(port), next(iter(element))))
        return self

    def _end_of(self, port: PortRef) -> PortRef:
        """Return the far flange of what is inserted at a port; the port itself if nothing is."""
        for at, _, far in self.insertions():
            if at.component is port.component and at.name == port.name:
                return self._end_of(far)
        return port

    def connections(self) -> Iterable[tuple[PortRef, ...]]:
        """Return the nodes made by `connect`."""
        return self._joined

    def insertions(self) -> Iterable[tuple[PortRef, PortRef, PortRef]]:
        """Yield the ports at which `insert` put an element, with the flanges of that element."""
        for port, name in self._inserted:
            element = self._parts[name]
            yield port, PortRef(element, "flange_a"), PortRef(element, "flange_b")

    def with_values(self, **values: Any) -> Self:
        """Return a copy with some components exchanged; connections go to the new ones.

        Args:
            values: components by name; those inside others by path, as in `**{"axle.spring": Spring(k=9.0)}`.

        Raises:
            ModelError: for a name the network does not have, with the nearest one; for a component without a
                port at which the other is joined.
        """
        from .changes import exchange

        copy = self.clone()
        for path, component in values.items():
            if not isinstance(component, Component):
                raise ModelError(f"Network '{self.name}': '{path}' takes a component, got {component!r}")
            exchange(copy, path, component)
        return copy

    def without(self, *paths: str) -> Self:
        """Return a copy without some components; what was joined at their ports stays joined.

        An element that `insert` put at a port leaves what it stood between joined to each other.

        Args:
            paths: names of components; of those inside other networks, paths such as "axle.damper".

        Raises:
            ModelError: for a path that leads nowhere, with the nearest name; for a part that its component
                cannot be without; for a component at which another one is inserted.

        Example:
            >>> from inertance import Damper, Fixed, Mass, Network, Spring
            >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0))
            >>> _ = net.add(damper=Damper(d=2.0))
            >>> _ = net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
            >>> _ = net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange)
            >>> net.without("damper")
            <Network 'oscillator': wall: Fixed, spring: Spring, mass: Mass>
        """
        from .changes import remove

        copy = self.clone()
        for path in listed("paths", paths):
            remove(copy, path)
        return copy

    def clone(self) -> Self:
        """Return an independent copy, connections included."""
        copy = super().clone()
        copy._refer(dict(_pairs(self, copy)))
        return copy

    def _refer(self, twins: Mapping[Component, Component]) -> None:
        """Let connections and insertions refer to other components."""

        def twin(port: PortRef) -> PortRef:
            return PortRef(twins.get(port.component, port.component), port.name)

        self._joined = [tuple(twin(port) for port in ports) for ports in self._joined]
        self._inserted = [(twin(port), name) for port, name in self._inserted]

    @interruptible()
    def dae(self) -> DAE:
        """Return the network's equations: flattened, reduced to index 1, states chosen."""
        from .flattening.flatten import flatten
        from .reduction.reduce import reduce

        return reduce(flatten(self))

    def simulate(
        self,
        stop: float,
        *,
        start: Mapping[str, float] | None = None,
        guess: Mapping[str, float] | None = None,
        inputs: Mapping[str, Any] | None = None,
        parameters: Mapping[str, float] | None = None,
        begin: float = 0.0,
        step: float | None = None,
        rtol: float = RTOL,
        atol: float = ATOL,
        solver: str = "auto",
        sensitivities: Iterable[str] = (),
        progress: bool | None = None,
        max_steps: int | None = None,
        max_step: float = inf,
        **unknown: Never,
    ) -> Result:
        """Assemble and run the network; see `inertance.simulate` for the arguments and errors."""
        from .simulation.simulate import simulate

        check_keywords("simulate()", unknown, simulate)
        return simulate(
            self, stop, start=start, guess=guess, inputs=inputs, parameters=parameters, begin=begin,
            step=step, rtol=rtol, atol=atol, solver=solver, sensitivities=sensitivities, progress=progress,
            max_steps=max_steps, max_step=max_step,
        )  # fmt: skip

    def __repr__(self) -> str:
        parts = ", ".join(f"{n}: {type(c).__name__}" for n, c in self._parts.items())
        return f"<Network '{self.name}': {parts}>"

    def _repr_html_(self) -> str:
        from .results.notebook import network_html

        return network_html(self)


_RESERVED = {*dir(Network), "", "name"}
_MARKS = {*".()"}


def _pairs(original: Component, copy: Component) -> Iterable[tuple[Component, Component]]:
    yield original, copy
    for name, part in parts_of(original).items():
        yield from _pairs(part, copy._parts[name])
