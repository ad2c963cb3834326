"""How elements join, and what is done with the equations."""

from ..base.lazy_names import face

__getattr__, __dir__, __all__ = face(__name__, __file__)
