"""The law of smooth hysteresis that Bouc-Wen elements share."""

import casadi as ca

from .language import Expression

LEAST_HYSTERESIS = 1e-300  # [unit of z]


def wen_rate(
    v: Expression, z: Expression, A: Expression, beta: Expression, gamma: Expression, n: Expression
) -> Expression:
    """Return z' = A v - beta |v| |z|^(n-1) z - gamma v |z|^n.

    Source: Y.-K. Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263.
    """
    size = ca.fmax(ca.fabs(z), LEAST_HYSTERESIS)  # above 0, where x^n has a slope in n
    return A * v - beta * ca.fabs(v) * size ** (n - 1) * z - gamma * v * size**n
