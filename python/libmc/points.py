from ._libmc.points import *  # noqa: F403
from ._libmc.points import __doc__  # noqa: F401
