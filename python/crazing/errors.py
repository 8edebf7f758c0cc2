"""The exceptions of the library."""

from crazing._core import CrazingError, DegenerateInputError, InternalError

__all__ = ["CrazingError", "DegenerateInputError", "InternalError"]
