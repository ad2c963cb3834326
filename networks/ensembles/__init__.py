"""One model run many times side by side."""

from .ensemble import ensemble as ensemble
from .result import Ensemble as Ensemble
