#!/usr/bin/env bash
# Installs a wheel into a new environment, and runs the module, carlo and the scenes there.
# Usage: check_wheel.sh FILE.whl
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
/usr/bin/python3 -m venv --system-site-packages "$folder/env"
"$folder/env/bin/pip" install --quiet --no-deps --no-index "$1"
cd "$folder"
env/bin/python - <<'PYTHON'
import os
import libmc
assert libmc.__file__.startswith(os.getcwd()), libmc.__file__
libmc.assert_distribution(libmc.warps.UniformDisk(), samples=20000)
assert libmc.render("cbox", size=(8, 8), spp=2).radiance.shape == (8, 8, 3)
PYTHON
env/bin/python -m libmc render cbox --size 8x8 --spp 2 -o a.exr | grep "8x8 pixels"
echo "check_wheel.sh: $(basename "$1") works"
