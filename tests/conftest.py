"""What all tests share: they run alike however, and wherever, they were started."""

import os
import signal

import pytest
from inertance.networks.simulation.solver_choice import Account

os.environ.setdefault("CFLAGS", "-O0")  # small programs compile sooner than they are optimised
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of two processes on two cores, threads only queue
os.environ["MPLBACKEND"] = "Agg"
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # as in the background, for all processes begun there
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def interpreted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let solver "auto" hang neither on what this machine has compiled before, nor on its speed."""
    monkeypatch.setattr(Account, "told", lambda self, closed: (False, "it is tested"))
    monkeypatch.setattr(Account, "_begin", lambda self, closed: None)
