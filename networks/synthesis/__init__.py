"""From an admittance to a network of springs, dampers and inerters."""

from ...base.lazy_names import face

__getattr__, __dir__, __all__ = face(__name__, __file__)
