from ._libmc.warps import *  # noqa: F403
from ._libmc.warps import __doc__  # noqa: F401
