"""What stays between limits."""

import casadi as ca

from .language import Expression


def limited(value: Expression, low: Expression, high: Expression) -> Expression:
    """Return a value brought between two limits."""
    return ca.fmin(ca.fmax(value, low), high)
