"""Real polynomials in many digits: lists of coefficients, lowest power first."""

from __future__ import annotations

from decimal import Decimal
from itertools import pairwise, zip_longest

Polynomial = list[Decimal]
DIGITS = 80
ZERO, ONE = Decimal(0), Decimal(1)
MOST_NEWTON_STEPS = 400
VANISHING_SHARE = Decimal("1e-60")
ROUNDING_SHARE = Decimal("1e-74")


def trimmed(p: Polynomial) -> Polynomial:
    """Drop leading zeros."""
    while p and p[-1] == 0:
        p = p[:-1]
    return p


def plus(p: Polynomial, q: Polynomial, factor: Decimal = ONE) -> Polynomial:
    """Return p + factor q; where both cancel but for the last digits, nothing is left."""
    sums = ((a, a + factor * b) for a, b in zip_longest(p, q, fillvalue=ZERO))
    return trimmed([total if abs(total) > VANISHING_SHARE * abs(a) else ZERO for a, total in sums])


def scaled(p: Polynomial, factor: Decimal) -> Polynomial:
    """Return factor p."""
    return [factor * a for a in p]


def times(p: Polynomial, q: Polynomial) -> Polynomial:
    """Return p q."""
    product = [ZERO] * max(len(p) + len(q) - 1, 0)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] += a * b
    return product


def by_s(p: Polynomial) -> Polynomial:
    """Return s p."""
    return [ZERO, *p] if p else []


def divided(p: Polynomial, q: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Return quotient and rest of p / q."""
    rest, quotient = list(p), [ZERO] * max(len(p) - len(q) + 1, 0)
    for k in reversed(range(len(quotient))):
        quotient[k] = factor = rest[k + len(q) - 1] / q[-1]
        for j, b in enumerate(q):
            rest[k + j] -= factor * b
    return quotient, rest[: len(q) - 1]


def derivative(p: Polynomial) -> Polynomial:
    """Return dp/ds."""
    return [k * a for k, a in enumerate(p)][1:]


def value(p: Polynomial, x: Decimal) -> Decimal:
    """Return p(x)."""
    total = ZERO
    for a in reversed(p):
        total = total * x + a
    return total


def size(p: Polynomial, x: Decimal) -> Decimal:
    """Return the sum of the sizes of the terms of p(x), x >= 0: what rounding is measured by."""
    return value([abs(a) for a in p], x)


def even(p: Polynomial) -> Polynomial:
    """Return E(x), x = w^2, of p(jw) = E(w^2) + jw O(w^2)."""
    return [a if k % 2 == 0 else -a for k, a in enumerate(p[::2])]


def odd(p: Polynomial) -> Polynomial:
    """Return O(x), x = w^2, of p(jw) = E(w^2) + jw O(w^2)."""
    return even(p[1:])


def positive_roots(p: Polynomial) -> list[Decimal]:
    """Return the roots x > 0 of a polynomial, each once, in order.

    Between the roots of its derivative a polynomial runs one way, so each stretch holds one root or none.
    """
    p = trimmed(p)
    while p and p[0] == 0:
        p = p[1:]
    if len(p) < 2:
        return []
    far = 1 + max(abs(a / p[-1]) for a in p[:-1])
    corners = [ZERO, *positive_roots(derivative(p)), far]
    roots: list[Decimal] = []
    for (left, before), (right, after) in pairwise([(x, _sign(p, x)) for x in corners]):
        if before == 0:
            roots.append(left)
        elif before * after < 0:
            roots.append(_root_between(p, left, right))
    return roots


def _sign(p: Polynomial, x: Decimal) -> int:
    """Return the sign of p(x), 0 where no more than rounding is left of it."""
    total = value(p, x)
    return 0 if abs(total) <= VANISHING_SHARE * size(p, x) else 1 if total > 0 else -1


def _root_between(p: Polynomial, left: Decimal, right: Decimal) -> Decimal:
    """Return the root in a stretch, by Newton's steps, parting the stretch where they do not help."""
    slope, sizes, rising = derivative(p), [abs(a) for a in p], value(p, right) > 0
    x = _middle(left, right)
    here = value(p, x)
    for _ in range(MOST_NEWTON_STEPS):
        if abs(here) <= ROUNDING_SHARE * value(sizes, x) or right - left <= VANISHING_SHARE * right:
            break
        left, right = (left, x) if (here > 0) == rising else (x, right)
        steep, before = value(slope, x), here
        x = x - here / steep if steep else left
        helps = left < x < right and 2 * abs(here := value(p, x)) < abs(before)
        if not helps:
            x = _middle(left, right)
            here = value(p, x)
    return x


def _middle(left: Decimal, right: Decimal) -> Decimal:
    """Return the geometric mean of far ends, the arithmetic one of near ones."""
    low = max(left, right / 10**6)
    return (low * right).sqrt() if right > 4 * low else (left + right) / 2
