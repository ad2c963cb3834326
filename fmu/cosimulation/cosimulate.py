"""Co-simulation: a network and the FMUs in it, each solved by itself, exchanging at communication points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...base import boolean, demand, finite, named, whole
from ...components import ModelError
from ...networks import ATOL, DAE, RTOL, Network, dae_of
from .coupling import CoupledRun
from .gauss_seidel_master import GaussSeidelMaster
from .participants import CommunicationPoints
from .step_error import compare

MOST_STEPS = 100_000_000


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
    rtol: float = RTOL,
    atol: float = ATOL,
    solver: str = "rosenbrock",
) -> CoupledRun:
    """Run a network that has FMUs in it (`FMUBlock`, `FMUForce`, `FMUMotion`, ...).

    A communication step goes as follows. The FMUs advance first; what they take from the network is
    extrapolated by its exact derivatives: u + u' t (order 1). A Co-Simulation FMU that cannot interpolate
    holds the mean of it. The network then advances with its own solver and its own events, while what it
    takes from the FMUs is interpolated between both ends of the step: linear, a motion by the cubic through
    positions and velocities. At an event of an FMU (Model Exchange, or FMI 3 with event mode) or of the
    network the step ends early, for all, and they agree on values after it.

    With order 1 the error falls with the square of the communication step, across events, too.

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
    demand(
        "cosimulate()",
        stop=(stop, finite("s")),
        begin=(begin, finite("s")),
        communication_step=(communication_step, finite("s")),
        order=(order, whole(0)),
        halving=(halving, boolean),
    )
    points = CommunicationPoints(begin, stop, communication_step, order)
    _check(points)
    dae = dae_of(network)
    signals = named("inputs", inputs)
    options: dict[str, Any] = {
        "start": start, "guess": guess, "parameters": parameters,
        "rtol": rtol, "atol": atol, "solver": solver,
    }  # fmt: skip
    master = GaussSeidelMaster(dae, points, signals, options)
    run = master.run()
    if halving:
        compare(run, GaussSeidelMaster(dae, points.halved, signals, options).run(), master.exchanged)
    return run


def _check(points: CommunicationPoints) -> None:
    span, step, problems = points.stop - points.begin, points.step, []
    if not 0 < span < np.inf:
        problems.append(f"stop must be after begin, got a run of {span:g} s")
    if not 0 < step <= span:
        problems.append(f"communication_step must be above 0 s and within the run, got {step:g} s")
    elif span / step > MOST_STEPS:
        problems.append(
            f"communication_step = {step:g} s asks for {span / step:.3g} steps, more than {MOST_STEPS:.0e}; "
            "give a longer one"
        )
    if points.order not in (0, 1, 2):
        problems.append(f"order must be 0, 1 or 2, got {points.order}")
    if problems:
        raise ModelError("this co-simulation cannot be done:", problems)
