"""What elements are: ports, the declarative base and the families of elements."""

from ..base import OutputError as OutputError
from ..base import RunInterruptedError as RunInterruptedError
from ..base.errors import *  # noqa: F403
from . import rotational as rotational
from . import signals as signals
from . import thermal as thermal
from .families import FAMILIES as FAMILIES
from .language import *  # noqa: F403
from .translational import *  # noqa: F403
from .transmission import *  # noqa: F403
