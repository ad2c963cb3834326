"""Processes for work that is spread: what they are told, and what is left as it was."""

import os

import pytest
from inertance.base.processes import Processes

THREADS = "OPENBLAS_NUM_THREADS"


@pytest.mark.parametrize(("given", "taken"), [(None, "1"), ("3", "3")])
def test_only_workers_are_kept_to_one_thread(
    monkeypatch: pytest.MonkeyPatch, given: str | None, taken: str
) -> None:
    monkeypatch.delenv(THREADS, raising=False)
    if given is not None:
        monkeypatch.setenv(THREADS, given)
    with Processes(1, "spawn") as pool:
        assert pool.submit(os.getenv, THREADS).result() == taken
    assert os.environ.get(THREADS) == given
