"""From an admittance to springs, dampers and inerters that have it: `synthesise`, and Foster's forms."""

from __future__ import annotations

from decimal import Decimal, localcontext
from typing import Any, cast

import numpy as np

from ...base import ModelError, whole
from ..two_terminal import TwoTerminal, parallel
from .bott_duffin import realise
from .polynomials import DIGITS, derivative, positive_roots, value
from .positive import required_positive_real
from .ratio import Ratio, Scale
from .rational import RationalFunction
from .tree import Side, Tree, scaled_by

TOLERANCE, ACCURACY_LOSS = 1e-9, 1e4


def synthesise(admittance: Any) -> TwoTerminal:
    """Return springs, dampers and inerters that have an admittance Y(s) = F/v [N.s/m].

    Poles on the imaginary axis and resistances are split off while they lead on; where neither does, a bridge
    goes on without transformers. A regular biquadratic takes at most five elements, any other at most eight.

    Args:
        admittance: what `RationalFunction.of` takes: (num, den), highest power first, or a linear system.

    Raises:
        NotPositiveRealError: if it is not positive-real, with the frequency [Hz] that shows it.
        ModelError: if it is zero, or coefficients are too close to degenerate to be realised.

    Source: R. Bott, R. J. Duffin, J. Appl. Phys. 20 (1949) 816; J. Z. Jiang, M. C. Smith, IEEE Trans.
    Automat. Contr. 56 (2011) 1275-1290 (biquadratics of two reactive elements); T. H. Hughes, IEEE Trans.
    Automat. Contr. 62 (2017) 4333-4346 (bridges).

    Example:
        >>> from inertance.analysis import admittance
        >>> from inertance.synthesis import synthesise
        >>> strut = synthesise(([1.0, 2.0], [1.0, 1.0]))
        >>> round(abs(admittance(strut)(1j).item()), 6)  # |(j + 2)/(j + 1)|
        1.581139
    """
    function = RationalFunction.of(admittance)
    if not function.num:
        raise ModelError("this admittance is zero: nothing between the flanges has it")
    with localcontext(prec=DIGITS):
        ratio, scale = required_positive_real(function)
        tree = scaled_by(scale, realise(ratio, Side(beside=True)))
    return _checked(tree, function)


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
    with localcontext(prec=DIGITS):
        ratio, scale = required_positive_real(function)
        side = Side(beside=form == 2)
        tree = _branches(ratio if side.beside else ratio.inverse, side, scale)
    return _checked(scaled_by(scale, tree), function)


def _branches(function: Ratio, side: Side, scale: Scale) -> Tree:
    poles, rest = function.axis_poles()
    parts = [*map(side.pole, poles)]
    constant = rest.num[-1] / rest.den[-1] if len(rest.num) == len(rest.den) else Decimal(0)
    rates = positive_roots([c if k % 2 == 0 else -c for k, c in enumerate(rest.den)])
    if len(rates) < len(rest.den) - 1:
        raise ModelError(
            f"form {1 if side.other.beside else 2} of Foster has no branch for complex or multiple poles, of "
            f"which there are {len(rest.den) - 1 - len(rates)}; take synthesise()"
        )
    for rate in rates if rest.num else []:
        residue = value(rest.num, -rate) / value(derivative(rest.den), -rate)
        parts.append(_branch(side, rate, residue))
        constant += min(residue, Decimal(0)) / rate
    if constant < -function.tolerance:
        missing = -float(constant) * (scale.gain if side.beside else 1 / scale.gain)
        raise ModelError(
            f"form {1 if side.other.beside else 2} of Foster lacks a resistance of {missing:.6g} "
            f"{'N.s/m' if side.beside else 'm/(N.s)'} for its negative residues; take synthesise()"
        )
    if constant > function.tolerance:
        parts.append(side.term(0, constant))
    return side.joined(parts)


def _branch(side: Side, rate: Decimal, residue: Decimal) -> Tree:
    """Return r/(s + p), or r/(s + p) - r/p for r < 0, from its inverse."""
    if residue > 0:
        return side.inverse({1: 1 / residue, 0: rate / residue})
    height = -residue / rate
    return side.inverse({0: 1 / height, -1: rate / height})


def _checked(tree: Tree, function: RationalFunction) -> TwoTerminal:
    """Return a network as a component, once its admittance at points off the axis is the one wanted."""
    corners = np.abs(np.r_[function.poles, function.zeros])
    corners = corners[corners > 0] if (corners > 0).any() else np.ones(1)
    s = np.geomspace(corners.min() / 10, corners.max() * 10, 60) * np.exp(0.45j * np.pi)
    got, wanted = tree(s), function(s)
    error = np.abs(got - wanted) / np.abs(wanted)
    worst = int(np.argmax(error))
    if not error[worst] <= TOLERANCE + ACCURACY_LOSS * function.accuracy:
        raise ModelError(
            f"the network found has the admittance {got[worst]:.9g} N.s/m, not {wanted[worst]:.9g} N.s/m, at "
            f"s = {s[worst]:.6g} rad/s: its coefficients are too close to degenerate; round or cancel them"
        )
    component = tree.component()
    return component if isinstance(component, TwoTerminal) else cast(TwoTerminal, parallel(component))
