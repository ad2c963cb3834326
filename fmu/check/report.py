"""The report of a check: what was looked at, what it came to, where it was worst."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from ...base import UnknownNameError, aligned

MOTION = "motion"
HEADINGS = ("", "FMU", "check", "error", "limit", "")


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at.

    Attributes:
        subject: what of: "FMI 3.0 CS".
        check: "outputs", "events", "directional derivatives" ...
        passed: None if it could not be looked at.
        error: the greatest difference; None where nothing is measured.
        limit: what it may be.
        told: where the error is greatest, what is wrong, or why nothing was done.
    """

    subject: str
    check: str
    passed: bool | None
    error: float | None = None
    limit: float | None = None
    told: str = ""

    @property
    def word(self) -> str:
        """What it came to: good, FAILED, or "-" if it was not looked at."""
        return "-" if self.passed is None else "good" if self.passed else "FAILED"


def measured(subject: str, check: str, error: float, limit: float, told: str = "") -> Finding:
    """Return a finding that passes if the error is within the limit (a NaN is not)."""
    return Finding(subject, check, bool(error <= limit), float(error), limit, told)


@dataclass(eq=False)
class CheckReport:
    """What a check found; printed, a table.

    Attributes:
        name: of the network or the FMU.
        findings: in the order they were made.
        notes: what is to be known besides.
    """

    name: str
    findings: list[Finding] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether something was looked at and nothing failed."""
        return any(f.passed for f in self.findings) and not self.failures

    @property
    def failures(self) -> list[Finding]:
        """The findings that failed."""
        return [f for f in self.findings if f.passed is False]

    @property
    def vacuous(self) -> bool:
        """Whether nothing moved, so that there is little in what agrees."""
        return any(f.check == MOTION for f in self.findings)

    def of(self, subject: str, check: str) -> Finding:
        """Return one finding.

        Raises:
            UnknownNameError: if there is none.
        """
        for finding in self.findings:
            if (finding.subject, finding.check) == (subject, check):
                return finding
        raise UnknownNameError(f"there is no finding '{check}' of '{subject}'")

    def to_dict(self) -> dict[str, Any]:
        """Return all of it as plain data, for JSON."""
        return {
            "name": self.name,
            "passed": self.passed,
            "vacuous": self.vacuous,
            "findings": [asdict(finding) for finding in self.findings],
            "notes": self.notes,
        }

    def __str__(self) -> str:
        lines = [f"check of '{self.name}'", *aligned([HEADINGS, *map(_row, self.findings)])]
        lines += [f"note: {note}" for note in self.notes]
        looked = sum(f.passed is not None for f in self.findings)
        if self.failures:
            return "\n".join([*lines, f"{len(self.failures)} of {looked} checks failed"])
        told = f"{looked} checks, all good" if self.passed else "nothing could be checked"
        if self.vacuous:
            told += "; but nothing moved, so that agreement says little: see 'motion'"
        return "\n".join([*lines, told])


def _row(finding: Finding) -> tuple[str, ...]:
    numbers = ("" if n is None else f"{n:.2g}" for n in (finding.error, finding.limit))
    return (finding.word, finding.subject, finding.check, *numbers, finding.told)
