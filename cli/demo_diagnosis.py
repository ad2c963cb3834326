"""The second half of `inertance demo`: a rig whose model lacks something, and what that is."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..diagnosis import Verdict, diagnose, write_report
from ..identification import Campaign, Record
from ..networks import Network
from .demo_runs import by_c
from .diagnose import show
from .terminal import CommandConsole

CAMPAIGN = Path(__file__).with_name("withheld") / "campaign.toml"


def diagnose_withheld(console: CommandConsole, out: Path) -> Verdict:
    """Diagnose the shipped records, print the verdict, and write the report and the verdict's JSON."""
    campaign = Campaign.load(CAMPAIGN)
    console.print(
        "\nRecords of such a rig, made by code that shares nothing with the library: its model lacks "
        "something, and its parameters are up to 20 % off. What is missing, and where?"
    )
    with console.status("reading") as status:
        verdict = diagnose(campaign, report=status.update)
    show(verdict)
    record = campaign.testing[0].record
    errors = [_error(net, record, verdict) for net in (verdict.network, verdict.corrected())]
    console.print(
        f"The network run on the test record misses the force by {errors[0]:.1f} N, with what was found "
        f"added by {errors[1]:.1f} N; the noise is {campaign.floors['F'].sigma:.1f} N."
    )
    console.print(f"wrote {verdict.save(out / 'withheld.json')}")
    console.print(f"wrote {write_report(verdict, out / 'withheld.html')}")
    return verdict


def _error(network: Network, record: Record, verdict: Verdict) -> float:
    """Return by how much a network with the fitted parameters misses the force, root mean square [N]."""
    inputs = {"actuator.s_ref": record.sampled("x")}
    stop, step = float(record.time[-1]), 1 / record.rate
    options: Any = {"inputs": inputs, "parameters": verdict.parameters, "progress": False}
    run = by_c(partial(network.simulate, stop, step=step, **options))
    missed = record.values["F"] - np.interp(record.time, run.time, run["load_cell.f"])
    return float(np.sqrt(np.mean(missed**2)))
