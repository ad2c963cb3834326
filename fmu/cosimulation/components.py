"""Components that an FMU stands behind: a signal block, a force, a motion."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...base import rate_unit, unit_of
from ...components import Component, RealInput, RealOutput, RotationalFlange, TranslationalFlange, variable
from ..errors import FMUError
from ..fmu import FMU
from ..foreign.variable import ForeignVariable


@dataclass(frozen=True)
class CouplingOutput:
    """What the network takes from an FMU: a component's input, and the variable it comes from.

    A second variable gives its time derivative, if there is one.
    """

    name: str
    variables: tuple[str, ...]
    sign: float


@dataclass(frozen=True)
class CouplingInput:
    """What an FMU takes from the network: one of its inputs, and `order` times the rate of a variable."""

    input: str
    name: str
    order: int
    sign: float


class ForeignComponent(Component):
    """What all components with an FMU behind them have in common; `cosimulate` runs them.

    Args:
        fmu: the FMU, or the path of its file.
        kind: "ME" or "CS"; Model Exchange first if it has both.
        parameters: values by name, in the FMU's own unit or as (value, unit).
        start: start values by name, likewise.
        values: values of the component's own fields.
    """

    fmu: FMU
    taken: tuple[CouplingInput, ...]
    given: tuple[CouplingOutput, ...]

    def __init__(
        self, fmu: FMU | str | Path, *, kind: str | None = None,
        parameters: Mapping[str, Any] | None = None, start: Mapping[str, Any] | None = None,
        **values: Any,
    ) -> None:  # fmt: skip
        super().__init__(**values)
        self.fmu = fmu if isinstance(fmu, FMU) else FMU(fmu)
        self.kind = self.fmu.kind(kind)
        self.chosen, self.started = dict(parameters or {}), dict(start or {})
        self.taken, self.given = (), ()

    def _take(self, signed: str, name: str, order: int, unit: str) -> None:
        sign, path = _signed(signed)
        _check(self.fmu, self.fmu.variable(path, self.fmu.inputs), unit)
        self.taken += (CouplingInput(path, name, order, sign),)

    def _take_motion(self, name: str, signed: Iterable[str | None], unit: str) -> None:
        """Take a variable of the network, its rate and the rate of that, as far as there are inputs."""
        for order, path in enumerate(signed):
            if path is not None:
                self._take(path, name, order, rate_unit(unit, order))

    def _give(self, name: str, unit: str, *signed: str) -> None:
        signs, paths = zip(*map(_signed, signed), strict=True)
        for order, path in enumerate(paths):
            _check(self.fmu, self.fmu.variable(path), rate_unit(unit, order))
        if len(set(signs)) > 1:
            told = " and ".join(map(repr, signed))
            raise FMUError(f"FMU '{self.fmu.name}': {told} must have the same sign")
        self.given += (CouplingOutput(name, paths, signs[0]),)


class FMUBlock(ForeignComponent):
    """An FMU as a signal block: its inputs are `RealInput`, its outputs `RealOutput`.

    A name of the FMU that is no Python name has its odd characters replaced by `_`: `mass.s` is joined
    as `block.mass_s`. Signals are in the SI units of what the FMU declares.

    Args:
        fmu: the FMU, or the path of its file.
        inputs: its inputs to join; all continuous ones if not given.
        outputs: its outputs to join; all continuous ones if not given.

    Example:
        >>> from inertance.fmu import FMUBlock
        >>> valve = FMUBlock("valve.fmu", inputs=["u"], outputs=["y"])      # doctest: +SKIP
    """

    def __new__(
        cls, fmu: FMU | str | Path, *, inputs: Iterable[str] | None = None,
        outputs: Iterable[str] | None = None, **_: Any,
    ) -> FMUBlock:  # fmt: skip
        fmu = fmu if isinstance(fmu, FMU) else FMU(fmu)
        ins = _chosen(fmu, inputs, fmu.inputs)
        outs = _chosen(fmu, outputs, fmu.outputs if outputs is None else fmu.variables)
        fields: dict[str, Any] = {"_ins": ins, "_outs": outs}
        for v in (*ins, *outs):
            name, unit, doc = _identifier(v.name), fmu.measure(v).si_name, v.text or v.name
            fields[name] = RealInput(unit, doc) if v in ins else RealOutput(unit, doc)
        for v in outs:
            fields[_inner(v.name)] = RealInput(fmu.measure(v).si_name, f"{v.name}, from the FMU")
        made: FMUBlock = object.__new__(type(cls.__name__, (cls,), fields))
        return made

    _ins: tuple[ForeignVariable, ...] = ()
    _outs: tuple[ForeignVariable, ...] = ()

    def __init__(
        self, fmu: FMU | str | Path, *, inputs: Iterable[str] | None = None,
        outputs: Iterable[str] | None = None, **values: Any,
    ) -> None:  # fmt: skip
        super().__init__(fmu, **values)
        for v in self._ins:
            self._take(v.name, _identifier(v.name), 0, "")
        for v in self._outs:
            self._give(_inner(v.name), "", v.name)

    def equations(self) -> Iterable[Any]:
        for v in self._outs:
            yield getattr(self, _identifier(v.name)) == getattr(self, _inner(v.name))


class FMUForce(ForeignComponent):
    """An FMU between two flanges that takes their relative motion and returns a force.

        flange_b.f = f,  flange_a.f = -f,  f = F(s_rel, v_rel, a_rel)

    As for every element between flanges, f is positive when it pulls them together. A minus before a name
    turns the sign of that variable: `force="-F"`.

    Args:
        fmu: the FMU, or the path of its file.
        position: its input for s_rel = flange_b.s - flange_a.s [m].
        velocity: its input for v_rel [m/s].
        acceleration: its input for a_rel [m/s2].
        force: its output [N].

    Limits: with a force that answers to acceleration (an inertance b), coupling is unstable for b above
    the mass that it accelerates, however small the step.

    Example:
        >>> from inertance.fmu import FMUForce
        >>> damper = FMUForce("damper.fmu", velocity="v", force="F")        # doctest: +SKIP
    """

    flange_a = TranslationalFlange("left flange")
    flange_b = TranslationalFlange("right flange")
    s_rel = variable("m", "distance of the flanges")
    f = RealInput("N", "force, from the FMU")

    def __init__(
        self, fmu: FMU | str | Path, *, position: str | None = None, velocity: str | None = None,
        acceleration: str | None = None, force: str, **values: Any,
    ) -> None:  # fmt: skip
        super().__init__(fmu, **values)
        self._take_motion("s_rel", (position, velocity, acceleration), "m")
        self._give("f", "N", force)

    def equations(self) -> Iterable[Any]:
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class FMUTorque(ForeignComponent):
    """An FMU between two shafts that takes their relative motion and returns a torque; see `FMUForce`.

    Args:
        fmu: the FMU, or the path of its file.
        angle: its input for phi_rel = flange_b.phi - flange_a.phi [rad].
        speed: its input for w_rel [rad/s].
        acceleration: its input for a_rel [rad/s2].
        torque: its output [N.m].
    """

    flange_a = RotationalFlange("left flange")
    flange_b = RotationalFlange("right flange")
    phi_rel = variable("rad", "angle between the flanges")
    tau = RealInput("N.m", "torque, from the FMU")

    def __init__(
        self, fmu: FMU | str | Path, *, angle: str | None = None, speed: str | None = None,
        acceleration: str | None = None, torque: str, **values: Any,
    ) -> None:  # fmt: skip
        super().__init__(fmu, **values)
        self._take_motion("phi_rel", (angle, speed, acceleration), "rad")
        self._give("tau", "N.m", torque)

    def equations(self) -> Iterable[Any]:
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau


class FMUMotion(ForeignComponent):
    """An FMU that takes the force on its flange and returns the motion of it.

    Between communication points the flange follows the cubic that meets positions and velocities of the
    FMU at both ends, so that position and velocity never jump (except where the FMU's do).

    Args:
        fmu: the FMU, or the path of its file.
        force: its input for the force that acts on it, flange.f [N].
        position: its output for flange.s [m].
        velocity: its output for the rate of it [m/s].

    Limits: masses joined rigidly to the flange answer with m a, which makes coupling unstable for masses
    above the FMU's own; shocks that act on both are refused. Put compliance between, or the masses into the
    FMU.

    Example:
        >>> from inertance.fmu import FMUMotion
        >>> body = FMUMotion("body.fmu", force="F", position="s", velocity="v")  # doctest: +SKIP
    """

    flange = TranslationalFlange("where the FMU moves")
    s = RealInput("m", "position, from the FMU")
    f = variable("N", "force on the FMU")

    def __init__(
        self, fmu: FMU | str | Path, *, force: str, position: str, velocity: str, **values: Any
    ) -> None:
        super().__init__(fmu, **values)
        self._take(force, "f", 0, "N")
        self._give("s", "m", position, velocity)

    def equations(self) -> Iterable[Any]:
        yield self.flange.s == self.s
        yield self.f == self.flange.f


class FMURotation(ForeignComponent):
    """An FMU that takes the torque on its flange and returns the rotation of it; see `FMUMotion`.

    Args:
        fmu: the FMU, or the path of its file.
        torque: its input for the torque that acts on it, flange.tau [N.m].
        angle: its output for flange.phi [rad].
        speed: its output for the rate of it [rad/s].
    """

    flange = RotationalFlange("where the FMU turns")
    phi = RealInput("rad", "angle, from the FMU")
    tau = variable("N.m", "torque on the FMU")

    def __init__(self, fmu: FMU | str | Path, *, torque: str, angle: str, speed: str, **values: Any) -> None:
        super().__init__(fmu, **values)
        self._take(torque, "tau", 0, "N.m")
        self._give("phi", "rad", angle, speed)

    def equations(self) -> Iterable[Any]:
        yield self.flange.phi == self.phi
        yield self.tau == self.flange.tau


def _signed(name: str) -> tuple[float, str]:
    return (-1.0, name[1:]) if name.startswith("-") else (1.0, name)


def _check(fmu: FMU, v: ForeignVariable, unit: str) -> None:
    if not v.is_signal:
        raise FMUError(f"FMU '{fmu.name}': '{v.name}' is {v.type} of size {v.size}, no real signal")
    if unit and v.unit and not fmu.measure(v).fits(unit_of(unit)):
        raise FMUError(f"FMU '{fmu.name}': '{v.name}' is in {v.unit}, where {unit} belongs")


def _chosen(
    fmu: FMU, names: Iterable[str] | None, known: Mapping[str, ForeignVariable]
) -> tuple[ForeignVariable, ...]:
    if names is None:
        return tuple(v for v in known.values() if v.is_signal)
    return tuple(fmu.variable(name, known) for name in names)


def _identifier(name: str) -> str:
    cleaned = re.sub(r"\W", "_", name)
    return f"_{cleaned}" if cleaned[:1].isdigit() else cleaned


def _inner(name: str) -> str:
    return f"{_identifier(name)}_from_fmu"
