#!/usr/bin/env python3
"""Shares of renders whose error, or standard error, exceeds the target.

Usage: target_error.py RENDERS TARGET SIZE SCENE...   (SIZE: pixels on a side. PYTHONPATH: libmc.)"""

import sys

import numpy as np

import libmc

renders, target, size = int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])


def errors(picture, reference):
    """Relative to the mean of 3x3 pixels, at least half of the mean of the picture, as carlo defines its error."""
    padded = np.pad(reference, ((1, 1), (1, 1), (0, 0)), mode="edge")
    around = sum(padded[y : y + size, x : x + size] for y in range(3) for x in range(3)) / 9
    return np.sqrt(np.mean(((picture - reference) / np.maximum(around, reference.mean() / 2)) ** 2))


print("scene, renders, larger error, largest, larger standard error, samples per pixel, error of the reference")
for scene in sys.argv[4:]:
    halves = [libmc.render(scene, size=(size, size), spp=1 << 15, seed=seed).radiance for seed in (1, 2)]
    reference = (halves[0] + halves[1]) / 2
    noise = errors(halves[0], reference)  # half of the difference: the error of their mean
    pictures = [libmc.render(scene, size=(size, size), target_error=target, seed=100 + i, threads=1) for i in range(renders)]
    of = np.array([errors(p.radiance, reference) for p in pictures])
    samples = np.array([p.spp for p in pictures])
    standard = np.sqrt(np.mean(of**2 * samples) / samples)  # of pictures with as many samples
    print(
        f"{scene}, {len(of)}, {np.mean(of > target):.3f}, {of.max():.3f}, {np.mean(standard > target):.3f}, "
        f"{np.median(samples):.0f}, {noise:.4f}",
        flush=True,
    )
