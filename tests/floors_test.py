#!/usr/bin/env python3
"""The floors of the house: who may include whom.

Reads the include lines of include/ and src/ and fails on an upward or sideways arrow, on a third party outside the folders that may use it, and on
anything but the standard library, Eigen and the project's own headers in a public header. Headers in src/ follow the same floors. All that is installed is
in palpation/palpation.h. Before it judges the tree it judges samples that it must
reject: a guard that cannot bark is worse than none.

usage: floors_test.py PROJECT_ROOT        needs Python 3 and nothing else
"""

import pathlib
import re
import sys
import tempfile

# From the ground up. Folders on one floor are blind to each other.
FLOORS = [
    ["base"],
    ["geometry"],
    ["readings", "probing", "robot"],
    ["belief", "boundary"],
    ["decision", "certainty", "world"],
    ["exploration"],
    ["io"],
    ["results", "session"],
    ["scene"],
    ["tool", "experiments", "link", "draw", "python"],
]
FLOOR_OF = {folder: floor for floor, folders in enumerate(FLOORS) for folder in folders}
PROGRAMS = {"results", "scene", "tool", "experiments", "link", "draw", "python"}  # no public headers, and nothing is installed
ROOFS = {"src/tool/main.cpp"}  # a program's main puts the siblings of its floor together

# Third party: how its headers are spelled, and the folders whose sources may use it. Boost also comes with CGAL, as the language of its graphs.
THIRD_PARTIES = {
    "OpenMesh": (r"OpenMesh/", {"geometry"}),
    "Boost.Math": (r"boost/math/", {"base", "experiments"}),
    "CGAL": (r"CGAL/|boost/", {"geometry", "boundary"}),
    "NLopt": (r"nlopt\.", {"belief"}),
    "VTK": (r"vtk\w+(\.|/)", {"boundary", "io", "draw"}),
    "CLI11": (r"CLI/", {"tool", "link", "draw"}),
    "nlohmann-json": (r"nlohmann/", PROGRAMS - {"python"} | {"session"}),
    "OpenIGTLink": (r"igtl\w+\.h", {"link"}),
    "pybind11": (r"pybind11/", {"python"}),
    "EGL, OpenGL and X11": (r"(E?GL|X11)/", {"draw"}),
}
EIGEN = re.compile(r"Eigen/\w+$")

# The standard library's headers have no dot. The machine's own may be used in sources, never in a public header.
STANDARD = re.compile(r"[a-z][a-z0-9_]*$")
OF_THE_MACHINE = re.compile(r"(unistd|fcntl|netdb|dlfcn|errno|signal|spawn|poll|malloc|termios|immintrin|x86intrin|cpuid)\.h$|sys/\w+\.h$")

INCLUDE = re.compile(r'^[ \t]*#[ \t]*(?:include|include_next|import)\b[ \t]*(.*)$', re.MULTILINE)
NAMED = re.compile(r'(?:"([^"]+)"|<([^>]+)>)')
BLOCK_COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def without_comments(code):
    """The code with comments and raw strings blanked; the lines stay, and so do plain strings, which include lines need."""

    def blank(match):
        text = match.group(0)
        return text if text.startswith('"') else " " + "\n" * text.count("\n")

    return BLOCK_COMMENT_OR_TEXT.sub(blank, code)


def includes_of(code):
    """(line number, header or None where it is not spelled out) of every include line."""
    code = without_comments(code.replace("\\\n", ""))
    for match in INCLUDE.finditer(code):
        named = NAMED.match(match.group(1))
        yield code.count("\n", 0, match.start()) + 1, (named.group(1) or named.group(2)) if named else None


def arrow_fault(folder, other):
    """What is wrong with an arrow between folders, or None."""
    if FLOOR_OF[other] > FLOOR_OF[folder]:
        return f"an upward arrow, {folder} is on floor {FLOOR_OF[folder]} and {other} on floor {FLOOR_OF[other]}"
    if FLOOR_OF[other] == FLOOR_OF[folder] and other != folder:
        return f"a sideways arrow, {folder} and {other} are both on floor {FLOOR_OF[folder]}"
    return None


def fault(folder, is_public, header, is_roof=False):
    """What is wrong with a file of this folder including this header, or None."""
    if header is None:
        return "an include line must spell its header out"
    if ".." in header.split("/"):
        return f"{header}: name it from the root, without .."

    parts = header.split("/")
    if header == "palpation/version.h":
        return None  # which stands on no floor
    if parts[0] == "palpation":
        if len(parts) != 3 or parts[1] not in FLOOR_OF or parts[1] in PROGRAMS:
            return f"{header}: the project's headers are palpation/<folder>/<unit>.h"
        words = None if folder is None else arrow_fault(folder, parts[1])
        return f"{header}: {words}" if words else None

    if len(parts) == 2 and parts[0] in FLOOR_OF:
        if is_public:
            return f"{header}: a private header in a public one"
        words = None if is_roof and FLOOR_OF[parts[0]] == FLOOR_OF[folder] else arrow_fault(folder, parts[0])
        return f"{header}: {words}" if words else None

    for party, (spelling, folders) in THIRD_PARTIES.items():
        if re.match(spelling, header):
            if is_public:
                return f"{header}: {party} in a public header"
            return None if folder in folders else f"{header}: {party} may only be used in {', '.join(sorted(folders))}"

    if EIGEN.match(header) or STANDARD.match(header):
        return None
    if OF_THE_MACHINE.match(header) and not is_public:
        return None
    return f"{header}: unknown. A third party needs a place in the table of tests/floors_test.py, a header of the project its full name"


def files_of(root):
    """(path, folder or None for the header of everything, is public) of every source and header, in the order of their names."""
    for path in sorted((root / "include").rglob("*")) + sorted((root / "src").rglob("*")):
        if path.suffix not in {".h", ".hpp", ".hh", ".cpp", ".cc", ".c", ".inl", ".ipp"}:
            continue
        parts = path.relative_to(root).parts
        if parts[0] == "include":
            is_everything = parts[1:] in (("palpation", "palpation.h"), ("palpation", "version.h"))
            yield path, None if is_everything else parts[2] if len(parts) == 4 and parts[1] == "palpation" else "", True
        else:
            yield path, parts[1] if len(parts) == 3 else "", False


def faults_of(root):
    """Every fault of a tree as "file:line: words", and how many include lines were read."""
    faults, read = [], 0
    for path, folder, is_public in files_of(root):
        place = path.relative_to(root).as_posix()
        if folder is not None and (folder not in FLOOR_OF or (is_public and folder in PROGRAMS)):
            faults.append(f"{place}:1: stands on no floor: {'include/palpation' if is_public else 'src'}/<folder>/<unit> is the pattern")
            continue
        for line, header in includes_of(path.read_text(encoding="utf-8")):
            read += 1
            words = fault(folder, is_public, header, place in ROOFS)
            if words:
                faults.append(f"{place}:{line}: {words}")
    return faults + unlisted(root), read


def unlisted(root):
    """Headers that are installed and that the header of everything, where there is one, does not include."""
    everything = root / "include/palpation/palpation.h"
    if not everything.exists():
        return []
    listed = {header for _, header in includes_of(everything.read_text(encoding="utf-8"))}
    units = sorted(path.relative_to(root / "include").as_posix() for path in (root / "include/palpation").glob("*/*.h"))
    return [f"include/{unit}:1: is installed, and palpation/palpation.h does not include it" for unit in units if unit not in listed]


# (file, its text, part of the words of the fault or None where there must be none)
SAMPLES = [
    ("include/palpation/geometry/good.h", '#include <vector>\n#include <Eigen/Core>\n#include "palpation/base/types.h"\n', None),
    ("include/palpation/decision/good.h", '#include "palpation/belief/level.h"\n#include "palpation/boundary/region.h"\n', None),
    ("include/palpation/palpation.h", '#include "palpation/io/read_mesh.h"\n#include "palpation/base/types.h"\n', None),
    ("src/geometry/good.cpp", '#include "geometry/half_edges.h"\n#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>\n#include <CGAL/AABB_tree.h>\n', None),
    ("src/belief/good.cpp", "#include <nlopt.hpp>\n#include <Eigen/Cholesky>\n", None),
    ("src/boundary/good.cpp", "#include <vtkContourFilter.h>\n#include <CGAL/Polygon_set_2.h>\n#include <boost/variant.hpp>\n", None),
    ("src/io/good.cpp", "#include <vtkXMLPolyDataWriter.h>\n#include <fcntl.h>\n#include <sys/stat.h>\n", None),
    ("src/tool/good.cpp", '#include <CLI/CLI.hpp>\n#include <nlohmann/json.hpp>\n#include "tool/commands.h"\n#include "scene/scene.h"\n#include "palpation/io/read_mesh.h"\n', None),
    ("src/tool/main.cpp", '#include "tool/commands.h"\n#include "experiments/experiment.h"\n', None),
    ("src/experiments/good.cpp", '#include <nlohmann/json.hpp>\n#include "scene/scene.h"\n#include "experiments/experiment.h"\n', None),
    ("src/tool/sibling.cpp", '#include "experiments/experiment.h"\n', "sideways"),
    ("src/experiments/sibling.cpp", '#include "tool/commands.h"\n', "sideways"),
    ("src/scene/upstairs.cpp", '#include "tool/commands.h"\n', "upward"),
    ("src/io/shared.cpp", '#include "scene/scene.h"\n', "upward"),
    ("src/scene/third.cpp", "#include <CLI/CLI.hpp>\n", "CLI11 may only"),
    ("src/draw/good.cpp", "#include <vtkRenderer.h>\n#include <nlohmann/json.hpp>\n#include <EGL/egl.h>\n#include <dlfcn.h>\n", None),
    ("src/python/good.cpp", '#include <pybind11/pybind11.h>\n#include "io/landing.h"\n', None),
    ("src/link/good.cpp", '#include <igtlPolyDataMessage.h>\n#include <netdb.h>\n#include "scene/scene.h"\n', None),
    ("src/link/beside.cpp", '#include "tool/commands.h"\n', "sideways"),
    ("src/tool/link.cpp", "#include <igtlPolyDataMessage.h>\n", "OpenIGTLink may only"),
    ("src/python/beside.cpp", '#include "tool/commands.h"\n', "sideways"),
    ("src/io/python.cpp", "#include <pybind11/numpy.h>\n", "pybind11 may only"),
    ("src/session/good.cpp", '#include <nlohmann/json.hpp>\n#include "palpation/session/session.h"\n#include "io/landing.h"\n', None),
    ("src/session/upstairs.cpp", '#include "scene/scene.h"\n', "upward"),
    ("include/palpation/session/third.h", "#include <nlohmann/json.hpp>\n", "public header"),
    ("src/base/comment.cpp", '// #include <vtkObject.h>\n/* \n#include <CGAL/enum.h>\n*/\nconst char* text = R"(\n#include <CLI/CLI.hpp>\n)";\n', None),
    ("src/base/address.cpp", 'const char* where = "https://example.org/*"; // */\n', None),
    ("include/palpation/base/up.h", '#include "palpation/geometry/surface.h"\n', "upward"),
    ("include/palpation/geometry/up.h", "#pragma once\n\n#include <palpation/belief/level.h>\n", "upward"),
    ("include/palpation/world/up.h", '#  include "palpation/exploration/run.h"\n', "upward"),
    ("src/readings/up.cpp", '#include "palpation/belief/kernel.h"\n', "upward"),
    ("src/exploration/up.cpp", '#include "palpation/io/read_mesh.h"\n', "upward"),
    ("src/belief/sideways.cpp", '#include "palpation/boundary/region.h"\n', "sideways"),
    ("src/boundary/sideways.cpp", '#include "palpation/belief/level.h"\n', "sideways"),
    ("src/decision/sideways.cpp", '\t# include\t"palpation/world/phantom.h"\n', "sideways"),
    ("src/certainty/sideways.cpp", '/* why */ /* not */\n#include "palpation/decision/tour.h" // because\n', "sideways"),
    ("src/belief/after_text.cpp", 'const char* text = "/*";\n#include "palpation/io/read_mesh.h"\n', "upward"),
    ("src/base/continued.cpp", '#include \\\n  "palpation/io/read_mesh.h"\n', "upward"),
    ("src/base/third.cpp", "#include <CGAL/number_utils.h>\n", "CGAL may only"),
    ("src/base/quoted.cpp", '#include "vtkObject.h"\n', "VTK may only"),
    ("src/geometry/third.cpp", "#include <vtkPolyData.h>\n", "VTK may only"),
    ("src/geometry/optimizer.cpp", "#include <nlopt.h>\n", "NLopt may only"),
    ("src/boundary/third.cpp", "#include <OpenMesh/Core/IO/MeshIO.hh>\n", "OpenMesh may only"),
    ("src/world/third.cpp", "#include <boost/math/special_functions.hpp>\n", "Boost.Math may only"),
    ("src/base/boost.cpp", "#include <boost/graph/graph_traits.hpp>\n", "CGAL may only"),
    ("src/exploration/third.cpp", "#include <nlohmann/json.hpp>\n", "nlohmann-json may only"),
    ("src/io/third.cpp", "#include <CLI/App.hpp>\n", "CLI11 may only"),
    ("src/tool/third.cpp", "#include <vtkRenderer.h>\n", "VTK may only"),
    ("src/io/window.cpp", "#include <EGL/egl.h>\n", "X11 may only"),
    ("src/base/stranger.cpp", "#include <fmt/format.h>\n", "unknown"),
    ("src/base/short.cpp", '#include "types.h"\n', "unknown"),
    ("src/base/macro.cpp", "#include HEADER\n", "spell"),
    ("src/base/dots.cpp", '#include "palpation/base/../io/read_mesh.h"\n', "without .."),
    ("src/boundary/shared.cpp", '#include "geometry/half_edges.h"\n#include "base/cross.h"\n', None),
    ("src/tool/shared.cpp", '#include "boundary/erosion.h"\n', None),
    ("src/io/upstairs.cpp", '#include "tool/commands.h"\n', "upward"),
    ("src/geometry/upstairs.cpp", '#include "boundary/erosion.h"\n', "upward"),
    ("src/boundary/beside.cpp", '#include "belief/sites.h"\n', "sideways"),
    ("src/draw/beside.cpp", '#include "tool/commands.h"\n', "sideways"),
    ("include/palpation/boundary/third.h", "#include <CGAL/Polygon_set_2.h>\n", "public header"),
    ("include/palpation/geometry/third.h", "#include <OpenMesh/Core/Mesh/Traits.hh>\n", "public header"),
    ("include/palpation/io/third.h", "#include <vtkSmartPointer.h>\n", "public header"),
    ("include/palpation/geometry/private.h", '#include "geometry/half_edges.h"\n', "private header in a public one"),
    ("include/palpation/base/machine.h", "#include <unistd.h>\n", "unknown"),
    ("include/palpation/base/nobody.h", '#include "palpation/attic/chest.h"\n', "palpation/<folder>"),
    ("include/palpation/base/tool.h", '#include "palpation/tool/scene.h"\n', "palpation/<folder>"),
    ("include/palpation/attic/chest.h", "#include <vector>\n", "no floor"),
    ("include/palpation/loose.h", "#include <vector>\n", "no floor"),
    ("include/palpation/tool/scene.h", "#include <vector>\n", "no floor"),
    ("src/loose.cpp", "#include <vector>\n", "no floor"),
    ("src/attic/chest.cpp", "#include <vector>\n", "no floor"),
]


def test_itself():
    """Each sample alone in a tree of its own: exactly the fault that is expected, or none."""
    for name, code, expected in SAMPLES:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(code, encoding="utf-8")
            faults, _ = faults_of(pathlib.Path(folder))
        if expected is None and faults:
            sys.exit(f"this test is broken: {name} is innocent, but it says {faults}")
        if expected is not None and not (len(faults) == 1 and faults[0].startswith(name + ":") and expected in faults[0]):
            sys.exit(f"this test is broken: {name} has one fault, {expected}, but it says {faults}")


def test_that_all_is_listed():
    """Of two public headers beside the header of everything, the one that it leaves out is the fault."""
    with tempfile.TemporaryDirectory() as folder:
        base = pathlib.Path(folder) / "include/palpation/base"
        base.mkdir(parents=True)
        for unit in ("error", "types"):
            (base / f"{unit}.h").write_text("#include <vector>\n", encoding="utf-8")
        (base.parent / "palpation.h").write_text('#include "palpation/base/error.h"\n', encoding="utf-8")
        faults, _ = faults_of(pathlib.Path(folder))
    if len(faults) != 1 or not faults[0].startswith("include/palpation/base/types.h:1: is installed"):
        sys.exit(f"this test is broken: base/types.h alone is left out, but it says {faults}")


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: floors_test.py PROJECT_ROOT")
    test_itself()
    test_that_all_is_listed()

    faults, read = faults_of(pathlib.Path(sys.argv[1]))
    if read < 20:
        sys.exit(f"only {read} include lines in {sys.argv[1]}: that is not the project")
    if faults:
        sys.exit("\n".join(faults + [f"{len(faults)} faults. The floors, from the ground up: {FLOORS}"]))
    print(f"{len(SAMPLES)} samples judged right; {read} include lines, no arrow up or sideways")


if __name__ == "__main__":
    main()
