"""What elements are: ports, the declarative base and the families of elements."""

from ..base import InertanceError as InertanceError
from ..base import InitialConditionError as InitialConditionError
from ..base import MissingFileError as MissingFileError
from ..base import MissingPackageError as MissingPackageError
from ..base import ModelError as ModelError
from ..base import OutputError as OutputError
from ..base import RunInterruptedError as RunInterruptedError
from ..base import SimulationError as SimulationError
from ..base import UnknownNameError as UnknownNameError
from ..base import UnknownPartError as UnknownPartError
from ..base import nearest as nearest
from . import rotational as rotational
from . import signals as signals
from .families import FAMILIES as FAMILIES
from .language import *  # noqa: F403
from .translational import *  # noqa: F403
from .transmission import *  # noqa: F403
