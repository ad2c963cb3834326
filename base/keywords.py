"""Keywords that are passed on: a wrong one is told with the nearest that there is."""

import inspect
from collections.abc import Callable, Iterable
from typing import Any

from . import ModelError, nearest


def check_keywords(where: str, given: Iterable[str], taker: Callable[..., Any]) -> None:
    """Check the keywords that a function passes on.

    Args:
        where: the function that was called, such as "simulate()".
        given: the keywords.
        taker: the function that takes them.

    Raises:
        ModelError: for those that it does not know, with the nearest it does.
    """
    names = list(given)
    if not names:
        return
    known = [p.name for p in inspect.signature(taker).parameters.values() if p.kind is p.KEYWORD_ONLY]
    unknown = [f"there is no argument '{name}'{nearest(name, known)}" for name in names if name not in known]
    if unknown:
        raise ModelError(f"{where} takes {', '.join(known)}:", unknown)
