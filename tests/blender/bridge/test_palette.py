from itertools import combinations

import numpy as np
import pytest
from weak_convex_decomposition.operators.bridge.parts.palette import (
    free_color,
    partner_color,
    usual_color,
)

N_COLORS = 24


def palette(n_parts=N_COLORS):
    colors = []
    for _ in range(n_parts):
        colors.append(free_color(colors))
    return colors


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
    colors = lab(np.array(palette(n_parts)) @ view.T)
    return min(np.linalg.norm(a - b) for a, b in combinations(colors, 2))


def test_the_colors_of_24_parts_are_told_apart():
    assert smallest_difference(N_COLORS, np.eye(3)) > 25


def test_partners_are_told_apart_from_each_other_and_from_all_parts():
    colors = lab(np.array([*palette(), *map(partner_color, palette())]))
    assert min(np.linalg.norm(a - b) for a, b in combinations(colors, 2)) > 13


def test_no_color_is_gray_or_near_black():
    lightness, *opponents = lab(
        np.array([*palette(), *map(partner_color, palette())])
    ).T
    assert lightness.min() > 25
    assert np.hypot(*opponents).min() > 20


def test_partners_have_one_hue_and_are_each_others():
    for color in palette():
        partner = partner_color(color)
        _, a, b = lab(np.array([color, partner])).T
        hues = np.degrees(np.arctan2(b, a))
        assert abs((hues[0] - hues[1] + 180) % 360 - 180) < 15
        assert partner_color(partner) == pytest.approx(color)


def test_an_artists_own_color_has_a_partner_of_its_hue():
    for color in ((0.3, 0.1, 0.02), (0.9, 0.8, 0.1)):
        assert (
            np.linalg.norm(np.subtract(*lab(np.array([color, partner_color(color)]))))
            > 8
        )


def test_free_colors_are_not_in_use_until_all_are():
    used = []
    for _ in range(N_COLORS):
        used.append(free_color(used))
    assert len(set(used)) == N_COLORS
    assert free_color([*used, used[0]]) == used[1]
    assert free_color([partner_color(used[0])]) == used[1]


def test_usual_colors_are_those_of_one_new_part_after_the_other():
    n_parts = 2 * N_COLORS + 1
    assert [usual_color(number) for number in range(n_parts)] == palette(n_parts)


def test_the_first_parts_are_told_apart_by_color_blind_people():
    for view in (DEUTERANOPIA, PROTANOPIA):
        assert smallest_difference(7, view) > 11


def test_colors_are_within_range_and_repeat_after_a_while():
    *colors, repeated = palette(N_COLORS + 1)
    assert np.min(colors) >= 0
    assert np.max(colors) <= 1
    assert repeated == colors[0]
