"""A network as a C program."""

from .corners import corners_as_modes as corners_as_modes
from .corners import is_corner as is_corner
from .library_cache import CLibrary as CLibrary
from .program import CProgram as CProgram
from .program import c_program as c_program
from .toolchain import PLATFORMS as PLATFORMS
from .toolchain import ToolchainError as ToolchainError
from .toolchain import compile_shared as compile_shared
from .toolchain import compiler as compiler
