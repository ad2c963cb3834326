"""A drawing of a network in SVG: components as boxes, joined from left to right."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import escape

from ...components.language import Component, Port, PortRef, fields_of, parts_of

MOST_BOXES = 60
ROW, GAP, BOX = 52, 46, 36
COLOURS = {
    "translational": "#4477aa",
    "rotational": "#ee6677",
    "both": "#aa3377",
    "thermal": "#ccbb44",
    "": "#228833",
}
MARK_COLOUR = "#cc3311"


@dataclass(eq=False)
class _Box:
    """What is drawn: a component, a port of the composite itself, or a node (no label)."""

    label: str = ""
    kind: str = ""
    colour: str = ""
    mark: str = ""
    joined: list[_Box] = field(default_factory=list)
    layer: int = -1
    x: float = 0.0
    y: float = 0.0

    @property
    def width(self) -> float:
        """Width in pixels, by the longest text."""
        longest = max(len(self.label), 0.85 * len(self.kind), 0.85 * len(self.mark))
        return 16 + 7.2 * longest if self.label else 8.0


@dataclass(frozen=True, eq=False)
class _Wire:
    left: _Box
    right: _Box
    told: str
    signal: bool


def svg_sketch(component: Component, marks: Mapping[str, str] | None = None) -> str:
    """Return the parts of a composite, some marked by a word, joined, as SVG; empty if too many."""
    boxes, lines = _graph(component, marks or {})
    if not boxes or len(boxes) > MOST_BOXES:
        return ""
    _lay_out(boxes)
    width = max(box.x + box.width / 2 for box in boxes) + GAP / 2
    height = max(box.y for box in boxes) + BOX / 2 + 10
    drawn = [_drawn_line(line) for line in lines] + [_drawn_box(box) for box in boxes]
    return (
        f'<svg width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}" '
        f'role="img" style="font:12px sans-serif;fill:currentColor">{"".join(drawn)}</svg>'
    )


def _graph(component: Component, marks: Mapping[str, str]) -> tuple[list[_Box], list[_Wire]]:
    parts = {
        name: _Box(name, type(part).__name__, _colour(part), marks.get(name, ""))
        for name, part in parts_of(component).items()
    }
    paths = {id(part): path for path, part in inner_parts(component, "")}
    outer: dict[str, _Box] = {}
    nodes: list[_Box] = []
    lines: list[_Wire] = []
    for ports in joined_nodes(component):
        told = " — ".join(f"{paths.get(id(p.component), '')}.{p.name}".lstrip(".") for p in ports)
        ends: list[_Box] = []
        for port in ports:
            if port.component is component:
                ends.append(outer.setdefault(port.name, _Box(port.name)))
            elif id(port.component) in paths:
                ends.append(parts[paths[id(port.component)].partition(".")[0]])
        ends = list(dict.fromkeys(ends))
        signal = not isinstance(type(ports[0].component).fields.get(ports[0].name), Port)
        if len(ends) > 2:
            nodes.append(_Box())
            ends.insert(0, nodes[-1])
        for end in ends[1:]:
            lines.append(_Wire(ends[0], end, told, signal))
            ends[0].joined.append(end)
            end.joined.append(ends[0])
    return [*outer.values(), *parts.values(), *nodes], lines


def inner_parts(component: Component, path: str) -> Iterator[tuple[str, Component]]:
    """Yield parts at any depth with their paths: a node may reach into a part."""
    for name, part in parts_of(component).items():
        yield f"{path}{name}", part
        yield from inner_parts(part, f"{path}{name}.")


def joined_nodes(component: Component) -> list[list[PortRef]]:
    """Return the ports of each node; connections that share a port make one node."""
    node_of: dict[tuple[int, str], dict[tuple[int, str], PortRef]] = {}
    for ports in _joined(component):
        node = {_key(port): port for port in ports}
        for key in list(node):
            node |= node_of.get(key, {})
        node_of |= dict.fromkeys(node, node)
    return [list(node.values()) for node in {id(n): n for n in node_of.values()}.values()]


def _joined(component: Component) -> Iterator[tuple[PortRef, ...]]:
    """Yield connections, those of a port at which an element was inserted going to its far flange."""
    far_of = {}
    joined = {_key(port) for ports in component.connections() for port in ports}
    for port, near, far in component.insertions():
        yield port, near
        if _key(port) in joined:
            far_of[_key(port)] = far
            joined.add(_key(far))
        else:
            yield port, far

    def end_of(port: PortRef) -> PortRef:
        far = far_of.get(_key(port))
        return port if far is None else end_of(far)

    for ports in component.connections():
        yield tuple(end_of(port) for port in ports)


def _key(port: PortRef) -> tuple[int, str]:
    return id(port.component), port.name


def _colour(component: Component) -> str:
    domains = {port.domain for port in fields_of(component, Port)}
    return COLOURS["both" if len(domains) > 1 else "".join(domains & COLOURS.keys())]


def _lay_out(boxes: list[_Box]) -> None:
    """Place boxes in layers by their distance from the ground (or the first), each piece below."""
    top = 8.0
    for root in sorted(boxes, key=lambda box: (box.kind != "Fixed", not box.label)):
        if root.layer < 0:
            top = _place(_layers(root), top)


def _layers(root: _Box) -> list[list[_Box]]:
    root.layer, layers = 0, [[root]]
    while layers[-1]:
        following = dict.fromkeys(other for box in layers[-1] for other in box.joined if other.layer < 0)
        for box in following:
            box.layer = len(layers)
        layers.append(list(following))
    return layers[:-1]


def _place(layers: list[list[_Box]], top: float) -> float:
    height = ROW * max(len(layer) for layer in layers)
    x = 10.0
    for layer in layers:
        width = max(box.width for box in layer)
        layer.sort(key=_height_on_its_left)
        first = top + (height - ROW * len(layer)) / 2 + ROW / 2
        for row, box in enumerate(layer):
            box.x, box.y = x + width / 2, first + ROW * row
        x += width + GAP
    return top + height


def _height_on_its_left(box: _Box) -> float:
    """Return the mean height of what a box is joined to on its left; sorted by it, few lines cross."""
    left = [other.y for other in box.joined if other.layer == box.layer - 1]
    return sum(left) / len(left) if left else 0.0


def _drawn_line(line: _Wire) -> str:
    a, b = sorted((line.left, line.right), key=lambda box: box.x)
    x1, x2 = a.x + a.width / 2, b.x - b.width / 2
    bend = GAP / 2
    if a.layer == b.layer:
        x2 = b.x + b.width / 2
    path_end = x2 + bend if a.layer == b.layer else x2 - bend
    dashes = ' stroke-dasharray="4 3"' if line.signal else ""
    return (
        f'<path d="M{x1:.1f} {a.y:.1f} C{x1 + bend:.1f} {a.y:.1f} {path_end:.1f} {b.y:.1f} '
        f'{x2:.1f} {b.y:.1f}" fill="none" stroke="currentColor" stroke-opacity="0.55" '
        f'stroke-width="1.4"{dashes}><title>{escape(line.told)}</title></path>'
    )


def _drawn_box(box: _Box) -> str:
    if not box.label:
        return f'<circle cx="{box.x:.1f}" cy="{box.y:.1f}" r="4"/>'
    left, up = box.x - box.width / 2, box.y - BOX / 2
    frame = MARK_COLOUR if box.mark else box.colour or "currentColor"
    texts = [
        (box.mark, up - 4, f'font-size="10" fill="{MARK_COLOUR}"'),
        (box.label, box.y - 2 if box.kind else box.y + 4, 'fill-opacity="1.0"'),
        (box.kind, box.y + 12, 'fill-opacity="0.65"'),
    ]
    return (
        f'<rect x="{left:.1f}" y="{up:.1f}" width="{box.width:.1f}" height="{BOX}" rx="4" '
        f'fill="{box.colour or "none"}" fill-opacity="0.12" '
        f'stroke="{frame}" stroke-width="{3 if box.mark else 1.3}"/>'
    ) + "".join(
        f'<text x="{box.x:.1f}" y="{y:.1f}" text-anchor="middle" {style}>{escape(text)}</text>'
        for text, y, style in texts
        if text
    )
