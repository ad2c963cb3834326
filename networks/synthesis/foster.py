"""Foster's forms: partial fractions as networks, one branch a pole."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

from ...base import ModelError, whole
from ..two_terminal import TwoTerminal
from .bott_duffin import Side
from .polynomials import derivative, many_digits, positive_roots, value
from .positive import required_positive_real
from .ratio import Ratio, Scale
from .rational import RationalFunction
from .synthesise import checked
from .tree import Tree, joined


def foster(admittance: Any, form: int = 2) -> TwoTerminal:
    """Return the network that the partial fractions of an admittance, or of its inverse, stand for.

        F = a s + c + a_0/s + sum 2 a_i s/(s^2 + w_i^2) + sum r_i/(s + p_i)

    with a branch for each term, where the terms with r_i < 0 are |r_i|/p_i (s/(s + p_i) - 1).

    Args:
        admittance: what `RationalFunction.of` takes.
        form: 1 for F = 1/Y with branches in series, 2 for F = Y with branches in parallel.

    Raises:
        NotPositiveRealError: if it is not positive-real.
        ModelError: if F has complex or multiple poles, or too little resistance for its negative residues:
            `synthesise` realises these, too.

    Source: R. M. Foster, Bell System Tech. J. 3 (1924) 259-267; W. Cauer, Arch. Elektrotech. 17
    (1926) 355-388.

    Example:
        >>> from inertance.synthesis import foster
        >>> foster(([1.0, 2.0], [1.0, 1.0]))  # 1 + 1/(s + 1)
        parallel(branch=series(spring=Spring(k=1.0), damper=Damper(d=1.0)), damper=Damper(d=1.0))
    """
    if whole(1)(form) or form not in (1, 2):
        raise ModelError(f"Foster's forms are 1 (in series) and 2 (in parallel), got {form!r}")
    function = RationalFunction.of(admittance)
    with many_digits():
        ratio, scale = Ratio.normalised(function)
        required_positive_real(ratio, scale)
        side = Side(beside=form == 2)
        tree = _branches(ratio if side.beside else ratio.inverse, side, scale).at(scale)
    return checked(tree, function)


def _branches(function: Ratio, side: Side, scale: Scale) -> Tree:
    poles, rest = function.axis_poles()
    parts = [side.pole(pole) for pole in poles]
    constant = rest.num[-1] / rest.den[-1] if len(rest.num) == len(rest.den) else Decimal(0)
    rates = positive_roots([c if k % 2 == 0 else -c for k, c in enumerate(rest.den)])
    if len(rates) < len(rest.den) - 1:
        raise ModelError(
            f"form {1 if side.other.beside else 2} of Foster has no branch for complex or multiple poles, of "
            f"which there are {len(rest.den) - 1 - len(rates)}; take synthesise()"
        )
    for rate in rates if rest.num else []:
        residue = value(rest.num, -rate) / value(derivative(rest.den), -rate)
        parts.append(_branch(side.other, rate, residue))
        constant += min(residue, Decimal(0)) / rate
    if constant < -function.tolerance:
        missing = -float(constant) * (scale.gain if side.beside else 1 / scale.gain)
        raise ModelError(
            f"form {1 if side.other.beside else 2} of Foster lacks a resistance of {missing:.6g} "
            f"{'N.s/m' if side.beside else 'm/(N.s)'} for its negative residues; take synthesise()"
        )
    if constant > function.tolerance:
        parts.append(side.term(0, constant))
    return joined(side.beside, parts)


def _branch(other: Side, rate: Decimal, residue: Decimal) -> Tree:
    """Return r/(s + p), or r/(s + p) - r/p for r < 0, from its inverse."""
    if residue > 0:
        return joined(other.beside, [other.term(1, 1 / residue), other.term(0, rate / residue)])
    height = -residue / rate
    return joined(other.beside, [other.term(0, 1 / height), other.term(-1, rate / height)])
