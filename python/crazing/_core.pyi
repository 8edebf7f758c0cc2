"""The compiled module, as mypy sees it; `mypy.stubtest` holds it to the truth."""

import numpy as np
from numpy.typing import NDArray

__version__: str
DEBUG: bool

class CrazingError(ValueError): ...
class DegenerateInputError(CrazingError): ...
class InternalError(RuntimeError): ...

def sample_uniform(
    n: int, bounds: tuple[float, float, float, float], key: tuple[int, int]
) -> NDArray[np.float64]: ...
def sample_normal(
    n: int, loc: tuple[float, float], scale: tuple[float, float], key: tuple[int, int]
) -> NDArray[np.float64]: ...
def sample_laplace(
    n: int, loc: tuple[float, float], scale: tuple[float, float], key: tuple[int, int]
) -> NDArray[np.float64]: ...
