"""The compiled module, as mypy sees it; `mypy.stubtest` holds it to the truth."""

__all__ = ["DEBUG", "CrazingError", "DegenerateInputError", "InternalError", "__version__"]

__version__: str
DEBUG: bool

class CrazingError(ValueError): ...
class DegenerateInputError(CrazingError): ...
class InternalError(RuntimeError): ...
