"""Ready-made machines."""

from . import ge_wang as ge_wang
