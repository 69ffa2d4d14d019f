from ._libmc.mis import *  # noqa: F403
from ._libmc.mis import __doc__  # noqa: F401
