"""Problems: what is wrong with a network, in words."""

from __future__ import annotations


class FatalProblem(str):
    """A problem that leaves no structure to look at for more."""

    __slots__ = ()
