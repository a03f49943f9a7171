"""Where should a robot touch tissue next, where does the tumour under it end, and how sure is that?

    import palpation as pp

    tissue = pp.read_mesh("organ.ply", unit="mm").surface()
    exploration = pp.Exploration(tissue)
    while stops := exploration.ask():
        exploration.tell(robot.touch(stops.positions))
    print(exploration.conclusion.region().wkt, exploration.conclusion.summary())

Lengths are metres, whatever unit a mesh is given in; places are in the mesh's frame. Arrays come in as what numpy makes an
array of, and are copied; what an immutable object holds comes out as a read-only view. Other threads run while the library
works, and Ctrl-C ends it. The licence is GPL-3.0-or-later, and what imports this module and is handed on must be, too.
"""

from ._palpation import (
    Conclusion,
    Disk,
    Error,
    Exploration,
    Horseshoe,
    InvalidInput,
    InvalidMesh,
    IoError,
    Mesh,
    Model,
    NumericalError,
    Outline,
    Phantom,
    Plan,
    Random,
    Readings,
    Region,
    Session,
    SessionPlan,
    Stops,
    Surface,
    WriteError,
    __version__,
    compare,
    conclude,
    make_cylinder,
    make_dome,
    make_folded,
    make_plane,
    make_saddle,
    make_wave,
    reachable_vertices,
    read_mesh,
    set_thread_count,
    superlevel_region,
    surface_area,
    thread_count,
    waypoints,
    write_mesh,
)
from ._vtk import boundary_to_vtk, to_vtk

__all__ = [
    "Conclusion",
    "Disk",
    "Error",
    "Exploration",
    "Horseshoe",
    "InvalidInput",
    "InvalidMesh",
    "IoError",
    "Mesh",
    "Model",
    "NumericalError",
    "Outline",
    "Phantom",
    "Plan",
    "Random",
    "Readings",
    "Region",
    "Session",
    "SessionPlan",
    "Stops",
    "Surface",
    "WriteError",
    "__version__",
    "boundary_to_vtk",
    "compare",
    "conclude",
    "make_cylinder",
    "make_dome",
    "make_folded",
    "make_plane",
    "make_saddle",
    "make_wave",
    "reachable_vertices",
    "read_mesh",
    "set_thread_count",
    "superlevel_region",
    "surface_area",
    "thread_count",
    "to_vtk",
    "waypoints",
    "write_mesh",
]
