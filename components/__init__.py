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
from .language import Component as Component
from .language import Domain as Domain
from .language import RealInput as RealInput
from .language import RealOutput as RealOutput
from .language import RotationalFlange as RotationalFlange
from .language import Sampled as Sampled
from .language import Shock as Shock
from .language import Stated as Stated
from .language import TranslationalFlange as TranslationalFlange
from .language import der as der
from .language import impulse as impulse
from .language import mode as mode
from .language import option as option
from .language import parameter as parameter
from .language import variable as variable
from .translational import *  # noqa: F403
from .transmission import *  # noqa: F403
