"""Runs carlo, the command line of libmc: python3 -m libmc ARGUMENTS."""

import os
import shutil
import sys


def carlo():
    """The carlo of this package, else the first one on the PATH."""
    own = os.path.join(os.path.dirname(__file__), "bin", "carlo")
    return own if os.access(own, os.X_OK) else shutil.which("carlo")


def main():
    program = carlo()
    if program is None:
        sys.exit("libmc: carlo is not installed; install the package carlo, or libmc with pip")
    os.execv(program, ["carlo"] + sys.argv[1:])


if __name__ == "__main__":
    main()
