"""H-infinity tuning of a TMDI: stiffness and damping that make the highest peak of a structure least.

A structure of one degree of freedom, 1 % damped, under harmonic force; mu = 0.02, beta = 0.1. Measured: a
tuning from the same start, the model being built before. Excess: of the peak reached over the least of all;
peaks are taken on one fine grid for everyone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import inertance as ia
from inertance.machines import TMDI
from measure import Contender, compare, once
from peers import tmdi_scipy
from table import show

NAMES = ("absorber1.k", "absorber1.d")


def peak(dae: ia.DAE, /, *, parameters: Mapping[str, float]) -> float:
    return ia.analysis.linearise(dae, ["wind.f"], ["floor1.s"], parameters=parameters).hinf()


def tuned(dae: ia.DAE) -> tuple[float, float]:
    bounds, start = (dict(zip(NAMES, v, strict=True)) for v in (tmdi_scipy.BOUNDS, tmdi_scipy.START))
    found = ia.analysis.tune(dae, peak, bounds, start=start, starts=1)
    k, d = (found.parameters[name] for name in NAMES)
    return k, d


def main(rounds: int) -> None:
    k, d = tmdi_scipy.START
    absorber = TMDI(m=tmdi_scipy.MU, k=k, d=d, b=tmdi_scipy.BETA)
    dae = ia.machines.shear_frame([1.0], [1.0], [tmdi_scipy.LOSS], {(0, 1): absorber}).dae()
    contenders: dict[str, Callable[[], tuple[float, float]]] = {
        "library": partial(tuned, dae),
        "SciPy, peaks refined, Nelder-Mead": tmdi_scipy.by_nelder_mead,
        "SciPy, equal peaks, SLSQP": tmdi_scipy.by_equal_peaks,
    }
    if tmdi_scipy.has_control():
        contenders["python-control's norm, Nelder-Mead"] = tmdi_scipy.by_control
    reached = {name: tmdi_scipy.fine_peak(*go()) for name, go in contenders.items()}
    least = min(reached.values())
    made = [Contender(n, once(go), f"excess {reached[n] / least - 1:.1e}") for n, go in contenders.items()]
    show(f"H-infinity tuning of a TMDI ({made[0].remark})", compare(made[0], made[1:], rounds))


if __name__ == "__main__":
    main(5)
