"""The module as a wheel, for the interpreter that runs this, of what CMake builds:

    pip wheel src/python --no-build-isolation --no-deps --no-index

Builds in build/release of the repository, or in the build tree that PALPATION_BUILD_TREE names, which must be for this interpreter. Writes nothing
beside the sources: what setuptools needs lies in the build tree, too.
"""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TREE = pathlib.Path(os.environ.get("PALPATION_BUILD_TREE", ROOT / "build" / "release"))
SCRATCH = TREE / "wheel"


def build_module():
    if "PALPATION_BUILD_TREE" in os.environ:
        subprocess.run(["cmake", "--build", str(TREE), "--target", "palpation_python"], check=True)
    else:
        chosen = f"-DPALPATION_MODULE_PYTHON={sys.executable}"
        subprocess.run([str(ROOT / "src/cmake/build"), "release", chosen, "palpation_python"], check=True)


class Binary(Distribution):
    """Holds a compiled module, so that the wheel says for which interpreter and machine."""

    def has_ext_modules(self):
        return True


class BuildModule(build_py):
    def run(self):
        build_module()
        package = pathlib.Path(self.build_lib) / "palpation"
        package.mkdir(parents=True, exist_ok=True)
        for path in sorted((TREE / "python" / "palpation").iterdir()):
            if path.is_file():
                self.copy_file(str(path), str(package / path.name))


def version():
    header = (ROOT / "include/palpation/version.h").read_text(encoding="utf-8")
    return ".".join(re.search(rf"PALPATION_VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH"))


SCRATCH.mkdir(parents=True, exist_ok=True)
setup(
    name="palpation",
    version=version(),
    description="Where to touch tissue next, and where the tumour under it ends",
    long_description=(HERE / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    license="GPL-3.0-or-later",
    python_requires=">=3.10",
    install_requires=["numpy"],
    packages=["palpation"],
    distclass=Binary,
    cmdclass={"build_py": BuildModule},
    options={"build": {"build_base": str(SCRATCH / "build")}, "egg_info": {"egg_base": str(SCRATCH)}},
    zip_safe=False,
)
