"""Export: a network as one Modelica model."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from ..base import ModelError, boolean, check_output, demand, is_number, named, path_of, shown, write_text
from ..base.checks import above
from ..base.quiet import numpy_on_symbols
from ..components.language import Port
from ..networks import DAE, Input, Network, dae_of, simulate
from .element import Lines
from .expressions import Printer, number
from .library import CONNECTORS
from .names import identifier, quoted, unit
from .system import System

START_SHARE = 1e-9  # of the run, which tells where it starts


def to_modelica(
    network: Network | DAE,
    *,
    msl: bool = True,
    start: Mapping[str, float] | None = None,
    stop: float = 1.0,
    tolerance: float = 1e-6,
) -> str:
    """Return a network as the text of one Modelica model, of the network's name.

    Elements that the Modelica Standard Library (MSL 4.1.0) has are taken from there; of others, and of all
    with `msl=False`, the model holds classes with our equations, and needs no library. Composites become
    classes, modes integers that `when` changes, and states start where the native run starts: those values
    are numbers of the text. An input without a signal becomes an input of the model, `a.b` as `a_b`.

    Args:
        network: a network, or its equations.
        msl: whether to take elements from the Modelica Standard Library.
        start: fixed start values by name, as for `simulate`.
        stop: end of the experiment that the text suggests [s].
        tolerance: relative tolerance that it suggests.

    Raises:
        ModelError: for what Modelica cannot say, by its name: shocks (HardStop), sampled data, an element
            inserted inside a part; and for wrong arguments.

    Example:
        >>> from inertance import Fixed, Mass, Network, Spring, to_modelica
        >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0, s=0.1))
        >>> net = net.connect(net.wall.flange, net.spring.flange_a)
        >>> net = net.connect(net.spring.flange_b, net.mass.flange)
        >>> print(to_modelica(net).splitlines()[1].strip())
        Modelica.Mechanics.Translational.Components.Fixed wall(s0=0);
    """
    demand(
        "to_modelica()",
        msl=(msl, boolean),
        stop=(stop, above(0.0, "s")),
        tolerance=(tolerance, above(0.0)),
    )
    dae = dae_of(network)
    system = System(dae, msl, _starts(dae, stop, named("start", start)))
    extra = Lines()
    for declared in dae.inputs:
        if declared.order == 0:
            _drive(system, extra, dae, declared)
    name = identifier(dae.name)
    wanted = system.write("", extra, name)
    assert wanted == name
    return _text(system, name, msl, f"StopTime={number(stop)}, Tolerance={number(tolerance)}")


def write_modelica(network: Network | DAE, path: str | Path, **options: Any) -> Path:
    """Write a network as a Modelica file; see `to_modelica`.

    Args:
        network: a network, or its equations.
        path: where to write, ending in `.mo`.
        options: of `to_modelica`.

    Raises:
        ModelError: as there, and for a path that cannot be written.
    """
    target = path_of(path, "a Modelica model")
    if target.suffix != ".mo":
        raise ModelError(f"a Modelica model is written to a file that ends in '.mo', got '{path}'")
    check_output(target)
    return write_text(target, to_modelica(network, **options))


def _starts(dae: DAE, stop: float, start: dict[str, float]) -> dict[str, str]:
    """Return the attributes of states and modes that start where a native run does, by path."""
    resting = {i.path: 0.0 for i in dae.inputs if i.order == 0 and i.signal is None}
    run = simulate(dae, stop * START_SHARE, start=start, inputs=resting)
    first = int(np.flatnonzero(run.time == run.time[0])[-1])
    found = {name: f"start={number(float(run[name][first]))}, fixed=true" for name in dae.state_names}
    moving = {change.mode for change in dae.switching.changes}
    modes = {name: k for k, name in enumerate(dae.switching.mode_names) if k in moving}
    return found | {name: f"start={int(run[name][first])}, fixed=true" for name in modes}


def _drive(system: System, lines: Lines, dae: DAE, declared: Input) -> None:
    """State where an input of the network comes from."""
    owner, _, port = declared.path.rpartition(".")
    inside, signal = system.refer("", owner, port), declared.signal
    if signal is None:
        name, measure = declared.path.replace(".", "_"), unit(declared.unit)
        lines.declarations.append(f"input Real {identifier(name)}{f'({measure})' if measure else ''};")
        lines.equations.append(f"{inside} = {identifier(name)};")
        return
    time = ca.SX.sym("time")
    if not is_number(signal) and not callable(signal):
        raise ModelError(
            f"input '{declared.path}': sampled data have no place in one Modelica text, got {shown(signal)}; "
            "give a function of time, or leave the input free and give the data in the other tool"
        )
    with numpy_on_symbols():
        given: Any = signal(time) if callable(signal) else signal
        value = ca.SX(given)
    lines.equations.append(f"{inside} = {Printer({time.element_hash(): 'time'}).number(value)};")


def _text(system: System, name: str, msl: bool, experiment: str) -> str:
    """Return the model with the classes that it needs inside."""
    *inner, whole = system.classes.values()
    kinds = [_connector(kind, declared, msl) for kind, declared in sorted(system.connectors.items())]
    head, _, rest = whole.partition("\n")
    local = "\n\n".join([*kinds, *inner])
    indented = "\n".join(f"  {line}" if line else "" for line in local.splitlines())
    body, _, end = rest.rpartition("\n")
    parts = [head, *([indented, ""] if local else []), body, f"  annotation(experiment({experiment}));", end]
    return "\n".join(parts) + "\n"


def _connector(kind: str, declared: Any, msl: bool) -> str:
    if msl and kind in CONNECTORS:
        return f"connector {kind} = {CONNECTORS[kind]};"
    if not isinstance(declared, Port):
        return f"connector {kind} = {kind.removeprefix('Real').lower()} Real {quoted('a signal')};"
    across, through = (f"({told})" if (told := unit(name)) else "" for name in declared.units)
    return (
        f"connector {kind} {quoted(f'{declared.domain} port')}\n  Real {declared.across}{across};\n"
        f"  flow Real {declared.through}{through};\nend {kind};"
    )
