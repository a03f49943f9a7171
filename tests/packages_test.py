#!/usr/bin/env python3
"""The Debian packages that cpack makes of a build tree: what lies where, that the Depends of each cover every shared library that its programs ask for,
and that programs, module and CMake package work from where they were unpacked. lintian has no errors, where it is installed.

The citation names the version that is packed.

usage: packages_test.py BUILD_TREE PROJECT_ROOT CMAKE CPACK        ends with 77 (ctest: skipped) where Debian's tools for packages are missing
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

EXPECTED = {
    "palpation": ["usr/bin/palpate", "usr/bin/palpate-draw", "usr/share/man/man1/palpate.1.gz", "usr/share/bash-completion/completions/palpate",
                  "usr/bin/palpate-arm", "usr/share/palpation/ros/palpation_arm/driver.py", "usr/share/palpation/ros/msg/OperatingState.msg"],
    "libpalpation-dev": ["usr/include/palpation/palpation.h", "usr/include/palpation/version.h", "usr/lib/cmake/palpation/palpationConfig.cmake"],
    "python3-palpation": ["usr/lib/python3/dist-packages/palpation/__init__.py", "usr/lib/python3/dist-packages/palpation/py.typed"],
}

CONSUMER = """cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
find_package(palpation 0.1 CONFIG REQUIRED)
if(NOT TARGET palpation::palpation)
  message(FATAL_ERROR "no target")
endif()
"""


def told(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def is_elf(path):
    with open(path, "rb") as file:
        return path.is_file() and not path.is_symlink() and file.read(4) == b"\x7fELF"


def sonames_asked_for(path):
    return re.findall(r"\(NEEDED\)\s+Shared library: \[(.*?)\]", told("readelf", "-d", path))


def packages_of(sonames):
    """{soname: the Debian package that the loader would take it from}. dpkg knows files by the name that they were packed under."""
    cache = loader_cache()
    names = {}
    for soname in sonames:
        for path in {cache[soname], os.path.realpath(cache[soname])}:
            for name in (path, path.removeprefix("/usr"), "/usr" + path):
                names[name] = soname
    told_of = subprocess.run(["dpkg", "-S", *names], capture_output=True, text=True).stdout
    owners = {names[path]: words.split(":")[0] for words, path in (line.rsplit(": ", 1) for line in told_of.splitlines()) if path in names}
    for soname in sonames:
        assert soname in owners, f"{soname}: {cache[soname]} is of no package"
    return owners


def loader_cache():
    lines = re.findall(r"^\s+(\S+) \(.*x86-64.*\) => (\S+)$|^\s+(\S+) \(libc6\S*\) => (\S+)$", told("/sbin/ldconfig", "-p"), re.MULTILINE)
    cache = {}
    for a, b, c, d in lines:
        cache.setdefault(a or c, b or d)
    return cache


def sonames_of(root):
    """What the programs and libraries of an unpacked package ask for."""
    asked = set()
    for path in (path for path in root.rglob("*") if path.is_file() and is_elf(path)):
        asked |= set(sonames_asked_for(path))
        assert ".debug_info" not in told("readelf", "-S", path), f"{path} is not stripped"
    return asked - {"ld-linux-x86-64.so.2"}


def check_depends(name, deb, asked, owners):
    depends = {re.match(r"\s*(\S+)", word).group(1) for word in re.split(r"[,|]", told("dpkg-deb", "-f", deb, "Depends"))}
    for soname in sorted(asked):
        assert owners[soname] in depends, f"{name}: {soname} is of {owners[soname]}, which is not among its Depends: {sorted(depends)}"


def main():
    if len(sys.argv) != 5:
        sys.exit("usage: packages_test.py BUILD_TREE PROJECT_ROOT CMAKE CPACK")
    tree, root, cmake, cpack = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4]
    for tool in ("dpkg-deb", "dpkg-shlibdeps", "readelf", "gzip"):
        if shutil.which(tool) is None:
            print(f"skipped: {tool} is not installed")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as holder:
        folder = pathlib.Path(holder)
        told(cpack, "-B", folder / "work", "-D", f"CPACK_OUTPUT_FILE_PREFIX={folder / 'packages'}", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=tree)
        debs = {deb.name.split("_")[0]: deb for deb in (folder / "packages").glob("*.deb")}
        wanted = [name for name in EXPECTED if name != "python3-palpation" or os.path.isdir(os.path.join(tree, "python"))]
        assert sorted(debs) == sorted(wanted), sorted(debs)
        asked = {}
        for name, deb in debs.items():
            told("dpkg-deb", "-x", deb, folder / name)
            for path in [*EXPECTED[name], f"usr/share/doc/{name}/copyright", f"usr/share/doc/{name}/changelog.gz"]:
                assert (folder / name / path).exists(), f"{name}: {path} is missing"
            asked[name] = sonames_of(folder / name)
        owners = packages_of(set().union(*asked.values()))
        for name, deb in debs.items():
            check_depends(name, deb, asked[name], owners)
        version = told("dpkg-deb", "-f", debs["palpation"], "Version").strip()
        assert told(folder / "palpation/usr/bin/palpate", "--version").strip() == version
        assert f"\nversion: {version}\n" in (root / "src/CITATION.cff").read_text(encoding="utf-8")
        if "python3-palpation" in debs:
            place = folder / "python3-palpation/usr/lib/python3/dist-packages"
            said = told("/usr/bin/python3", "-c", "import palpation; print(palpation.__version__)", env={"PYTHONPATH": str(place), "PATH": os.environ["PATH"]})
            assert said.strip() == version, said
        (folder / "consumer").mkdir()
        (folder / "consumer/CMakeLists.txt").write_text(CONSUMER)
        told(cmake, "-S", folder / "consumer", "-B", folder / "consumer/build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={folder / 'libpalpation-dev/usr'}")
        if shutil.which("lintian"):
            words = subprocess.run(["lintian", "--allow-root", "--fail-on", "error", *debs.values()], capture_output=True, text=True)
            assert words.returncode == 0, words.stdout + words.stderr
        else:
            print("lintian is not installed: its rules were not checked")
    print(f"{len(debs)} packages, {len(owners)} shared libraries asked for, all of them in Depends")


if __name__ == "__main__":
    main()
