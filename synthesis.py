"""From an admittance to a network of springs, dampers and inerters."""

from .networks.synthesis import *
