from collections.abc import Mapping
from typing import Any

import numpy.typing as npt

from . import Conclusion, Surface

KINDS: tuple[str, ...]

def to_vtk(tissue: Surface | Conclusion, fields: Mapping[str, npt.ArrayLike] | None = ...) -> Any: ...
def boundary_to_vtk(conclusion: Conclusion, *, risk: float = ...) -> Any: ...
