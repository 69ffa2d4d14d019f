"""Integrals: values, agreement with carlo, interruption and errors."""

import _thread
import pickle
import threading
import time

import numpy as np
import pytest

import libmc
from libmc import warps


def gauss_cos(x):
    return np.exp(-x[:, 0] ** 2) * np.cos(x[:, 1])


BOX = [(0, 1), (-1, 2)]
TRUTH = 0.7468241328124271 * (np.sin(2) + np.sin(1))


def test_value_and_interval():
    r = libmc.integrate(gauss_cos, BOX, rel_error=1e-5)
    assert r.value == pytest.approx(TRUTH, rel=1e-4)
    assert r.interval[0] <= TRUTH <= r.interval[1]
    assert (r.error_bar, r.stop, r.converged, r.consistent) == ("known", "converged", True, True)
    assert float(r) == r.value and r.rounds[-1].calls <= r.calls
    assert repr(r).startswith("1.3075")


@pytest.mark.parametrize("method", ["plain", "stratified", "rqmc", "vegas", "tree", "auto"])
def test_results_are_those_of_carlo(method, carlo_json):
    options = ["--rel-error", "1e-4", "--max-calls", "200000", "--seed", "7"]
    theirs = carlo_json("integrate", "x*x*y + 1/(0.01 + x)", "-d", "x=0:1,y=0:2", "--method", method, *options)
    ours = libmc.integrate(
        lambda x: x[:, 0] * x[:, 0] * x[:, 1] + 1 / (0.01 + x[:, 0]),
        [(0, 1), (0, 2)],
        method=method,
        rel_error=1e-4,
        max_calls=200000,
        seed=7,
    )
    assert ours.calls == theirs["calls"]
    assert ours.value == pytest.approx(theirs["value"], rel=1e-12)
    assert ours.std_error == pytest.approx(theirs["std_error"], rel=1e-6)


@pytest.mark.parametrize(
    "f, domain, truth",
    [
        (lambda x: np.exp(-x), (0, np.inf), 1),
        (lambda x: np.exp(-x * x), (-np.inf, np.inf), np.sqrt(np.pi)),
        (lambda x: np.exp(-np.sum(x, axis=1)), [(0, np.inf)] * 3, 1),
        (lambda x: np.prod(x, axis=1), 4, 1 / 16),
        (lambda w: w[:, 2] ** 2, "hemisphere", 2 * np.pi / 3),
        (lambda w: w[:, 2] ** 2, libmc.Domain("sphere"), 4 * np.pi / 3),
        (lambda w: w[:, 2], warps.CosineHemisphere(), np.pi),
        (lambda x: x**2 * np.exp(-x * x / 2), warps.Normal(), np.sqrt(2 * np.pi)),
        (lambda x: 2.5, [(0, 1), (0, 2)], 5),
    ],
)
def test_domains(f, domain, truth):
    assert libmc.integrate(f, domain).value == pytest.approx(truth, rel=3e-3)


def test_blocks_have_the_documented_shapes():
    shapes = set()

    def f(x):
        shapes.add(x.shape[1:])
        assert 1 <= len(x) <= 4096 and x.flags.c_contiguous
        return np.ones(len(x))

    libmc.integrate(f, [(0, 1)])
    libmc.integrate(f, 3)
    libmc.integrate(f, (0, 1))
    libmc.integrate(f, "sphere")
    assert shapes == {(1,), (3,), (), (3,)}


def test_several_outputs():
    r = libmc.integrate(lambda x: np.stack([x[:, 0], x[:, 0] + x[:, 1]], axis=1), 2)
    assert [float(one) for one in r] == pytest.approx([0.5, 1], rel=1e-3)
    assert len(r) == 2 and r.correlation.shape == (2, 2)
    np.testing.assert_allclose(np.diag(r.covariance), [one.std_error**2 for one in r])


def test_threads_give_the_same_bits():
    one, two = (libmc.integrate(gauss_cos, BOX, threads=n) for n in (1, 2))
    assert (one.value, one.interval) == (two.value, two.interval)


def peak(x):
    return np.exp(-np.sum((x - 0.3) ** 2, axis=1) / 2e-4)


def test_densities_are_learned_and_pickled(tmp_path):
    r = libmc.integrate(peak, 3, method="vegas", max_calls=200000)
    copy = pickle.loads(pickle.dumps(r.density))
    r.density.save(str(tmp_path / "d.txt"))
    loaded = libmc.load_density(str(tmp_path / "d.txt"))
    x, density = copy.sample(libmc.samplers.sobol(1000, 3))
    np.testing.assert_allclose(loaded.pdf(x), density, rtol=1e-9)
    again = libmc.integrate(peak, 3, method="vegas", density=loaded)
    assert again.value == pytest.approx((2e-4 * np.pi) ** 1.5, rel=0.01)
    assert again.calls <= r.calls


def test_progress():
    seen = []
    libmc.integrate(peak, 3, progress=lambda *state: seen.append(state), max_calls=100000)
    assert seen and all(len(s) == 4 for s in seen)
    assert [s[2] for s in seen] == sorted(s[2] for s in seen)


def slow(x):
    time.sleep(1e-3)
    return peak(x)


def test_keyboard_interrupt_returns_what_is_known():
    timer = threading.Timer(0.4, _thread.interrupt_main)
    timer.start()
    start = time.monotonic()
    r = libmc.integrate(slow, 3, rel_error=0, abs_error=0, max_calls=10**9)
    assert r.stop == "cancelled" and np.isfinite(r.value) and not r.converged
    assert time.monotonic() - start < 10
    timer.join()


def test_keyboard_interrupt_before_an_estimate():
    threading.Timer(0.05, _thread.interrupt_main).start()

    def very_slow(x):
        time.sleep(0.1)
        return x[:, 0]

    with pytest.raises(KeyboardInterrupt):
        libmc.integrate(very_slow, 2)


def test_an_exception_of_f_ends_the_run():
    def f(x):
        raise LookupError("no table")

    with pytest.raises(LookupError, match="no table"):
        libmc.integrate(f, 2)


def test_not_finite():
    with pytest.raises(libmc.NotFiniteError, match="not finite") as e:
        libmc.integrate(lambda x: np.where(x[:, 0] < 0.5, np.nan, 1), 2)
    assert e.value.u.shape == (2,) and e.value.u[0] < 0.5
    assert 0 < e.value.bad <= e.value.points
    assert isinstance(e.value, libmc.Error)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: libmc.integrate(lambda x: x[:, :1].T, 2), r"f returned an array of shape \(1, 2\)"),
        (lambda: libmc.integrate(lambda x: 1j * x[:, 0], 2), r"an array of complex128; real numbers"),
        (lambda: libmc.integrate(lambda x: None, 2), r"real numbers are needed"),
        (lambda: libmc.integrate(gauss_cos, [(1, 0), (0, 1)]), r"coordinate 0 has the bounds 1 and 0; lo < hi"),
        (lambda: libmc.integrate(gauss_cos, [1, 2, 3]), r"bounds of shape \(3,\)"),
        (lambda: libmc.integrate(gauss_cos, 0), r"a unit cube of 0 dimensions"),
        (lambda: libmc.integrate(gauss_cos, 2, method="vegass"), r"vegas"),
        (lambda: libmc.integrate(gauss_cos, 2, rel_error=-1), r"-1"),
        (lambda: libmc.integrate(gauss_cos, "no domain"), r"no domain"),
    ],
)
def test_errors_name_the_value(call, message):
    with pytest.raises(libmc.Error, match=message):
        call()
