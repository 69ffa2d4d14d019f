"""Warps and tables: shapes, values, laws and errors."""

import numpy as np
import pytest

import libmc
from libmc import samplers, warps

NORMALS = warps.TrowbridgeReitzVisibleNormals((0.6, 0, 0.8), 0.3, 0.1)
JAGGED = [1, 0, 3, 2, 0, 5]
ALL = [
    warps.UniformInterval(-3, 1),
    warps.Linear(1, 3),
    warps.Tent(1, 0.5),
    warps.Normal(2, 3),
    warps.Exponential(2),
    warps.TrimmedExponential(3, 2),
    warps.Logistic(0, 2),
    warps.TrimmedLogistic(1, -3, 8),
    warps.Smoothstep(),
    warps.Power(2.5),
    warps.UniformDisk(),
    warps.UniformDiskPolar(),
    warps.UniformTriangle(),
    warps.UniformAnnulus(0.5, 2),
    warps.UniformParallelogram((0, 0, 0), (1, 2, 3), (-1, 0, 0.5)),
    warps.Bilinear(1, 2, 3, 4),
    warps.IsotropicNormal(2),
    warps.UniformBox([0, -1], [1, 1]),
    warps.UniformBox([0, -1, 2], [1, 1, 3]),
    warps.UniformBall(),
    warps.UniformRotation(),
    warps.UniformSphere(),
    warps.UniformHemisphere(),
    warps.CosineHemisphere(),
    warps.UniformCone(0.3),
    warps.SphereLight((0, 1, 1), 0.5),
    warps.SphericalRectangle((0.3, -0.2, 0.9), (1, 0.1, -0.2), (0.3, 1, 0.05)),
    warps.SphericalTriangle((0.3, -0.2, 0.9), (1, 0.1, -0.2), (0.3, 1, 0.05)),
    warps.BlinnPhong(20),
    warps.HenyeyGreenstein(0.7),
    warps.VonMisesFisher(10),
    warps.BeckmannNormals(0.3),
    warps.TrowbridgeReitzNormals(0.3, 0.2),
    NORMALS,
    warps.BeckmannVisibleNormals((0.6, 0, 0.8), 0.3, 0.1),
    warps.Reflected(NORMALS),
    warps.Reflected(warps.BeckmannVisibleNormals((0.6, 0, 0.8), 0.3)),
    warps.Reflected(warps.BeckmannNormals(0.3), (0.6, 0, 0.8)),
    warps.RefractedIn(NORMALS, 1.5),
    warps.RefractedOut(warps.TrowbridgeReitzNormals(0.3), (0.6, 0, 0.8), 1 / 1.5),
    warps.Rotated(warps.CosineHemisphere(), (0.6, 0, 0.8)),
    warps.TableDist1D(JAGGED, -1, 2),
    warps.TableDist2D(np.arange(12).reshape(3, 4)),
    warps.TableDist2D.from_lat_long(np.ones((8, 16))),
    warps.TableDistTree(2, [(0, 0.25), (-1, 1), (1, 0.5), (-1, 2), (-1, 3)]),
    warps.TableDistTree.from_function(lambda x: np.exp(-8 * np.sum(x**2)), 3, 50),
    warps.Mixture([1, 2], [warps.UniformHemisphere(), warps.CosineHemisphere()]),
    warps.Mixture([1, 3], [warps.Tent(), warps.UniformInterval(0, 2)], domain="x=-1:2"),
    warps.Product(warps.Tent(), warps.Normal()),
]
DISCRETE = [
    warps.AliasTable(JAGGED),
    warps.TableDist1D(JAGGED),
    warps.ShortDiscrete(JAGGED),
    warps.UniformDiscrete(6),
    warps.Bernoulli(0.3),
]


def test_every_class_is_tested():
    classes = {c for c in vars(warps).values() if isinstance(c, type)} - {warps.Warp}
    assert classes == {type(w) for w in ALL + DISCRETE}


@pytest.mark.parametrize("warp", ALL, ids=repr)
def test_arrays_of_any_shape(warp):
    u = samplers.sobol(60, warp.dim, 7)
    if warp.dim == 1:
        u = u[:, 0]
    x = warp.sample(u)
    tail = (warp.point_size,) if warp.point_size > 1 else ()
    assert x.shape == (60,) + tail
    assert np.all(np.isfinite(x))
    assert np.all(warp.pdf(x) > 0)
    assert np.all(warp.domain.contains(x))
    cube = warp.sample(u.reshape((3, 4, 5) + u.shape[1:]))
    np.testing.assert_array_equal(cube, x.reshape((3, 4, 5) + tail))
    np.testing.assert_array_equal(warp.sample(u[7]), x[7])  # single points run without sample_n
    np.testing.assert_array_equal(warp.sample(np.asfortranarray(u)), x)
    out = np.empty_like(x)
    assert warp.sample(u, out=out) is out
    np.testing.assert_array_equal(out, x)
    assert warp.sample(u[:0]).shape == (0,) + tail
    assert warp.pdf(x).shape == (60,)


@pytest.mark.parametrize("warp", ALL, ids=repr)
def test_many_points_are_mapped_as_few(warp):
    """Arrays are mapped in blocks; three rows one by one."""
    u = samplers.sobol(3000, warp.dim, 5)
    u = u[:, 0].copy() if warp.dim == 1 else u
    x = warp.sample(u)

    def in_parts(f, rows):
        return np.concatenate([f(rows[i : i + 3]) for i in range(0, len(rows), 3)])

    np.testing.assert_array_equal(x, in_parts(warp.sample, u))
    np.testing.assert_array_equal(warp.pdf(x), in_parts(warp.pdf, x))
    if warp.is_invertible:
        np.testing.assert_array_equal(warp.invert(x), in_parts(warp.invert, x))
    if x.shape == u.shape:
        own = u.copy()
        assert warp.sample(own, out=own) is own
        np.testing.assert_array_equal(own, x)


def test_places_of_wrong_points():
    u = samplers.sobol(3000, 2)
    disk = warps.UniformDisk()
    x = disk.sample(u)
    x[100] = 2
    with pytest.raises(libmc.Error, match="point 100 = "):
        disk.invert(x)
    u[1500, 1] = 1
    with pytest.raises(libmc.Error, match="coordinate 1 of point 1500 is 1"):
        disk.sample(u)
    before = u.copy()
    with pytest.raises(libmc.Error, match="point 1500"):
        disk.sample(u, out=u)
    np.testing.assert_array_equal(u, before)


@pytest.mark.parametrize("warp", [w for w in ALL if w.is_invertible], ids=repr)
def test_inverse(warp):
    u = samplers.sobol(1000, warp.dim, 3)
    if warp.dim == 1:
        u = u[:, 0]
    np.testing.assert_allclose(warp.invert(warp.sample(u)), u, atol=1e-11)


@pytest.mark.parametrize("warp", ALL, ids=repr)
def test_obeys_its_laws(warp):
    report = libmc.check(warp, samples=20000, invert_eps=1e5, mass_eps=1e6, evidence=False)
    assert report, report.text()


def test_density_integrates_to_one():
    warp = warps.VonMisesFisher(10)
    assert libmc.integrate(warp.pdf, warp.domain).value == pytest.approx(1, rel=1e-3)


@pytest.mark.parametrize("table", DISCRETE, ids=repr)
def test_discrete_outcomes(table):
    u = samplers.sobol(1 << 14, 1)[:, 0]
    index, pmf, remapped = table.sample_index(u)
    assert index.shape == pmf.shape == remapped.shape == u.shape
    shares = np.bincount(index, minlength=len(table)) / len(u)
    np.testing.assert_allclose(shares, table.pmf(np.arange(len(table))), atol=1e-3)
    np.testing.assert_array_equal(pmf, table.pmf(index))
    assert np.all((remapped >= 0) & (remapped < 1))
    with pytest.raises(libmc.Error, match=r"pmf: outcome 9; there are outcomes 0 to"):
        table.pmf([9])


def test_mixtures_of_every_size_of_points():
    rotations = warps.Mixture([1, 2], [warps.UniformRotation(), warps.UniformRotation()])
    np.testing.assert_allclose(np.sum(rotations.sample(samplers.random(100, 3)) ** 2, axis=1), 1)
    assert libmc.check(rotations, samples=100_000)


def test_mixtures_on_equal_domains():
    libmc.assert_distribution(warps.Mixture([1, 3], [warps.UniformCone(0.3), warps.UniformCone(0.3)]), samples=100_000)


def test_a_product_has_factors_of_one_dimension():
    assert "both factors have one dimension" in warps.Product.__doc__


def test_the_frame_of_a_sphere_light():
    center = np.array([3.0, 0.0, 4.0])
    light = warps.SphereLight(tuple(center), 1.0)
    np.testing.assert_allclose(light.frame @ light.frame.T, np.eye(3), atol=1e-15)
    directions = light.sample(samplers.random(1000, 2)) @ light.frame
    assert np.all(directions @ center / 5 >= np.sqrt(1 - 1 / 25) - 1e-12)


def step(x):
    return 1.0 if 0.25 < x[0] < 0.5 and 0.3 < x[1] < 0.7 else 0.0


@pytest.mark.parametrize("f", [lambda x: 1.0, step, lambda x: x[0] ** 2])
def test_trees_of_any_function(f):
    libmc.assert_distribution(warps.TableDistTree.from_function(f, 2, 500), samples=100_000)


def test_contracts_of_the_headers_are_docstrings():
    assert "invert : |invert(sample(u)) - u| <= 8 eps" in warps.UniformDisk.__doc__
    assert repr(warps.Tent(1, 2)) == "Tent(center=1, radius=2)"
    assert repr(warps.UniformDisk().domain) == "<libmc.Domain: the unit disk>"


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: warps.UniformDisk().sample([[0.1, 1.0]]), r"sample: u: coordinate 1 of point 0 is 1; it must lie in"),
        (lambda: warps.UniformDisk().sample([[0.1, np.nan]]), r"coordinate 1 of point 0 is nan"),
        (lambda: warps.UniformDisk().sample([0.1]), r"an array of shape \(1,\); the shape must be \(\.\.\., 2\)"),
        (lambda: warps.UniformDisk().sample([[0.1, 1j]]), r"an array of complex128; real numbers are needed"),
        (lambda: warps.UniformDisk().sample("ab"), r"an array of <U2; real numbers are needed"),
        (lambda: warps.UniformDisk().sample([[0.1, 0.2]], out=np.empty(3)), r"out: an array of shape \(3,\)"),
        (lambda: warps.UniformDisk().invert([2, 0]), r"invert: point 0 = \(2, 0\) lies outside of the domain"),
        (lambda: warps.Tent(0, -1), r"Tent: center 0, radius -1: both must be finite"),
        (lambda: warps.TableDist1D([0, 0]), r"0"),
        (lambda: warps.Mixture([1, 1], [warps.Tent(), warps.UniformDisk()], domain="disk"), r"they must agree"),
        (lambda: warps.Mixture([1, 1], [warps.Tent(), warps.Normal()]), r"name a domain that contains them"),
        (lambda: warps.Mixture([1], [warps.Tent(), warps.Tent()]), r"as many are needed"),
        (lambda: warps.Mixture([1, 1], [warps.UniformCone(0.3), warps.UniformCone(0.30000001)]), r"different domains"),
        (
            lambda: warps.Mixture(
                [1, 1],
                [
                    warps.UniformParallelogram((0, 0, 0), (1, 0, 0), (0, 1, 0)),
                    warps.UniformParallelogram((5, 0, 0), (1, 0, 0), (0, 0, 1)),
                ],
            ),
            r"different domains",
        ),
        (lambda: warps.TableDistTree.from_function(lambda x: None, 2, 8), r"TableDistTree: f returned"),
        (lambda: warps.TableDistTree.from_function(lambda x: x, 2, 8), r"shape \(2,\); one number is needed"),
        (lambda: warps.AliasTable(JAGGED).pmf([0.9]), r"pmf: outcome 0.9; there are outcomes"),
        (lambda: warps.Product(warps.Tent(), warps.UniformDisk()), r"both must have one"),
        (lambda: libmc.Domain("spheer"), r"did you mean 'sphere'"),
        (lambda: libmc.Domain("discrete=3"), r"a set of points is needed"),
    ],
)
def test_errors_name_the_value(call, message):
    with pytest.raises(libmc.Error, match=message):
        call()


def test_an_error_is_a_value_error():
    with pytest.raises(ValueError):
        warps.Power(-2)


def test_domain_charts():
    domain = libmc.Domain("t=0:2,hemisphere")
    v = samplers.random(100, domain.dim)
    x = domain.from_unit(v)
    assert (domain.dim, domain.point_size, x.shape) == (3, 4, (100, 4))
    np.testing.assert_allclose(domain.to_unit(x), v, atol=1e-12)
    np.testing.assert_allclose(domain.jacobian(v), 2 * 2 * np.pi)
    assert libmc.Domain("x=0:1").from_unit(libmc.Domain("x=0:1").to_unit(1.0)) <= 1
    assert not domain.contains([3, 0, 0, 1])
