"""Sweeps of 1000 points in this process, whose runs go side by side unasked, against runs in a loop.

- cars: quarter cars with an inerter over a kerb, 3 s, smooth; the peak of the body's acceleration
- PFIs: a Monte Carlo of planetary flywheel inerters on the rig, true sticking, 1 s at 3 Hz, 1001 outputs; the
  peak of the force

Programs are kept by an earlier sweep, as on a second day; the sweep assembles its network, the loop has it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import inertance as ia
import numpy as np
import pfi
import sweep
from ensembles import ATOL, RTOL, each
from inertance.machines import Sinusoid, ge_wang, inerter_rig
from measure import Contender, compare
from table import show

COUNT = 1000


def rig() -> ia.Network:
    return inerter_rig(ge_wang.planetary_inerter(), Sinusoid(pfi.AMPLITUDE, pfi.FREQUENCY))


def turn(dae: ia.DAE, values: dict[str, float]) -> float:
    run = ia.simulate(
        dae, pfi.DURATION, parameters=values, start=pfi.rolling(), step=pfi.STEP, rtol=RTOL, atol=ATOL
    )
    return float(np.abs(run[pfi.FORCE]).max())


def scattered() -> ia.sweeps.Design:
    """Return the screw's stiffness within 20 % and the planets' inertia within 10 %."""
    nominal, ranges = pfi.reduced().parameter_values, {"inerter.screw.k": 0.2, "inerter.flywheel.J_p": 0.1}
    return ia.sweeps.monte_carlo(
        {name: (nominal[name] * (1 - share), nominal[name] * (1 + share)) for name, share in ranges.items()},
        COUNT,
        seed=1,
    )


def main(rounds: int) -> None:
    cars = "quarter cars", sweep.build, sweep.DESIGN, sweep.ride
    for name, build, design, measure in (cars, ("PFIs with stick-slip", rig, scattered(), turn)):
        dae = build().dae()
        points = [dict(zip(design.names, point, strict=True)) for point in design.points]
        together: Callable[[], Any] = partial(
            ia.sweeps.sweep, build, design, measure, workers=0, progress=False
        )

        def loop(
            dae: ia.DAE = dae, points: list[dict[str, float]] = points, measure: Any = measure
        ) -> list[float]:
            return [measure(dae, values) for values in points]

        done, alone = together(), np.array(loop())
        apart = np.abs(done.table["value"].to_numpy() / alone - 1).max()
        told = ", ".join(f"{count} {how}" for how, count in together().runs.items())
        peer = Contender("`simulate` in a loop", each(loop, COUNT), f"{apart:.1e} apart")
        title = f"Sweep of {COUNT} {name} ({told})"
        show(title, compare(Contender("sweep", each(together, COUNT)), [peer], rounds), [])


if __name__ == "__main__":
    main(3)
