"""A closed volume of gas: its pressure, and the work that it has taken up."""

import casadi as ca

from .language import Expression

ATMOSPHERE = 101325.0  # [Pa]
LEAST_EXCESS = 1e-12  # of the exponent over 1, where the work of n = 1 differs by rounding only


def gas_pressure(V: Expression, p_0: Expression, V_0: Expression, n: Expression) -> Expression:
    """Return p = p_0 (V_0/V)^n."""
    return p_0 * (V_0 / V) ** n


def gas_energy(V: Expression, p_0: Expression, V_0: Expression, n: Expression) -> Expression:
    """Return the work that takes a gas from V_0 to V: p_0 V_0 ((V_0/V)^(n-1) - 1)/(n - 1), or its limit."""
    excess = ca.fmax(n - 1, LEAST_EXCESS)
    return p_0 * V_0 * ca.expm1(excess * ca.log(V_0 / V)) / excess
