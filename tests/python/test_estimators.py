"""Weights of multiple importance sampling, and control variates."""

import numpy as np
import pytest

import libmc
from libmc import mis, samplers


def test_weights_sum_to_one():
    p = 10.0 ** samplers.random(100, 3) * np.array([1e-30, 1, 1e30])
    for heuristic in ("balance", "power", "cutoff", "maximum"):
        w = mis.weights(p, [1, 4, 2], heuristic)
        assert w.shape == p.shape
        np.testing.assert_allclose(w.sum(axis=1), 1)
    np.testing.assert_array_equal(mis.weights([0, 0]), [0, 0])


def test_two_techniques():
    f, g = np.array([1.0, 2.0, 0.0]), 3.0
    np.testing.assert_allclose(mis.balance_heuristic(f, g), f / (f + g))
    np.testing.assert_allclose(mis.power_heuristic(f, g, 2, 1), (2 * f) ** 2 / ((2 * f) ** 2 + g**2))
    both = np.stack([f, np.full(3, g)], axis=1)
    np.testing.assert_allclose(mis.weights(both, [2, 1], "power")[:, 0], mis.power_heuristic(f, g, 2, 1))


def test_control_variates():
    halves = []
    for seed in (1, 2):
        x = samplers.random(5000, 1, seed)[:, 0]
        c = libmc.ControlVariates([0.5])
        c.add(np.exp(x), x)
        halves.append(c)
    value, error = libmc.cross_fitted_estimate(*halves)
    assert abs(value - (np.e - 1)) < 5 * error
    both = halves[0]
    both.merge(halves[1])
    assert len(both) == 10000
    assert error < both.without_controls()[1] / 4
    assert both.coefficients() == pytest.approx([1.69], abs=0.02)
    assert both.estimate([0])[0] == both.without_controls()[0]


def of_mean(mean):
    c = libmc.ControlVariates([mean])
    c.add([1, 2, 3], [0.1, 0.6, 0.8])
    return c


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: mis.weights([1, -1]), r"a density of -1; it must be >= 0"),
        (lambda: mis.weights([[1, 2.0]], [np.inf, 1]), r"a count of inf; it must be finite"),
        (lambda: mis.balance_heuristic(np.nan, 1), r"balance_heuristic: f is nan; it must be >= 0"),
        (lambda: mis.power_heuristic(None, 1), r"power_heuristic: f: an array of object"),
        (lambda: mis.power_heuristic(1, 1, n_g=-1), r"n_g is -1; it must be finite and >= 0"),
        (lambda: mis.balance_heuristic(np.ones(3), np.ones(4)), r"shapes \(3,\), \(4,\), \(\) and \(\) cannot"),
        (lambda: mis.weights([1, 1], [1]), r"1 counts for 2 techniques"),
        (lambda: mis.weights([1, 1], heuristic="pwer"), r"must be balance, power, cutoff or maximum"),
        (lambda: mis.weights([1, 1], heuristic="power", beta=0), r"power 0 must be > 0"),
        (lambda: libmc.ControlVariates([]), r"control"),
        (lambda: libmc.ControlVariates([0.5]).add([1, 2], [1]), r"as many are needed"),
        (lambda: libmc.ControlVariates([0.5]).add(np.ones((4, 1)), np.ones(4)), r"f of shape \(4, 1\)"),
        (lambda: libmc.cross_fitted_estimate(of_mean(0.5), of_mean(0.6)), r"means of the controls differ"),
        (lambda: libmc.ControlVariates([0.5]).coefficients(), r"0 values; at least 2 are needed"),
    ],
)
def test_errors_name_the_value(call, message):
    with pytest.raises(libmc.Error, match=message):
        call()
