"""What simpler methods make of the same cases, for the same table.

- refit: parameters are refitted within their priors, nothing else is ever found.
- signature: the force, as a function of the nominal motion, that correlates best with a residual.
- sindy: sparse regression (pysindy's STLSQ, if installed) of the residual on such functions.
- aicc: every effect of the vocabulary is fitted to the training records, the least AICc wins.

They run on the benchmark's own stepper, so aicc even has the true laws; it lacks their shapes, and test runs.
"""

from __future__ import annotations

import importlib.util
import json
import sys
import time
import tomllib
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from assembly import Rig
from effects import Effect, Sized, assembled, channel, draw, first_guess, places, sensed, typical_of
from rigs import OF_INPUTS, OF_OUTPUTS, RIGS
from scipy.interpolate import make_interp_spline
from severity import PRIOR
from stepper import Array, Drive, simulate

FACTOR = 4
STEP = 1e-3 / FACTOR
Answer = dict[str, Any]


class Case:
    """A case as anybody sees it: records, nominal rig, and the parameters that fit best."""

    def __init__(self, folder: Path) -> None:
        campaign = tomllib.loads((folder / "campaign.toml").read_text())
        self.rig = next(rig for rig in RIGS.values() if set(rig.parameters) == set(campaign["parameters"]))
        tables = [dict(np.load(folder / entry["file"])) for entry in campaign["train"]]
        self.drives = [_drive(self.rig, table) for table in tables]
        measured = [np.column_stack([table[name] for name in self.rig.outputs]) for table in tables]
        self.floor = np.median([_floor(y) for y in measured], axis=0)
        self.typical = typical_of(self.rig, self.drives[0], STEP)
        self.measured = self.scaled(measured)
        self._refit()

    def scaled(self, outputs: list[Array]) -> Array:
        """Return outputs over their noise, one after the other."""
        return np.concatenate([(y / self.floor).ravel() for y in outputs])

    def respond(self, values: dict[str, float], effects: list[Sized]) -> Array:
        """Return what all channels would show."""
        rows, assembly = assembled(self.rig, values, effects, self.typical)
        outputs = []
        for drive in self.drives:
            y = simulate(assembly.system(), drive, rows, STEP)[::FACTOR]
            for effect, size in effects:
                if effect.kind in OF_OUTPUTS:
                    column = self.rig.outputs.index(effect.place)
                    usual = self.typical[channel(effect.place)]
                    y[:, column] = sensed(effect, size, y[:, column], usual, 1e-3)
            outputs.append(y)
        return self.scaled(outputs)

    def motions(self) -> dict[str, tuple[Array, Array]]:
        """Return travel and speed of every motion of the refitted nominal, all records in a row."""
        _, assembly = assembled(self.rig, self.values, [], self.typical)
        rows = [row for motion in self.rig.motions.values() for row in (motion.travel(), motion.speed())]
        y = np.concatenate([simulate(assembly.system(), d, rows, STEP)[::FACTOR] for d in self.drives])
        return {name: (y[:, 2 * i], y[:, 2 * i + 1]) for i, name in enumerate(self.rig.motions)}

    def residuals(self) -> Array:
        """Return what is left over noise, (samples, channels)."""
        return (self.measured - self.model).reshape(-1, len(self.rig.outputs))

    def _refit(self, rounds: int = 30) -> None:
        """Fit parameters within their priors (Levenberg-Marquardt)."""
        self.values = dict(self.rig.parameters)
        self.model = self.respond(self.values, [])
        cost, damping = self._cost(self.values, self.model), 1e-2
        for _ in range(rounds):
            self._differentiate()
            before = cost
            for _ in range(6):
                tried = self._moved(damping)
                model = self.respond(tried, [])
                if self._cost(tried, model) < cost:
                    self.values, self.model, cost = tried, model, self._cost(tried, model)
                    damping /= 5
                    break
                damping *= 5
            if cost > (1 - 1e-4) * before:
                return

    def _moved(self, damping: float) -> dict[str, float]:
        off = np.array([self.values[n] / nominal - 1 for n, nominal in self.rig.parameters.items()])
        normal = self.slopes.T @ self.slopes + np.eye(len(off)) / PRIOR**2
        pull = self.slopes.T @ (self.measured - self.model) - off / PRIOR**2
        shares = off + np.linalg.solve(normal + damping * np.diag(np.diag(normal)), pull)
        names = self.rig.parameters.items()
        return {n: max(1 + float(x), 0.1) * nominal for x, (n, nominal) in zip(shares, names, strict=True)}

    def _differentiate(self) -> None:
        """Find how the response changes with the share by which each parameter leaves its nominal value."""
        columns = []
        for name, nominal in self.rig.parameters.items():
            moved = self.respond({**self.values, name: self.values[name] + 0.002 * nominal}, [])
            columns.append((moved - self.model) / 0.002)
        self.slopes = np.column_stack(columns)

    def _cost(self, values: dict[str, float], model: Array) -> float:
        off = [(values[n] / nominal - 1) / PRIOR for n, nominal in self.rig.parameters.items()]
        return float(np.sum((self.measured - model) ** 2) + np.sum(np.square(off)))


def refit(case: Case) -> Answer:
    """Parameters, whatever is left."""
    return {"verdict": "parameters", "effects": [], "equivalent": []}


def signature(case: Case) -> Answer:
    """Return what correlates best with a residual, if it explains a hundredth of it."""
    residuals = case.residuals()
    best = (0.0, "", "")
    for place, (travel, speed) in case.motions().items():
        for kind, force in _signatures(travel, speed).items():
            strength = max(abs(np.corrcoef(force, r)[0, 1]) for r in residuals.T)
            best = max(best, (float(strength), kind, place))
    return _named(case.rig, best[1], best[2]) if best[0] > 0.1 else refit(case)


def sindy(case: Case) -> Answer:
    """Return the strongest term of the sparse regression that leaves least, if any term survives."""
    import pysindy  # type: ignore[import-not-found]

    residuals, best = case.residuals(), (np.inf, "", "")
    for place, (travel, speed) in case.motions().items():
        terms = _signatures(travel, speed)
        features = np.column_stack([f / np.std(f) for f in terms.values()])
        optimiser = pysindy.STLSQ(threshold=0.1, alpha=1e-3)
        with warnings.catch_warnings(action="ignore"):  # that no term survives is an answer
            optimiser.fit(features, residuals)
        left = float(np.sum((residuals - features @ optimiser.coef_.T) ** 2))
        strength = np.abs(optimiser.coef_).max(axis=0)
        if strength.max() > 0 and left < best[0]:
            best = left, list(terms)[int(strength.argmax())], place
    return _named(case.rig, best[1], best[2]) if best[1] else refit(case)


def aicc(case: Case) -> Answer:
    """Return the effect with the least AICc on the training records, or none if none is better than none."""
    residual, count = case.residuals().ravel(), len(case.measured)
    inverse = np.linalg.pinv(case.slopes)
    least, answer = _criterion(residual, count, 0), refit(case)
    rng = np.random.default_rng(0)
    for kind, place, sites in places(case.rig):
        if kind in OF_INPUTS:
            continue
        effect = draw(kind, place, sites, rng)
        left = min(
            (_left(case, residual, inverse, effect, factor) for factor in (0.01, 0.1, 1.0)),
            key=lambda r: float(r @ r),
        )
        criterion = _criterion(left, count, 1 + len(effect.shape))
        if criterion < least:
            least, answer = criterion, _named(case.rig, kind, place, sites)
    return answer


METHODS: dict[str, Callable[[Case], Answer]] = {
    "refit": refit,
    "signature": signature,
    "sindy": sindy,
    "aicc": aicc,
}


def judge(folder: Path, jobs: int = 2) -> None:
    """Let every baseline answer every case."""
    cases = sorted((folder / "cases").iterdir())
    with ProcessPoolExecutor(jobs) as pool:
        for done, _ in enumerate(pool.map(_judged, cases), start=1):
            print(f"\r{done}/{len(cases)} cases judged by baselines", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)


def _judged(folder: Path) -> None:
    case = None
    for name, method in METHODS.items():
        path = folder / f"baseline_{name}.json"
        if path.exists() or (name == "sindy" and not importlib.util.find_spec("pysindy")):
            continue
        begin = time.perf_counter()
        case = case or Case(folder)
        path.write_text(json.dumps(method(case)))
        path.with_suffix(".run.json").write_text(json.dumps({"seconds": time.perf_counter() - begin}))


def _left(case: Case, residual: Array, inverse: Array, effect: Effect, factor: float) -> Array:
    """Return what is left of a residual after the best share of an effect's change and of the parameters'."""
    size = factor * first_guess(effect, case.rig, case.drives[0], STEP)
    change = case.respond(case.values, [(effect, size)]) - case.model
    if not np.all(np.isfinite(change)):
        return residual
    change = change - case.slopes @ (inverse @ change)
    share = max(0.0, float(change @ residual) / max(float(change @ change), 1e-300))
    return residual - share * change


def _criterion(left: Array, count: int, parameters: int) -> float:
    k = parameters + 1
    return count * float(np.log(np.mean(left**2))) + 2 * k + 2 * k * (k + 1) / (count - k - 1)


def _signatures(travel: Array, speed: Array) -> dict[str, Array]:
    """Return the forces that a motion would give, for their unit."""
    s, v = travel / np.std(travel), speed / np.std(speed)
    side = np.tanh(v / 0.02)
    return {
        "viscous_damping": v,
        "quadratic_damping": v * np.abs(v),
        "coulomb_friction": side,
        "stribeck_friction": side * np.exp(-np.abs(v) / 0.2),
        "asymmetric_friction": np.maximum(side, 0),
        "friction_drift": side * np.linspace(0, 1, len(side)),
        "position_ripple": np.sin(2 * np.pi * s),
        "linear_stiffness": s,
        "cubic_stiffness": s**3,
        "bilinear_stiffness": np.maximum(s, 0),
    }


def _named(rig: Rig, kind: str, place: str, sites: tuple[str, ...] = ()) -> Answer:
    site = (sites or rig.motions[place].sites)[0]
    return {"verdict": "effect", "effects": [{"kind": kind, "site": site}], "equivalent": []}


def _drive(rig: Rig, table: dict[str, Array]) -> Drive:
    fine = np.arange((len(table["time"]) - 1) * FACTOR + 1) * STEP
    spline = make_interp_spline(table["time"], table[rig.input], k=5)
    y, yd, ydd = (spline(fine, nu) for nu in range(3))
    zero = np.zeros_like(y)
    return Drive(zero, y, yd, ydd) if rig.prescribed else Drive(y, zero, zero, zero)


def _floor(y: Array) -> Array:
    """Return the noise of each column: what is left above 200 Hz, taken to be white."""
    spectrum = np.abs(np.fft.rfft(y * np.hanning(len(y))[:, None], axis=0)) ** 2
    high = spectrum[int(0.2 * len(y)) : int(0.35 * len(y))]
    return np.sqrt(np.mean(high, axis=0) / np.sum(np.hanning(len(y)) ** 2))
