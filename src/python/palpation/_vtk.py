"""Tissue and boundaries as VTK holds them, with the arrays of the tool's surface.vtp and boundary.vtp. VTK is imported when it is asked for."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _palpation

if TYPE_CHECKING:
    import numpy.typing as npt

    from . import Conclusion, Surface

KINDS = ("estimate", "truth", "band_inner", "band_outer", "cut")  # the numbers of the array `kind`


def _modules(function: str) -> tuple[Any, Any, Any]:
    try:
        core = importlib.import_module("vtkmodules.vtkCommonCore")
        model = importlib.import_module("vtkmodules.vtkCommonDataModel")
        support = importlib.import_module("vtkmodules.util.numpy_support")
    except ImportError as error:
        raise ImportError(
            f"{function}: VTK's Python modules are missing (Debian: python3-vtk9; pip: vtk). Without them Surface.write_vtp writes files for ParaView."
        ) from error
    return core, model, support


def _polydata(function: str, points: Any) -> Any:
    core, model, support = _modules(function)
    polydata = model.vtkPolyData()
    places = core.vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(support.numpy_to_vtk(np.ascontiguousarray(points, dtype=np.float64), deep=True))
    polydata.SetPoints(places)
    for name, word in (("UNIT", "m"), ("FRAME", "mesh")):
        text = core.vtkStringArray()
        text.SetName(name)
        text.InsertNextValue(word)
        polydata.GetFieldData().AddArray(text)
    return polydata


def _cells(function: str, sizes: Any, corners: Any) -> Any:
    _, model, support = _modules(function)
    cells = model.vtkCellArray()
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    connectivity = np.ascontiguousarray(corners, dtype=np.int64)
    cells.SetData(support.numpy_to_vtkIdTypeArray(offsets, deep=True), support.numpy_to_vtkIdTypeArray(connectivity, deep=True))
    return cells


def _numbers(name: str, given: Any, count: int) -> Any:
    numbers = np.asarray(given)
    if numbers.dtype.kind not in "fiub" or numbers.shape != (count,):
        raise _palpation.InvalidInput(
            f"to_vtk: field '{name}': is of {numbers.dtype!r} and shape {numbers.shape}, must be of real numbers and shape ({count},): one a vertex"
        )
    return np.ascontiguousarray(numbers, dtype=np.float64)


def to_vtk(tissue: Surface | Conclusion, fields: Mapping[str, npt.ArrayLike] | None = None) -> Any:
    """The triangles as a vtkPolyData, with an array of doubles at the points for each field: of a Conclusion its `fields()`, as surface.vtp has them,
    and those that are given. Metres in the mesh's frame. Raises InvalidInput for a field that has not one number a vertex, or the name of another;
    ImportError, with what to install, where VTK is missing."""
    named: dict[str, Any] = {}
    surface = tissue.surface if isinstance(tissue, _palpation.Conclusion) else tissue
    if isinstance(tissue, _palpation.Conclusion):
        named.update(tissue.fields())
    elif not isinstance(tissue, _palpation.Surface):
        raise TypeError(f"to_vtk: tissue must be a Surface or a Conclusion, not {type(tissue)}")
    for name, given in (fields or {}).items():
        if not name or name in named:
            raise _palpation.InvalidInput(f"to_vtk: field '{name}' needs a name of its own")
        named[name] = _numbers(name, given, len(surface.vertices))
    polydata = _polydata("to_vtk", surface.vertices)
    faces = surface.faces
    polydata.SetPolys(_cells("to_vtk", np.full(len(faces), 3), faces.ravel()))
    _, _, support = _modules("to_vtk")
    for name, numbers in named.items():
        array = support.numpy_to_vtk(numbers, deep=True)
        array.SetName(name)
        polydata.GetPointData().AddArray(array)
    return polydata


def boundary_to_vtk(conclusion: Conclusion, *, risk: float = 0.05) -> Any:
    """The conclusion's `curves(risk)` as a vtkPolyData of closed lines, with the cell arrays of boundary.vtp: `kind` (0 the estimate, 2 the inner and 3
    the outer border of the band, 4 the cut), `kind_name`, `part`, `hole`. Metres in the mesh's frame. Raises ImportError where VTK is missing."""
    curves = conclusion.curves(risk=risk)
    points = np.concatenate([curve["points"] for curve in curves]) if curves else np.zeros((0, 3))
    polydata = _polydata("boundary_to_vtk", points)
    core, _, _ = _modules("boundary_to_vtk")
    sizes, corners, first = [], [], 0
    for curve in curves:
        count = len(curve["points"])
        corners.append(np.append(np.arange(first, first + count), first))
        sizes.append(count + 1)
        first += count
    polydata.SetLines(_cells("boundary_to_vtk", sizes, np.concatenate(corners) if corners else []))
    columns = {
        "kind": (core.vtkIntArray(), [KINDS.index(curve["kind"]) for curve in curves]),
        "kind_name": (core.vtkStringArray(), [curve["kind"] for curve in curves]),
        "part": (core.vtkIntArray(), [curve["part"] for curve in curves]),
        "hole": (core.vtkIntArray(), [int(curve["hole"]) for curve in curves]),
    }
    for name, (array, values) in columns.items():
        array.SetName(name)
        for value in values:
            array.InsertNextValue(value)
        polydata.GetCellData().AddArray(array)
    return polydata
