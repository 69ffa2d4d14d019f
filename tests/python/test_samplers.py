"""Point sets and measures of their quality, compared with SciPy."""

import numpy as np
import pytest
from scipy.stats import qmc

import libmc
from libmc import points, samplers

NAMES = [
    "halton",
    "latin_hypercube",
    "lattice",
    "multi_jittered",
    "padded_sobol",
    "padded_sobol_4d",
    "random",
    "sobol",
    "stratified",
]


def test_every_sampler_is_tested():
    assert sorted(n for n in vars(samplers) if not n.startswith("_")) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_points_are_a_pure_function_of_seed_and_index(name):
    make = getattr(samplers, name)
    options = {"count": 5000} if name in ("stratified", "latin_hypercube", "multi_jittered") else {}
    whole = make(5000, 5, 3, **options)
    assert whole.shape == (5000, 5)
    assert whole.min() > 0 and whole.max() < 1
    np.testing.assert_allclose(whole.mean(axis=0), 0.5, atol=0.03)
    np.testing.assert_array_equal(make(900, 5, 3, first=4100, **options), whole[4100:])
    assert not np.array_equal(make(5000, 5, 4, **options), whole)
    assert make(0, 2).shape == (0, 2)


def test_unscrambled_sobol_is_scipys():
    ours, n = samplers.sobol(1024, 20, None), np.arange(1024)
    theirs = qmc.Sobol(20, scramble=False).random(1024)
    np.testing.assert_array_equal(ours[n ^ (n >> 1)], theirs)  # SciPy's order is that of the Gray code


def test_unscrambled_halton_is_scipys():
    theirs = qmc.Halton(12, scramble=False).random(3000)
    np.testing.assert_allclose(samplers.halton(3000, 12, None), theirs, rtol=1e-14, atol=1e-16)


def test_scrambled_sobol_is_a_net():
    assert points.net_quality(samplers.sobol(256, 2, 9)) == 0
    assert points.net_quality(samplers.random(256, 2)) > 0


@pytest.mark.parametrize(
    "ours, method",
    [("centered_discrepancy", "CD"), ("wraparound_discrepancy", "WD"), ("mixture_discrepancy", "MD")],
)
def test_discrepancies_are_roots_of_scipys(ours, method):
    p = samplers.halton(200, 3, 1)
    assert getattr(points, ours)(p) ** 2 == pytest.approx(qmc.discrepancy(p, method=method), rel=1e-9)
    assert points.l2_star_discrepancy(p) == pytest.approx(qmc.discrepancy(p, method="L2-star"), rel=1e-9)


def test_star_discrepancy():
    d = points.star_discrepancy(np.array([[0.5]]))
    assert d.exact and d.lower == 0.5 and repr(d) == "StarDiscrepancy(0.5)"
    bounds = points.star_discrepancy(samplers.sobol(4096, 8), work=10**6)
    assert 0 < bounds.lower < bounds.upper <= 1


def test_distances_and_spectrum():
    p = samplers.stratified(256, 2)
    assert 0 < points.smallest_distance(p, periodic=True) <= points.smallest_distance(p)
    spectrum = points.radial_power_spectrum(p, 20)
    assert spectrum.shape == (20,) and spectrum[0] < 0.1


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: samplers.sobol(4, 0), r"points of 0 dimensions"),
        (lambda: samplers.sobol(4, 2000, None), r"unscrambled points have at most 1024"),
        (lambda: samplers.sobol(4, 2, first=2**32), r"indices end at 2\^32"),
        (lambda: samplers.halton(4, 2, scramble="owne"), r"must be owen or digits"),
        (lambda: points.star_discrepancy([[0.5, 1.5]]), r"1\.5"),
        (lambda: points.star_discrepancy([0.5]), r"the shape must be \(n, d\)"),
    ],
)
def test_errors_name_the_value(call, message):
    with pytest.raises(libmc.Error, match=message):
        call()
