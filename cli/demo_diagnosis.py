"""The second half of `inertance demo`: a rig whose model lacks something, and what that is."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from ..diagnosis import Verdict, diagnose
from ..identification import Campaign
from .diagnose import show

CAMPAIGN = Path(__file__).with_name("withheld") / "campaign.toml"


def diagnose_withheld(console: Console, out: Path) -> Verdict:
    """Diagnose the shipped records, print the verdict, and write the report and the verdict's JSON."""
    campaign = Campaign.load(CAMPAIGN)
    console.print(
        "\nRecords of such a rig, made by code that shares nothing with the library: its model lacks "
        "something, and its parameters are up to 20 % off. What is missing, and where?"
    )
    with console.status("reading") as status:
        verdict = diagnose(campaign, report=status.update)
    show(verdict)
    console.print(f"wrote {verdict.save(out / 'withheld.json')}")
    console.print(f"wrote {verdict.report(out / 'withheld.html')}")
    return verdict
