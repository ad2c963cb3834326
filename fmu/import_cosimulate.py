"""Co-simulation: a network and the FMUs in it, each solved by itself, exchanging at communication points."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..components import ModelError
from ..networks import DAE, Network, Polynomial, Stepwise
from .errors import FMUError
from .exchange import compare
from .foreign import Values
from .import_blocks import ForeignComponent
from .import_coupling import Coupled, CoupledRun
from .import_participants import participant
from .import_start import unchanged
from .master import advance_together

Array = NDArray[np.float64]
NEXT_TO_NOTHING = 1e-9


def cosimulate(
    network: Network | DAE,
    stop: float,
    *,
    communication_step: float,
    order: int = 1,
    halving: bool = True,
    begin: float = 0.0,
    inputs: Mapping[str, Any] | None = None,
    parameters: Mapping[str, float] | None = None,
    start: Mapping[str, float] | None = None,
    guess: Mapping[str, float] | None = None,
    rtol: float = 1e-6,
    atol: float = 1e-8,
    solver: str = "rosenbrock",
) -> CoupledRun:
    """Run a network that has FMUs in it (`FMUBlock`, `FMUForce`, `FMUMotion`, ...).

    A communication step goes as follows. The FMUs advance first; what they take from the network is
    extrapolated by its exact derivatives: u + u' t (order 1). A Co-Simulation FMU that cannot interpolate
    holds the mean of it. The network then advances with its own solver and its own events, while what it
    takes from the FMUs is interpolated between both ends of the step: linear, a motion by the cubic through
    positions and velocities. At an event of an FMU (Model Exchange, or FMI 3 with event mode) the step ends
    early, for all.

    With order 1 the error of a smooth run falls with the square of the communication step.

    Args:
        network: the network, or its `DAE`.
        stop: end time [s].
        communication_step: time between exchanges [s].
        order: of the extrapolation, 0 (hold), 1 or 2.
        halving: run again with half the step, to tell what the step costs (`step_error`).
        begin: start time [s].
        inputs: signals of the network's other inputs.
        parameters: changed parameters of the network.
        start: fixed start values of the network.
        guess: start values that may give way.
        rtol: relative tolerance, of the network and of Model Exchange FMUs.
        atol: absolute tolerance of the network.
        solver: of the network. "rosenbrock" begins every communication step with its full order; "cvodes"
            begins anew with order 1, and the errors of that add up with the number of steps.

    Raises:
        FMUError: if an FMU fails, if FMUs and network do not agree at the start, or if half the
            communication step makes another run of it.
        ModelError: for a network without FMU, and for wrong arguments.
        SimulationError: if the network fails.
    """
    _check(stop - begin, communication_step, order)
    dae = network.dae() if isinstance(network, Network) else network
    network_options: dict[str, Any] = {
        "start": start, "guess": guess, "parameters": parameters,
        "rtol": rtol, "atol": atol, "solver": solver,
    }  # fmt: skip
    master = _Master(dae, (begin, stop), communication_step, order, dict(inputs or {}), network_options)
    run = master.run()
    if halving:
        half = _Master(dae, (begin, stop), communication_step / 2, order, dict(inputs or {}), network_options)
        compare(run, half.run(), master.exchanged)
    return run


def _check(span: float, step: float, order: int) -> None:
    problems = []
    if not 0 < span < np.inf:
        problems.append(f"stop must be after begin, got a run of {span:g} s")
    if not 0 < step <= span:
        problems.append(f"communication_step must be above 0 s and within the run, got {step:g} s")
    if order not in (0, 1, 2):
        problems.append(f"order must be 0, 1 or 2, got {order}")
    if problems:
        raise ModelError("this co-simulation cannot be done:", problems)


class _Master:
    def __init__(
        self, dae: DAE, span: tuple[float, float], step: float, order: int, inputs: dict[str, Any],
        options: dict[str, Any],
    ) -> None:  # fmt: skip
        self.dae, self.span, self.order = dae, span, order
        count = max(1, round((span[1] - span[0]) / step))
        self.points = np.linspace(*span, count + 1)
        self.step, self.options, self.steps = step, options, 0
        parts = {i.path: i.component for i in dae.system.flat.instances.values()}
        self.foreign = {p: c for p, c in parts.items() if isinstance(c, ForeignComponent)}
        if not self.foreign:
            raise ModelError(f"'{dae.name}' has no FMU in it; use simulate")
        self.inputs = inputs
        for path, component in self.foreign.items():
            for given in component.given:
                self.inputs[f"{path}.{given.name}"] = Polynomial(1 if given.rate is None else 3)
        self.all: list[Coupled] = []
        self.network: Stepwise

    @property
    def exchanged(self) -> list[str]:
        """Names of what passes between network and FMUs."""
        return [
            f"{path}.{name}"
            for path, component in self.foreign.items()
            for name in [*(t.name for t in component.taken), *(g.name for g in component.given)]
        ]

    def run(self) -> CoupledRun:
        began = clock.perf_counter()
        try:
            self._instantiate()
            self._agree()
            for one in self.all:
                one.was = one.fmu.begin(self._now(one))
                one.fmu.record()
            self._march()
        finally:
            for one in self.all:
                one.fmu.close()
        result = self.network.result()
        stats = {"communication steps": self.steps, "seconds": clock.perf_counter() - began}
        runs = {one.path: one.fmu.run for one in self.all}
        return CoupledRun(runs, self.step, self.order, result, stats=stats)

    def _instantiate(self) -> None:
        for path, component in self.foreign.items():
            outputs = [n for g in component.given for n in (g.value, g.rate) if n is not None]
            fmu = participant(
                component.kind, component.fmu, [t.input for t in component.taken], outputs, self.span,
                self.options["rtol"], component.chosen, component.started,
            )  # fmt: skip
            self.all.append(Coupled(path, component, fmu, self.order))
        self.all.sort(key=lambda one: not one.fmu.reversible)

    def _agree(self) -> None:
        """Initialise network and FMUs so that they agree on what they exchange."""
        guess = np.concatenate([np.zeros(0), *map(np.asarray, [one.start_inputs() for one in self.all])])
        if unchanged(self._answer, guess) is None:
            raise FMUError(
                f"'{self.dae.name}': the network and its FMUs find no common start, as one answers to the "
                "other at once and they contradict; put a state (a mass, a lag) between them"
            )

    def _answer(self, given: Array) -> Array:
        """Return what the FMUs take from the network, if they had taken this."""
        courses: dict[str, Sequence[float]] = {}
        ends = np.cumsum([len(one.component.taken) for one in self.all])
        for one, values in zip(self.all, np.split(given, ends[:-1]), strict=True):
            one.was = one.fmu.initial(values.tolist())
            courses |= one.courses(one.was)
        self.network = Stepwise(self.dae, *self.span, self.inputs, courses, **self.options)
        return np.concatenate([np.zeros(0), *map(np.asarray, [self._now(one) for one in self.all])])

    def _observed(self, one: Coupled) -> Array:
        wanted = one.wanted()
        return self.network.observe(wanted) if wanted else np.zeros(0)

    def _now(self, one: Coupled) -> Values:
        return one.course(self._observed(one), 0.0)(0.0)

    def _march(self) -> None:
        following = 1
        while following < len(self.points):
            target = float(self.points[following])
            reached = self._exchange(target)
            following += reached >= target
            if any(one.fmu.ended for one in self.all):
                return

    def _exchange(self, target: float) -> float:
        """Advance all to `target` or the first event before it."""
        t = self.network.time
        courses = [one.course(self._observed(one), t) for one in self.all]
        fmus = {one.path: one.fmu for one in self.all}
        reached = advance_together(fmus, target, dict(zip(fmus, courses, strict=True)))
        self.steps += 1
        if reached - t > NEXT_TO_NOTHING * self.step:
            given: dict[str, Sequence[float]] = {}
            for one, course in zip(self.all, courses, strict=True):
                given |= one.courses(one.fmu.outputs(course(reached)), reached - t)
            self.network.set(given)
            self.network.advance(reached)
        self._settle(reached)
        return reached

    def _settle(self, t: float) -> None:
        """Iterate events of FMUs; read what they give with what the network now has."""
        for one in self.all:
            now = self._now(one)
            one.was = one.fmu.outputs(now)
            one.fmu.record()
            if one.fmu.settle(now) and not one.fmu.ended:
                one.was = one.fmu.outputs(now)
                one.fmu.record()
