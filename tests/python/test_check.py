"""Checks of samplers written in NumPy."""

import json

import numpy as np
import pytest

import libmc


def cosine(u):
    r, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    return np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[:, 0])], axis=1)


def cosine_pdf(w):
    return np.maximum(w[:, 2], 0) / np.pi


def cosine_invert(w):
    return np.stack([w[:, 0] ** 2 + w[:, 1] ** 2, np.arctan2(w[:, 1], w[:, 0]) / (2 * np.pi) % 1], axis=1)


def normal_pdf(x):
    return np.exp(-x * x / 2) / np.sqrt(2 * np.pi)


QUICK = {"samples": 100_000}


def test_a_right_sampler_passes():
    report = libmc.assert_distribution(cosine, cosine_pdf, "hemisphere", cosine_invert, **QUICK)
    assert report.passed and report.verdict == "pass" and bool(report)
    assert report.subject == "cosine" and 0 < report.p <= 1
    assert report.mass == pytest.approx(1)
    assert {c.verdict for c in report.checks} == {"pass"}


@pytest.mark.parametrize(
    "sample, pdf, invert, fault",
    [
        (cosine, lambda w: np.full(len(w), 1 / (2 * np.pi)), None, "shape"),
        (cosine, lambda w: w[:, 2], None, "mass"),
        (lambda u: 1.01 * cosine(u), cosine_pdf, None, "outside"),
        (cosine, cosine_pdf, lambda w: cosine_invert(w) / 2, "inverse"),
        (lambda u: np.where(u[:, :1] < 0.1, np.nan, cosine(u)), cosine_pdf, None, "not_finite"),
    ],
)
def test_a_wrong_sampler_fails(sample, pdf, invert, fault):
    with pytest.raises(AssertionError) as e:
        libmc.assert_distribution(sample, pdf, "hemisphere", invert, **QUICK)
    report = libmc.check(sample, pdf, "hemisphere", invert, **QUICK)
    assert not report and report.verdict == "fail"
    assert report.finding in str(e.value)
    assert fault.replace("_", " ") in report.fault.replace("_", " ").replace("not finite", "not finite"), report.fault


def test_maps_are_arrays():
    report = libmc.check(cosine, cosine_pdf, "hemisphere", **QUICK)
    cells = report.cells
    m = len(cells["observed"])
    assert m > 100 and cells["lo"].shape == cells["x_hi"].shape == (m, 2)
    assert cells["observed"].sum() == pytest.approx(report.samples, rel=0.02)
    assert cells["expected"].sum() == pytest.approx(report.samples, rel=0.02)
    assert report.axes == [("theta", "deg"), ("phi", "deg")]
    assert cells["x_hi"][:, 0].max() == pytest.approx(90)
    samples, p = report.p_after
    assert samples[0] == 1024 and len(p) == len(samples) and np.all((p >= 0) & (p <= 1))


def test_reports_as_text_json_and_page(tmp_path):
    report = libmc.check(cosine, lambda w: w[:, 2], "hemisphere", **QUICK)
    assert repr(report).startswith("cosine: fail")
    assert json.loads(report.to_json())["subject"] == "cosine"
    report.save_page(str(tmp_path / "page.html"))
    page = (tmp_path / "page.html").read_text()
    assert "cosine" in page and page.lower().startswith("<!doctype html>")


def test_scalars_have_flat_arrays():
    report = libmc.check(lambda u: u**2, lambda x: 0.5 / np.sqrt(x), "x=0:1", lambda x: np.sqrt(x), **QUICK, open_interval=True)
    assert report, report.text()


def test_arrays_of_samples():
    x = np.random.default_rng(1).standard_normal(50_000)
    assert libmc.check(x, normal_pdf, "x=-inf:inf")
    wrong = libmc.check(1.05 * x, normal_pdf, "x=-inf:inf")
    assert not wrong and wrong.fault.startswith("shape")
    assert not libmc.check(np.sort(x), normal_pdf, "x=-inf:inf")
    assert libmc.check(np.sort(x), normal_pdf, "x=-inf:inf", dependent=True)
    x[17] = np.nan
    assert libmc.check(x, normal_pdf, "x=-inf:inf").fault.startswith("not finite")


def test_failed_draws():
    def sample(u):
        return np.where(u[:, :1] < 0.25, np.nan, cosine(np.stack([(u[:, 0] - 0.25) / 0.75 % 1, u[:, 1]], axis=1)))

    assert not libmc.check(sample, cosine_pdf, "hemisphere", **QUICK)
    report = libmc.check(sample, lambda w: 0.75 * cosine_pdf(w), "hemisphere", may_fail=True, **QUICK)
    assert report, report.text()


def test_failed_rows():
    random = np.random.default_rng(3)
    x = np.where(random.random(20_000) < 0.3, np.nan, random.random(20_000))
    assert libmc.check(x, lambda x: np.full(len(x), 0.7), "x=0:1", may_fail=True)
    assert not libmc.check(x, lambda x: np.full(len(x), 0.8), "x=0:1", may_fail=True)


def test_a_sample_that_ignores_u_is_no_rounding():
    report = libmc.check(lambda u: 0 * u + 0.5, np.ones_like, "x=0:1", lambda x: x, **QUICK)
    assert [c.name for c in report.checks if "det" in c.name and c.verdict == "fail"], report.text()


# The steps of the law on the derivative are a few spacings of doubles here.
@pytest.mark.parametrize(
    "warp",
    [
        libmc.warps.UniformInterval(9, 9 + 1e-7),
        libmc.warps.Normal(-84839.6, 8.6e-8),
        libmc.warps.HenyeyGreenstein(-0.9999999),
    ],
    ids=repr,
)
def test_narrow_warps(warp):
    report = libmc.check(warp, invert_eps=1e300, samples=4000)
    assert not [c.name for c in report.checks if "det" in c.name and c.verdict == "fail"], report.text()


def test_more_uniforms_than_dimensions():
    def sum_of_two(u):
        return u[:, 0] + u[:, 1]

    assert libmc.check(sum_of_two, lambda x: 1 - np.abs(x - 1), "x=0:2", uniforms=2, **QUICK)


def test_the_same_seed_gives_the_same_report():
    first, second = (libmc.check(cosine, cosine_pdf, "hemisphere", seed=3, **QUICK) for _ in range(2))
    assert first.p == second.p


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: libmc.check(cosine, None, "hemisphere"), r"pdf is None; a function"),
        (lambda: libmc.check(cosine, cosine_pdf, None), r"domain: None is neither"),
        (lambda: libmc.check(cosine, cosine_pdf, "hemisphere", samples=10), r"10"),
        (lambda: libmc.check(lambda u: u, cosine_pdf, "hemisphere"), r"check: sample returned"),
        (lambda: libmc.check(np.zeros((10, 3)), cosine_pdf, "hemisphere"), r"10 samples; 2000 or more"),
        (lambda: libmc.check(cosine, cosine_pdf, "hemisphere", uniforms=9), r"uniforms 9; at most 6"),
        (lambda: libmc.check(cosine, cosine_pdf, "hemisphere", uniforms=-1), r"uniforms -1; a positive number"),
        (lambda: libmc.check(cosine, lambda w: 1, "hemisphere", samples=0), r"0 samples; 1000 or more are needed"),
        (lambda: libmc.check(libmc.warps.CosineHemisphere(), domain="x=0:1"), r"a warp has a pdf, domain and inverse"),
        (lambda: libmc.check(np.zeros(2000), np.ones_like, "x=0:1", np.zeros_like), r"the samples are an array"),
        (lambda: libmc.check(lambda u: u, cosine_pdf, "hemisphere", uniforms=2), r"3 numbers for each of the"),
    ],
)
def test_errors_name_the_value(call, message):
    with pytest.raises(libmc.Error, match=message):
        call()


def test_an_exception_ends_the_check():
    def pdf(w):
        raise LookupError("no table")

    with pytest.raises(LookupError, match="no table"):
        libmc.check(cosine, pdf, "hemisphere")
