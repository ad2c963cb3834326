"""Where measured data and a model part, and which missing effect parts them."""

from . import across as across
from . import blackbox as blackbox
from . import channels as channels
from . import joined as joined
from . import series as series
from .edits import between as between
from .effects import Effect as Effect
from .effects import Quantity as Quantity
from .effects import register as register
from .search import diagnose as diagnose
from .verdict import DiagnosisInterruptedError as DiagnosisInterruptedError
from .verdict import Gap as Gap
from .verdict import Ranked as Ranked
from .verdict import Verdict as Verdict
