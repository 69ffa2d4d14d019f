"""Monte Carlo integration and sampling whose samplers obey checked laws.

    import libmc
    x = libmc.warps.CosineHemisphere().sample(libmc.samplers.sobol(1024, 2))
    libmc.integrate(lambda x: x[:, 0] * x[:, 1], [(0, 1), (0, 2)])
    libmc.assert_distribution(my_sample, my_pdf, "hemisphere")

The C++ library computes everything; arrays are NumPy's.
"""

from . import _libmc, mis, points, samplers, warps
from ._libmc import __version__

_submodules = ["mis", "points", "samplers", "warps"]
_names = [name for name in dir(_libmc) if not name.startswith("_") and name not in _submodules]
__all__ = ["__version__", "assert_distribution"] + _submodules + _names
globals().update({name: getattr(_libmc, name) for name in _names})

# Users see the names of the package, in messages and in pickles.
for _part in [_libmc] + [getattr(_libmc, name) for name in _submodules]:
    for _name in dir(_part):
        if getattr(getattr(_part, _name), "__module__", None) == _part.__name__ and isinstance(
            getattr(_part, _name), type
        ):
            getattr(_part, _name).__module__ = _part.__name__.replace("._libmc", "")


def assert_distribution(sampler, pdf=None, domain=None, invert=None, **options):
    """Raises AssertionError with the finding unless check() passes: for pytest. The arguments are those of check()."""
    __tracebackhide__ = True
    report = _libmc.check(sampler, pdf, domain, invert, **options)
    if not report:
        raise AssertionError(report.text())
    return report
