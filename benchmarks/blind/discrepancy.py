"""What a discrepancy without sites closes of the gap, beside the diagnosis of the same cases.

    python benchmarks/blind/discrepancy.py DIR [--kind KIND ...] [--jobs 2]

DIR is a set that `run.py` has diagnosed. Parameters are refitted by `inertance.fit`. What is then left of
each output in the training records is learnt as a function of the inputs and their first derivatives, and of
the outputs that the model predicts and their first two derivatives, and taken off the test records:

- refit only: nothing is learnt.
- splines: one cubic spline with 20 knots of each, ridge by generalised cross-validation (scikit-learn).
- Gaussian process: of all of them, a length each, by marginal likelihood (scikit-learn).
- SINDy: sparse regression on their polynomials of degree three, as sparse as foresees most (pysindy).

Beyond what the training records hold, each is what it is at their ends.

None of them says where a force acts, nor what it depends on.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path
from statistics import median

import inertance as ia
import numpy as np
from measures import wilson
from numpy.typing import NDArray

Array = NDArray[np.float64]
Learnt = Callable[[Array], Array]
POINTS = 600  # of all training records, from which a Gaussian process learns
MOST = 20000  # of them, from which the others do
CLOSED = 0.9
THRESHOLDS, RIDGES = (0.02, 0.05, 0.1, 0.2, 0.5), (1e-3, 1.0, 1e3)  # of a sparse regression, that are tried


def none(moved: Array, left: Array) -> Learnt:
    """Learn nothing."""
    return lambda at: np.zeros((len(at), left.shape[1]))


def splines(moved: Array, left: Array) -> Learnt:
    """Learn a sum of splines."""
    from sklearn.linear_model import RidgeCV  # type: ignore[import-not-found]
    from sklearn.pipeline import make_pipeline  # type: ignore[import-not-found]
    from sklearn.preprocessing import SplineTransformer  # type: ignore[import-not-found]

    sums = make_pipeline(
        SplineTransformer(20, extrapolation="constant"), RidgeCV(np.geomspace(1e-4, 1e4, 17))
    )
    return sums.fit(moved, left).predict  # type: ignore[no-any-return]


def gaussian_process(moved: Array, left: Array) -> Learnt:
    """Learn a Gaussian process of each output from some of the points."""
    from sklearn.gaussian_process import GaussianProcessRegressor  # type: ignore[import-not-found]
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel  # type: ignore[import-not-found]

    some = np.random.default_rng(0).choice(len(moved), min(POINTS, len(moved)), replace=False)
    kernel = ConstantKernel() * RBF(np.ones(moved.shape[1]), (1e-2, 1e4)) + WhiteKernel(0.1, (1e-8, 1e1))
    each = [
        GaussianProcessRegressor(kernel, normalize_y=True).fit(moved[some], column[some]) for column in left.T
    ]
    return lambda at: np.column_stack([one.predict(at) for one in each])


def sindy(moved: Array, left: Array) -> Learnt:
    """Learn a sparse polynomial, as sparse as foresees most of the last third of the points."""
    from pysindy import STLSQ, PolynomialLibrary  # type: ignore[import-not-found]

    terms, scale = PolynomialLibrary(degree=3), left.std(axis=0)
    columns, wanted = np.asarray(terms.fit_transform(moved)), left / scale
    size = columns.std(axis=0)
    size[size == 0] = 1.0
    columns, known = columns / size, 2 * len(moved) // 3

    def fitted(count: int, threshold: float, alpha: float) -> Array:
        return np.asarray(
            STLSQ(threshold=threshold, alpha=alpha).fit(columns[:count], wanted[:count]).coef_.T
        )

    def foreseen(sparse: tuple[float, float]) -> float:
        return float(np.mean((wanted[known:] - columns[known:] @ fitted(known, *sparse)) ** 2))

    found = fitted(len(moved), *min(product(THRESHOLDS, RIDGES), key=foreseen))
    return lambda at: np.asarray(terms.transform(at)) / size @ found * scale


METHODS = {"refit only": none, "splines": splines, "Gaussian process": gaussian_process, "SINDy": sindy}


def judged(folder: Path) -> dict[str, float]:
    """Return the share of the gap beyond noise that each method closes on the test records of a case."""
    with warnings.catch_warnings(action="ignore"):  # hyperparameters at a bound, terms that vanish
        fit = ia.fit(folder / "campaign.toml")
        train, test = ([_seen(c) for c in fit.comparisons if c.tested == tested] for tested in (False, True))
        moved, left = (np.concatenate(parts) for parts in zip(*train, strict=True))
        center, scale, ends = moved.mean(axis=0), moved.std(axis=0), (moved.min(axis=0), moved.max(axis=0))
        every = max(1, len(moved) // MOST)
        before = _misfit([missed for _, missed in test])
        closed = {}
        for name, method in METHODS.items():
            learnt = method(((moved - center) / scale)[::every], left[::every])
            after = _misfit([missed - learnt((np.clip(m, *ends) - center) / scale) for m, missed in test])
            closed[name] = float(np.clip((before - after) / max(before - 1.0, 1e-9), 0.0, 1.0))
    return closed


def _seen(compared: ia.identification.fitting.outcome.Comparison) -> tuple[Array, Array]:
    """Return what may tell of what is missed at the instants of a record, and that, in units of noise."""
    experiment, predicted = compared.experiment, compared.after
    t = experiment.elapsed(experiment.compared.time)
    at = experiment.compared.time
    record = experiment.record
    driven = [np.interp(at, record.time, record.values[n]) for n in record.values if n not in predicted]
    columns = [column for u in driven for column in (u, np.gradient(u, t))]
    for y in predicted.values():
        speed = np.gradient(y, t)
        columns += [y, speed, np.gradient(speed, t)]
    missed = [compared.residual(n, predicted) / experiment.floors[n].sigma for n in predicted]
    return np.column_stack(columns), np.column_stack(missed)


def _misfit(left: Sequence[Array]) -> float:
    return float(np.sqrt(np.mean(np.concatenate([part.ravel() for part in left]) ** 2)))


def _told(folder: Path) -> dict[str, float]:
    """Return what all methods close of a case, the diagnosis first; what was done before is kept."""
    path = folder / "discrepancy.json"
    if not path.exists():
        path.write_text(json.dumps(judged(folder)))
    verdict = json.loads((folder / "verdict.json").read_text())
    return {"diagnosis": float(verdict.get("closed") or 0.0), **json.loads(path.read_text())}


def main() -> None:
    """Judge the cases of a set and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, help="of a set that is diagnosed and opened")
    parser.add_argument(
        "--kind", nargs="*", help="of what is missing; all that have something missing if not given"
    )
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    labels = json.loads((given.folder / "labels" / "labels.json").read_text())
    wanted = [
        given.folder / "cases" / name
        for name, label in sorted(labels.items())
        if (given.kind is None or label["label"].get("kind") in given.kind)
        and label["label"]["verdict"] in ("effect", "law")
    ]
    found = []
    with ProcessPoolExecutor(given.jobs) as pool:
        for done, closed in enumerate(pool.map(_told, wanted), start=1):
            found.append(closed)
            print(f"\r{done}/{len(wanted)} cases", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    for name in found[0]:
        shares = [closed[name] for closed in found]
        right = sum(share >= CLOSED for share in shares)
        low, high = wilson(right, len(shares))
        told = f"{right}/{len(shares)}, {low:.0%} to {high:.0%}"
        print(f"{name:18} closed: median {median(shares):6.1%}, at least {CLOSED:.0%}: {told}")


if __name__ == "__main__":
    main()
