"""Union-find over signed variables, closed under time differentiation.

If x = y then der(x) = der(y): joining two variables joins their derivatives, so that masses rigidly
joined, or a velocity and the derivative of a position, are one variable without any index reduction.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


class SignedUnion:
    """Classes of variables equal up to sign; variable i is `sign[i]` times its root, a root's sign is 1."""

    def __init__(self, size: int) -> None:
        self.parent = list(range(size))
        self.sign = [1] * size
        self.derivative: dict[int, int] = {}
        self.contradictions: list[int] = []

    def new(self) -> int:
        """Add a variable and return its index."""
        self.parent.append(len(self.parent))
        self.sign.append(1)
        return len(self.parent) - 1

    def find(self, i: int) -> tuple[int, int]:
        """Return the root of a variable and the sign against it."""
        above = self.parent[i]
        if self.parent[above] == above:
            return above, self.sign[i]
        path = []
        while self.parent[i] != i:
            path.append(i)
            i = self.parent[i]
        sign = 1
        for j in reversed(path):
            sign *= self.sign[j]
            self.parent[j], self.sign[j] = i, sign
        return i, sign

    def set_derivative(self, i: int, derivative: int) -> None:
        """State that `derivative` is the time derivative of variable i."""
        root, sign = self.find(i)
        if root in self.derivative:
            self.join(self.derivative[root], derivative, sign)
        else:
            if sign < 0:
                negative = self.new()
                self.join(derivative, negative, -1)
                derivative = negative
            self.derivative[root] = derivative

    def join(self, i: int, j: int, sign: int = 1) -> None:
        """State that variable i equals `sign` times variable j, and so do their derivatives."""
        a, b = self.parent[i], self.parent[j]
        if self.parent[a] != a or self.parent[b] != b:
            a, b = self.find(i)[0], self.find(j)[0]
        sign *= self.sign[i] * self.sign[j]
        if a == b:
            if sign < 0:
                self.contradictions.append(a)
            return
        self.parent[b], self.sign[b] = a, sign
        lost = self.derivative.pop(b, None)
        if lost is not None:
            self.set_derivative(b, lost)

    def arrays(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return root and sign of every variable."""
        parent, sign = np.array(self.parent, dtype=np.int64), np.array(self.sign, dtype=np.int64)
        while (parent[parent] != parent).any():
            sign, parent = sign * sign[parent], parent[parent]
        return parent, sign
