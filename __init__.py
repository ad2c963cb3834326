"""inertance: acausal 1-D mechanics. Join elements at flanges, run the machine."""

from inertance.base.lazy_names import face

_find, __dir__, __all__ = face(__name__, __file__)


def __getattr__(name: str) -> object:
    """Return what a name stands for; its module is imported when it is first asked for."""
    if name == "__version__":
        from importlib.metadata import version

        return version("inertance")
    return _find(name)
