"""Structures that shake: n-storey shear frames, a taut cable, a machine on mounts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...base import above, between, demand, finite, number, numbers, shown, whole
from ...components import Component, Fixed, Force, Mass, ModelError, Position, Spring, SpringDamper
from ...components.language import PortRef
from ..given import element_of
from ..network import Network


def shear_frame(
    m: Sequence[float],
    k: Sequence[float],
    d: Sequence[float] | None = None,
    absorbers: Mapping[tuple[int, int], Component] | None = None,
) -> Network:
    """Return a frame of floors on columns: `ground`, `storey1`, `floor1`, ..., `absorber1`, ..., `wind`.

    `wind.f` acts on the top floor, `ground.s_ref` moves the base.

    Args:
        m: masses of the floors from below [kg]; one makes a structure of one degree of freedom.
        k: stiffnesses of the storeys from below [N/m].
        d: their damping constants [N.s/m]; none if None.
        absorbers: two-terminal absorbers by the floors (lower, upper) they join; 0 is the ground.

    Raises:
        ModelError: for lengths that differ, or an absorber that does not join two floors that are there.

    Example:
        >>> from inertance.machines import shear_frame, tid
        >>> frame = shear_frame([1e3] * 3, [1.5e6] * 3, absorbers={(0, 1): tid(k=3e4, d=300.0, b=200.0)})
    """
    _check_lists(m, k, d)
    if not (np.ndim(m) == np.ndim(k) == 1 and len(m)):
        raise ModelError(f"a frame needs at least one floor, and lists of m and k; got {m!r} and {k!r}")
    if not (absorbers is None or isinstance(absorbers, Mapping)):
        raise ModelError(f"absorbers maps two floors to what joins them, got {shown(absorbers)}")
    damping = [0.0] * len(m) if d is None else list(d)
    if not len(m) == len(k) == len(damping):
        raise ModelError(f"a frame needs as many m, k and d, got {len(m)}, {len(k)} and {len(damping)}")
    frame = Network("shear frame", ground=Position(s_ref=0.0))
    flanges = [frame.ground.flange]
    for n, (mass, stiffness, loss) in enumerate(zip(m, k, damping, strict=True), start=1):
        storey = SpringDamper(k=stiffness, d=loss) if loss else Spring(k=stiffness)
        floor = Mass(m=mass)
        frame.add(**{f"storey{n}": storey, f"floor{n}": floor})
        frame.connect(flanges[-1], storey.flange_a).connect(storey.flange_b, floor.flange)
        flanges.append(floor.flange)
    _add_absorbers(frame, flanges, absorbers or {})
    frame.add(wind=Force(f=0.0))
    return frame.connect(frame.wind.flange, flanges[-1])


def _add_absorbers(
    frame: Network, flanges: Sequence[PortRef], absorbers: Mapping[tuple[int, int], Component]
) -> None:
    top = len(flanges) - 1
    for count, (floors, absorber) in enumerate(absorbers.items(), start=1):
        if not _joins(floors, top):
            raise ModelError(
                f"absorber {count} joins two floors, (lower, upper), there are 0 to {top}; got {floors}"
            )
        if not {"flange_a", "flange_b"} <= type(element_of(absorber)).fields.keys():
            raise ModelError(f"absorber {count} must have flange_a and flange_b, got {shown(absorber)}")
        lower, upper = (flanges[floor] for floor in floors)
        frame.add(**{f"absorber{count}": absorber})
        frame.connect(absorber.flange_a, lower).connect(absorber.flange_b, upper)


def _joins(floors: Any, top: int) -> bool:
    """Return whether something is a pair of different floors."""
    pair = isinstance(floors, tuple) and len(floors) == 2 and not numbers(whole(0))(floors)
    return pair and max(floors) <= top and floors[0] != floors[1]


def _check_lists(m: Any, k: Any, d: Any) -> None:
    for name, given in (("m", m), ("k", k), ("d", d)):
        if np.ndim(given) == 1 and len(given) and numbers(number)(list(given)):
            raise ModelError(f"{name} must be a list of numbers, one for each floor, got {shown(given)}")
    if not (d is None or (np.ndim(d) == 1 and isinstance(d, Sequence | np.ndarray))):
        raise ModelError(f"d must be a list of numbers, one for each floor, got {shown(d)}")


def taut_cable(
    L: float, T: float, m: float, parts: int = 20, damper: Component | None = None, at: int = 1
) -> Network:
    """Return a cable as beads on a taut string, moving sideways: `left`, `bead1`, ..., `right`, `wind`.

    Args:
        L: length [m].
        T: tension [N].
        m: mass per length [kg/m].
        parts: segments; there is one bead less.
        damper: two-terminal damper from the ground, such as `tvmd(...)`.
        at: the bead it holds.

    Raises:
        ModelError: for a bead that is not there, or no length.

    Limits: the frequency of mode n is low by about (n pi/parts)^2/24.
    """
    demand(
        "taut_cable()",
        L=(L, finite("m")),
        T=(T, above(0, "N")),
        m=(m, above(0, "kg/m")),
        parts=(parts, lambda value: between(2, 100_000)(value) or whole(2)(value)),
        at=(at, whole(1)),
    )
    if not 1 <= at < parts:
        raise ModelError(f"the cable of {parts} parts has beads 1 to {parts - 1}, got {at}")
    if not L > 0:
        raise ModelError(f"the cable needs a length above 0 m, got {L:g}")
    step = L / parts
    cable = Network("taut cable", left=Fixed(), right=Fixed(), wind=Force(f=0.0))
    flanges = [cable.left.flange]
    for n in range(1, parts + 1):
        segment, end = Spring(k=T / step), Mass(m=m * step) if n < parts else cable.right
        cable.add(**{f"segment{n}": segment}, **({f"bead{n}": end} if n < parts else {}))
        cable.connect(flanges[-1], segment.flange_a).connect(segment.flange_b, end.flange)
        flanges.append(end.flange)
    cable.connect(cable.wind.flange, flanges[parts // 2])
    if damper is not None:
        cable.add(damper=damper).connect(damper.flange_a, flanges[0]).connect(damper.flange_b, flanges[at])
    return cable


def isolated_machine(mount: Component, *, m: float = 100.0) -> Network:
    """Return a machine on mounts: `floor`, `mount`, `machine`, `push`.

    `machine.s` over `floor.s_ref` is the transmissibility of motion, `floor.flange.f` over `push.f` that of
    force, up to its sign.

    Args:
        mount: with two flanges, such as `parallel(SpringDamper(...), Inerter(...))`.
        m: mass of the machine [kg].
    """
    net = Network(
        "isolated machine", floor=Position(s_ref=0.0), mount=mount, machine=Mass(m=m), push=Force(f=0.0)
    )
    net.connect(net.floor.flange, net.mount.flange_a)
    return net.connect(net.mount.flange_b, net.machine.flange, net.push.flange)
