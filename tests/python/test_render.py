"""Renders and comparisons of pictures."""

import _thread
import re
import threading
import time

import numpy as np
import pytest

import libmc

SMALL = {"size": (32, 24), "spp": 16}


def test_the_bits_are_those_of_carlo(carlo, tmp_path):
    path = tmp_path / "a.exr"
    carlo("render", "cbox", "-o", str(path), "--size", "32x24", "--spp", "16", "--seed", "3")
    theirs = libmc.read_image(path)
    ours = libmc.render("cbox", seed=3, **SMALL)
    assert ours.radiance.shape == ours.variance.shape == (24, 32, 3)
    np.testing.assert_array_equal(ours.radiance, theirs.radiance)
    np.testing.assert_array_equal(ours.variance, theirs.variance)
    assert ours.estimates == theirs.estimates == 2
    reach = 2  # of the filter, around the picture
    assert ours.samples == 16 * (32 + 2 * reach) * (24 + 2 * reach)
    assert ours.spp == 16 and not ours.partial and theirs.spp is None
    assert 0 < ours.relative_error <= ours.worst_error
    assert re.search(r"relative error [\d.]+ % \(worst block [\d.]+ %\)", repr(ours))


def test_seeds_agree_and_scenes_differ():
    # Pixels that share no noise, so that few of them tell the difference.
    a, b = (libmc.render("cbox", seed=seed, splat=False, adaptive=False, **SMALL) for seed in (1, 2))
    same = libmc.compare(a, b)
    assert same and same.agrees and same.p >= same.alpha
    assert set(same.metrics) == {"mse", "rmse", "mae", "relmse", "max", "mean_ratio"}
    brighter = libmc.Picture(1.2 * a.radiance, 1.44 * a.variance)
    other = libmc.compare(brighter, b)
    assert not other and other.p < 1e-6 and other.block.p < 1e-6
    assert libmc.compare(brighter, b, tolerance=0.5)


def test_no_variance_gives_metrics_but_no_verdict():
    picture = libmc.Picture(np.ones((4, 5, 3)))
    c = libmc.compare(picture, picture)
    assert c.metrics["rmse"] == 0 and c.p is None and c.pixel is None
    with pytest.raises(libmc.Error, match="no verdict"):
        bool(c)


def test_intervals_cover_the_reference():
    picture = libmc.render("cbox", **SMALL)
    reference = libmc.render("cbox", size=(32, 24), spp=512, seed=9)
    inside = np.abs(picture.radiance - reference.radiance) <= picture.interval_half_width(0.95)
    assert inside.mean() > 0.88


def test_layers_crops_and_files(tmp_path):
    picture = libmc.render("cbox", size=(32, 24), spp=2, crop=(4, 5, 8, 6), layers=True)
    assert picture.radiance.shape == (6, 8, 3)
    normal = np.stack([picture.layers[f"N.{axis}"] for axis in "XYZ"])
    np.testing.assert_allclose(np.sum(normal**2, axis=0), 1, atol=1e-5)
    assert picture.metadata["carlo.seed"] == "0"
    for ending in ("exr", "pfm", "png"):
        picture.save(tmp_path / f"a.{ending}")
        assert libmc.read_image(tmp_path / f"a.{ending}").radiance.shape == (6, 8, 3)
    loaded = libmc.read_image(tmp_path / "a.exr")
    np.testing.assert_array_equal(loaded.layers["Z"], picture.layers["Z"])


def test_progress_and_interrupt():
    seen = []
    timer = threading.Timer(0.7, _thread.interrupt_main)
    timer.start()
    start = time.monotonic()
    picture = libmc.render("cbox", size=(64, 64), spp=100_000, progress=lambda *state: seen.append(state))
    timer.join()
    assert time.monotonic() - start < 20
    assert picture.partial and np.all(np.isfinite(picture.radiance))
    assert seen and all(len(s) == 4 and 0 <= s[0] <= 1 for s in seen)


def test_an_exception_of_progress_ends_the_render():
    def progress(*state):
        raise LookupError("stop")

    with pytest.raises(LookupError, match="stop"):
        libmc.render("cbox", size=(64, 64), spp=1000, progress=progress)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: libmc.render("cbx"), r"cbox"),
        (lambda: libmc.render("missing.xml"), r"missing\.xml"),
        (lambda: libmc.render("cbox", strategy="mist"), r"mis"),
        (lambda: libmc.render("cbox", spp=0), r"0"),
        (lambda: libmc.render("cbox", spp=4, seconds=1), r"spp and seconds exclude each other"),
        (lambda: libmc.render("cbox", size=(10**9, 10**9)), r"1000000000x1000000000 pixels need"),
        (lambda: libmc.Picture(np.ones((4, 5, 3)), np.ones((5, 4, 3))), r"\(4, 5, 3\) and variance of shape"),
        (lambda: libmc.render("cbox", size=(0, 4)), r"0"),
        (lambda: libmc.render("cbox", variables={"nothing": "1"}), r"nothing"),
        (lambda: libmc.Picture(np.ones((4, 5))), r"the shape must be \(height, width, 3\)"),
        (lambda: libmc.compare(libmc.Picture(np.ones((4, 5, 3))), libmc.Picture(np.ones((5, 4, 3)))), r"5x4"),
        (lambda: libmc.read_image("missing.exr"), r"missing\.exr"),
        (lambda: libmc.Picture(np.ones((4, 5, 3))).save("a.gif"), r"\.gif"),
    ],
)
def test_errors_name_the_value(call, message):
    with pytest.raises(libmc.Error, match=message):
        call()
