"""Which solver "auto" stands for."""

from __future__ import annotations

from ..csource import ToolchainError, compiler

WORTH_COMPILING = 40_000  # samples of all runs of one model that pay for a second or two of compiling


def chosen_solver(solver: str, samples: int, runs: int) -> str:
    """Return the solver of a model that is run again and again: "auto" is "compiled" where that pays.

    It pays from 40 000 samples in all on, where there is a C compiler. Otherwise "auto" remains, which each
    run, as a single one, takes for "idas" if algebraic unknowns are left, and for "cvodes" if not.

    Args:
        solver: what the user asked for; anything but "auto" stays.
        samples: of one run.
        runs: how many are to be expected.
    """
    if solver != "auto" or samples * runs < WORTH_COMPILING:
        return solver
    try:
        compiler()
    except ToolchainError:
        return solver
    return "compiled"
