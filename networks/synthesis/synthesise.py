"""`synthesise`: from an admittance to springs, dampers and inerters that have it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base import ModelError
from ..two_terminal import TwoTerminal, parallel
from .bott_duffin import Side, realise
from .polynomials import many_digits
from .positive import required_positive_real
from .ratio import Ratio
from .rational import RationalFunction
from .tree import Tree

ACCURACY, LOSS = 1e-9, 1e4


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
    return checked(network_tree(function), function)


def network_tree(function: RationalFunction) -> Tree:
    """Return the network of a function as a tree."""
    with many_digits():
        ratio, scale = Ratio.normalised(function)
        required_positive_real(ratio, scale)
        return realise(ratio, Side(beside=True)).at(scale)


def checked(tree: Tree, function: RationalFunction) -> TwoTerminal:
    """Return a network as a component, once its admittance is seen to be the one wanted.

    Raises:
        ModelError: if it is not, at points around all poles and zeros, off the axis.
    """
    corners = np.abs(np.r_[function.poles, function.zeros])
    corners = corners[corners > 0] if (corners > 0).any() else np.ones(1)
    s = np.geomspace(corners.min() / 10, corners.max() * 10, 60) * np.exp(0.45j * np.pi)
    got, wanted = tree(s), function(s)
    error = np.abs(got - wanted) / np.abs(wanted)
    worst = int(np.argmax(error))
    if not error[worst] <= ACCURACY + LOSS * function.accuracy:
        raise ModelError(
            f"the network found has the admittance {got[worst]:.9g} N.s/m, not {wanted[worst]:.9g} N.s/m, at "
            f"s = {s[worst]:.6g} rad/s: its coefficients are too close to degenerate; round or cancel them"
        )
    component = tree.component()
    joined: Any = component if isinstance(component, TwoTerminal) else parallel(component)
    found: TwoTerminal = joined
    return found
