from itertools import combinations

import numpy as np
from weak_convex_decomposition.operators.bridge.parts.palette import part_color

# Linear RGB as seen without the middle or the long-wave cones: Machado, Oliveira and
# Fernandes, "A Physiologically-based Model for Simulation of Color Vision
# Deficiency", 2009, severity 1.
DEUTERANOPIA = np.array(
    [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ]
)
PROTANOPIA = np.array(
    [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ]
)
TO_XYZ = np.array(
    [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ]
)
WHITE = TO_XYZ.sum(axis=1)


def lab(rgb):
    xyz = np.clip(rgb, 0, 1) @ TO_XYZ.T / WHITE
    f = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    x, y, z = f.T
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=1)


def smallest_difference(n_parts, view):
    colors = lab(np.array([part_color(i)[:3] for i in range(n_parts)]) @ view.T)
    return min(np.linalg.norm(a - b) for a, b in combinations(colors, 2))


def test_thirty_parts_have_distinct_colors():
    assert smallest_difference(30, np.eye(3)) > 7


def test_the_first_parts_are_told_apart_by_color_blind_people():
    for view in (DEUTERANOPIA, PROTANOPIA):
        assert smallest_difference(7, view) > 11


def test_colors_are_within_range_and_repeat_after_a_while():
    colors = [part_color(i) for i in range(32)]
    assert np.min(colors) >= 0
    assert np.max(colors) <= 1
    assert part_color(32) == part_color(0)
