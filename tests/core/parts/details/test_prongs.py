"""Prongs are found by how far the surface is from the seams of a part."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from computed import graph_of
from weak_convex_decomposition.core.parts.details.prongs import find_tips
from weak_convex_decomposition.core.steps.progress import run


def tips_beyond(mesh, y):
    """Return the tips of what a shape has beyond some y, and the centers of faces."""
    graph = graph_of(mesh)
    parts = (graph.centers[:, 1] > y).astype(np.int64)
    tips = run(find_tips(graph, parts, np.array([False, True])))
    assert parts[tips].all()
    return tips, graph.centers


def comb(n_fingers, length):
    """Return a palm with fingers from y = 4 on, at the end of an arm."""
    width = 2 * n_fingers - 1
    fingers = [((2 * f, 2 * f + 1), (4, 4 + length), (0, 1)) for f in range(n_fingers)]
    return shapes.blocks((width, 4 + length, 1), ((0, width), (0, 4), (0, 1)), *fingers)


@pytest.mark.parametrize("n_fingers", [2, 3, 5])
def test_each_finger_has_one_tip_at_its_end(n_fingers):
    tips, centers = tips_beyond(comb(n_fingers, 4), 2)
    assert sorted((centers[tips, 0] // 2).tolist()) == list(range(n_fingers))
    assert (centers[tips, 1] > 7).all()


def test_one_finger_is_no_prong_and_neither_are_stumps():
    assert len(tips_beyond(comb(1, 6), 2)[0]) == 0
    assert len(tips_beyond(comb(3, 1), 2)[0]) == 0


def test_a_part_that_is_not_asked_for_or_has_no_seam_has_no_tips():
    graph = graph_of(comb(3, 4))
    parts = (graph.centers[:, 1] > 2).astype(np.int64)
    assert len(run(find_tips(graph, parts, np.array([True, False])))) == 0
    whole = np.zeros_like(parts)
    assert len(run(find_tips(graph, whole, np.array([True])))) == 0


def test_what_is_not_connected_to_a_seam_has_no_tips():
    loose = replace(comb(3, 4), vertices=comb(3, 4).vertices + np.array([0, 20, 0]))
    tips, centers = tips_beyond(shapes.joined(comb(3, 4), loose), 2)
    assert len(tips) == 3
    assert (centers[tips, 1] < 20).all()
