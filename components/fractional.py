"""Derivatives of fractional order over a band of frequencies, as springs and dampers approximate them."""

from typing import Any

import numpy as np

from .language import Expression


def oustaloup(
    alpha: Expression, w_low: Expression, decades: Expression, n: int
) -> tuple[Expression, list[Expression], list[Expression]]:
    """Return g, k_i and p_i of s^alpha ~ g + sum of k_i s/(s + p_i) from w_low on, for some decades.

    Its n zeros and n poles stand evenly in the logarithm of the frequency. With alpha between 0 and 1 all k_i
    are above 0: a spring beside n Maxwell elements.

    Source: A. Oustaloup, F. Levron, B. Mathieu, F. M. Nanot, Frequency-band complex noninteger
    differentiator, IEEE Trans. Circuits Syst. I 47 (2000) 25-39; the partial fractions are written here.
    """
    band = 10**decades
    zeros = [w_low * band ** ((i + 0.5 - alpha / 2) / n) for i in range(n)]
    poles = [w_low * band ** ((i + 0.5 + alpha / 2) / n) for i in range(n)]
    stiffnesses = []
    for i, pole in enumerate(poles):
        part: Any = -((w_low * band) ** alpha) / pole
        for k in range(n):
            part = part * (zeros[k] - pole) / (1.0 if k == i else poles[k] - pole)
        stiffnesses.append(part)
    return w_low**alpha, stiffnesses, poles


def largest_error(alpha: float, w_low: float, decades: float, n: int, share: float) -> float:
    """Return the largest |approximation/(j w)^alpha - 1| in the middle share of the band's logarithm."""
    static, stiffnesses, poles = oustaloup(alpha, w_low, decades, n)
    half = np.log(10) * decades / 2
    s = 1j * w_low * np.exp(half + half * share * np.linspace(-1, 1, 100 * n))
    told = static + sum(k * s / (s + p) for k, p in zip(stiffnesses, poles, strict=True))
    return float(np.abs(told / s**alpha - 1).max())
