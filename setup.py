"""Builds the Python module for pip: pip install --no-build-isolation . (Debian: python3-skbuild, tools/bootstrap.sh)."""

import pathlib
import re

from skbuild import setup

ROOT = pathlib.Path(__file__).parent
VERSION = re.search(r"project\(mc VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

setup(
    name="libmc",
    version=VERSION,
    description="Monte Carlo integration and sampling whose samplers obey checked laws",
    long_description=(ROOT / "python/README.md").read_text(),
    long_description_content_type="text/markdown",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["libmc"],
    package_dir={"": "python"},
    package_data={"libmc": ["py.typed"]},
    cmake_install_dir="python",
    cmake_install_target="install_python",
    cmake_args=[
        "-DMC_PYTHON=ON",
        "-DMC_NATIVE=OFF",  # a wheel may move to another machine
        "-DMC_BUILD_TESTS=OFF",
        "-DMC_PYTHON_PACKAGE_DIR=libmc",
        "-DCMAKE_INSTALL_BINDIR=libmc/bin",
        "-DCMAKE_INSTALL_DATAROOTDIR=libmc/share",
        "-DCMAKE_INSTALL_DATADIR=libmc/share",
    ],
)
