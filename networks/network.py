"""`Network`: components joined at their ports."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Self

from ..components.base import Component, ModelError, PortRef, nearest

if TYPE_CHECKING:
    from .dae import DAE
    from .result import Result


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
        self.name = name
        self._joined: list[tuple[PortRef, ...]] = []
        self.add(**components)

    def add(self, **components: Component) -> Self:
        """Add components by name and return the network."""
        for name, component in components.items():
            if not isinstance(component, Component):
                raise ModelError(f"Network '{self.name}': '{name}' is not a component: {component!r}")
            if name.startswith("_") or "." in name or hasattr(Network, name) or name == "name":
                raise ModelError(f"Network '{self.name}': '{name}' cannot name a component; choose another")
            if name in self._parts:
                raise ModelError(f"Network '{self.name}' already has a component '{name}'")
            self._parts[name] = component
        return self

    def connect(self, *ports: PortRef) -> Self:
        """Join two or more ports at one node and return the network.

        Raises:
            ModelError: if something that is no port is given.
        """
        for port in ports:
            if not isinstance(port, PortRef):
                raise ModelError(
                    f"Network '{self.name}': connect() joins ports such as `net.mass.flange`, got {port!r}"
                )
        self._joined.append(ports)
        return self

    def connections(self) -> Iterable[tuple[PortRef, ...]]:
        """Return the nodes made by `connect`."""
        return self._joined

    def with_values(self, **values: Any) -> Self:
        """Return a copy with some components exchanged; connections go to the new ones.

        Raises:
            ModelError: for a name the network does not have, with the nearest one.
        """
        copy = self.clone()
        for name, component in values.items():
            if name not in copy._parts or not isinstance(component, Component):
                known = nearest(name, copy._parts)
                raise ModelError(f"Network '{self.name}' has no component '{name}'{known} to exchange")
            old, copy._parts[name] = copy._parts[name], component
            copy._joined = [
                tuple(PortRef(component, p.name) if p.component is old else p for p in ports)
                for ports in copy._joined
            ]
        return copy

    def clone(self) -> Self:
        """Return an independent copy, connections included."""
        copy = super().clone()
        twins = dict(_pairs(self, copy))
        copy._joined = [
            tuple(PortRef(twins.get(port.component, port.component), port.name) for port in ports)
            for ports in self._joined
        ]
        return copy

    def dae(self) -> DAE:
        """Return the network's equations: flattened, reduced to index 1, states chosen."""
        from .flatten import flatten
        from .reduce import reduce

        return reduce(flatten(self))

    def simulate(
        self,
        stop: float,
        *,
        start: Mapping[str, float] | None = None,
        guess: Mapping[str, float] | None = None,
        inputs: Mapping[str, Any] | None = None,
        parameters: Mapping[str, float] | None = None,
        **options: Any,
    ) -> Result:
        """Assemble and run the network; see `DAE.simulate` for the arguments."""
        return self.dae().simulate(
            stop, start=start, guess=guess, inputs=inputs, parameters=parameters, **options
        )

    def __repr__(self) -> str:
        parts = ", ".join(f"{n}: {type(c).__name__}" for n, c in self._parts.items())
        return f"<Network '{self.name}': {parts}>"

    def _repr_html_(self) -> str:
        from .notebook import network_html

        return network_html(self)


def _pairs(original: Component, copy: Component) -> Iterable[tuple[Component, Component]]:
    yield original, copy
    for name, part in original._parts.items():
        yield from _pairs(part, copy._parts[name])
