from .positive import NotPositiveRealError as NotPositiveRealError
from .positive import PositiveReal as PositiveReal
from .positive import positive_real as positive_real
from .rational import RationalFunction as RationalFunction
from .synthesise import foster as foster
from .synthesise import synthesise as synthesise
