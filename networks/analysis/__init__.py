"""What a network does near an operating point and in the frequency domain."""

from ...base.lazy_names import face

__getattr__, __dir__, __all__ = face(__name__, __file__)
