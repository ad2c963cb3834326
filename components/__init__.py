"""What elements are: ports, the declarative base and the families of elements."""

from ..base import OutputError as OutputError
from ..base import RunInterruptedError as RunInterruptedError
from ..base.errors import *  # noqa: F403
from . import rotational as rotational
from . import signals as signals
from . import thermal as thermal
from .families import FAMILIES as FAMILIES
from .gases import gas_energy as gas_energy
from .gases import gas_pressure as gas_pressure
from .language import *  # noqa: F403
from .lossy import Lossy as Lossy
from .translational import *  # noqa: F403
from .transmission import *  # noqa: F403
