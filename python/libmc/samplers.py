from ._libmc.samplers import *  # noqa: F403
from ._libmc.samplers import __doc__  # noqa: F401
