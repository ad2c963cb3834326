"""Systems: composites as Modelica classes, their parts declared, valued and connected."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from ..base import ModelError
from ..components.language import (
    Parameter,
    Port,
    PortRef,
    fields_of,
    parts_of,
)
from ..networks import DAE
from .element import Lines, connector_kind, element_lines
from .expressions import number
from .library import Counterpart, counterpart
from .names import identifier, quoted

Ends = tuple[str, str]  # path of a component, name of a port


class System:
    """A network as Modelica classes: `classes` by name, in the order in which they are needed.

    Where `msl` is true, elements of the Modelica Standard Library stand for those of ours that say the same.
    `starts` are modifications of variables, by their path.
    """

    def __init__(self, dae: DAE, msl: bool, starts: dict[str, str]) -> None:
        self.classes: dict[str, str] = {}
        self.connectors: dict[str, Any] = {}
        self._instances, self._msl = dae.flat.instances, msl
        self._paths = {id(i.component): path for path, i in self._instances.items()}
        self._starts: dict[str, dict[str, str]] = defaultdict(dict)
        for path, attributes in starts.items():
            owner, local = next(dae.flat.owners(path))
            self._starts[owner.path][local] = attributes
        self._shown: dict[str, dict[str, Ends]] = defaultdict(dict)  # what composites show of their inside
        self._nodes: dict[str, list[list[str]]] = defaultdict(list)
        self._joined: set[Ends] = set()
        self._names: dict[str, str] = {}
        for path in self._instances:
            self._connect(path)

    def counterpart(self, path: str) -> Counterpart | None:
        """Return the class of MSL that stands for a component, if one does."""
        return counterpart(self._instances[path].component) if self._msl else None

    def refer(self, owner: str, path: str, port: str) -> str:
        """Return what a port is called in a component around it, which shows it if it lies deeper."""
        if path == owner:
            return identifier(port)
        inside = path.removeprefix(f"{owner}.") if owner else path
        child, _, rest = inside.partition(".")
        if not rest:
            known = self.counterpart(path)
            port = known.renamed.get(port, port) if known else port
            return f"{identifier(child)}.{identifier(port)}"
        name = identifier(f"{rest.replace('.', '_')}_{port}")
        full = f"{owner}.{child}" if owner else child
        self._shown[full][name] = path, port
        self.refer(full, path, port)
        return f"{identifier(child)}.{name}"

    def _connect(self, path: str) -> None:
        component = self._instances[path].component
        near: dict[Ends, Ends] = {}
        for port, inner, outer in component.insertions():
            at, first, far = map(self._ends, (port, inner, outer))
            near[at] = far
            self._joined |= {at, first}
            self._nodes[path].append([self.refer(path, *at), self.refer(path, *first)])
        for ports in component.connections():
            ends = [self._ends(port) for port in ports]
            for k, end in enumerate(ends):
                while end in near and end[0] != path:
                    end = ends[k] = near[end]
            self._joined.update(end for end in ends if end[0] != path)
            self._nodes[path].append([self.refer(path, *end) for end in ends])
        deep = [port for port, *_ in component.insertions() if "." in self._paths[id(port.component)]]
        if deep:
            raise ModelError(
                f"an element is inserted at {deep[0]!r}, inside a part, which Modelica cannot; "
                "build the part with it"
            )

    def _ends(self, port: PortRef) -> Ends:
        return self._paths[id(port.component)], port.name

    def write(self, path: str, extra: Lines | None = None, name: str = "") -> str:
        """Write the class of a component, unless there is one; return its name."""
        known = self.counterpart(path)
        if known is not None:
            return known.name
        instance = self._instances[path]
        component, kind = instance.component, type(instance.component)
        lines = element_lines(component, instance.template, str(instance))
        for shown, (inside, port) in self._shown[path].items():
            declared: Any = type(self._instances[inside].component).fields[port]
            lines.connectors[connector_kind(declared)] = declared
            lines.declarations.append(f"{connector_kind(declared)} {shown};")
            lines.equations.append(f"connect({shown}, {self.refer(path, inside, port)});")
        for child, part in parts_of(component).items():
            self._part(lines, child, instance.full(child), part)
        for refs in self._nodes[path]:
            lines.equations += [f"connect({refs[0]}, {other});" for other in refs[1:]]
        self.connectors |= lines.connectors
        if extra is not None:
            lines.declarations[:0] = extra.declarations
            lines.equations += extra.equations
        summary = (kind.__doc__ or "").strip().partition("\n")[0] if path else component_title(instance)
        return self._class(name or identifier(kind.__name__), summary, lines)

    def _class(self, wanted: str, summary: str, lines: Lines) -> str:
        body = "\n".join(
            [f" {quoted(summary)}", *(f"  {one}" for one in lines.declarations), "equation"]
            + [f"  {one}" for one in lines.equations]
        )
        if body not in self._names:
            taken, name, count = set(self._names.values()), wanted, 2
            while name in taken:
                name, count = f"{wanted}{count}", count + 1
            self._names[body] = name
            self.classes[name] = f"model {name}{body}\nend {name};"
        return self._names[body]

    def _part(self, lines: Lines, child: str, path: str, part: Any) -> None:
        known, name = self.counterpart(path), identifier(child)
        kind = self.write(path)
        renamed = known.renamed if known else {}
        values = [
            f"{identifier(renamed.get(p.name, p.name))}={number(float(getattr(part, p.name)))}"
            for p in fields_of(part, Parameter)
        ]
        values += [f"{identifier(renamed.get(v, v))}({told})" for v, told in self._starts[path].items()]
        values += [f"{option}={value}" for option, value in (known.fixed if known else {}).items()]
        if known and known.supported and (path, "support") in self._joined:
            values.append("useSupport=true")
        told = f"({', '.join(values)})" if values else ""
        lines.declarations.append(f"{kind} {name}{told};")
        if not known:
            self._ground(lines, path, part, name)

    def _ground(self, lines: Lines, path: str, part: Any, name: str) -> None:
        """Hold the supports of a part that are connected to nothing."""
        for port in fields_of(part, Port):
            if not port.optional or (path, port.name) in self._joined:
                continue
            kind = type(port).__name__
            held = f"{kind}Held"
            text = f'"what a support stands on"\n  {kind} flange;\nequation\n  flange.{port.across} = 0;'
            self.classes.setdefault(held, f"model {held} {text}\nend {held};")
            ground = f"{name}_{identifier(port.name)}_ground"
            lines.declarations.append(f"{held} {ground};")
            lines.equations.append(f"connect({name}.{identifier(port.name)}, {ground}.flange);")


def component_title(instance: Any) -> str:
    """Return what a network says of itself."""
    name = getattr(instance.component, "name", type(instance.component).__name__)
    return f"{name}: a network of 1-D mechanics"
