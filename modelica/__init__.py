"""Networks as models of other tools: Modelica text."""

from .export import to_modelica as to_modelica
from .export import write_modelica as write_modelica

__all__ = ["to_modelica", "write_modelica"]
