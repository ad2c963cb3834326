"""Ready-made machines."""

from ...base.lazy_names import face

__getattr__, __dir__, __all__ = face(__name__, __file__)
