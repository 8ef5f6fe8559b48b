"""Limbs come apart at necks if those of a shape have them, as an ant's legs."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from computed import graph_of, see
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.describe import describe
from weak_convex_decomposition.core.parts.details.joints import cut_joints
from weak_convex_decomposition.core.parts.details.knees import find_knees
from weak_convex_decomposition.core.parts.details.limb import limb_of
from weak_convex_decomposition.core.parts.details.necks import find_necks
from weak_convex_decomposition.core.parts.details.surface import PartSurface
from weak_convex_decomposition.core.steps.progress import run


def insect(n_necked):
    """Return a body with four straight legs, some of them with a neck at x = 12, 48."""
    boxes = [((24, 36), (0, 16), (10, 20))]
    for number, (side, y) in enumerate([(0, 1), (1, 1), (0, 11), (1, 11)]):
        for low, high in ((0, 11), (11, 13), (13, 24)):
            thin = number < n_necked and low == 11
            across = (y + thin, y + 4 - thin), (13 + thin, 17 - thin)
            ends = (60 - high, 60 - low) if side else (low, high)
            boxes.append((ends, *across))
    return shapes.blocks((60, 16, 20), *boxes)


def cut(mesh, **values):
    """Return the parts after joints are cut, from a body and four legs."""
    parameters = Parameters(samples=500, **values)
    memo = see(mesh, parameters)
    x, y, _ = graph_of(mesh).centers.T
    body = (x > 23.9) & (x < 36.1)
    labels = np.where(body, 0, 1 + (x > 30) + 2 * (y > 8)).astype(np.int64)
    five = describe(memo.visibility, labels, parameters, {}, 5)
    return five, run(cut_joints(memo, five, parameters))


@pytest.mark.parametrize("bends", ["CUT", "KEEP"])
def test_legs_come_apart_at_their_necks(bends):
    mesh = insect(4)
    _, after = cut(mesh, bends=bends)
    assert after.n_parts == 9
    x, y, _ = graph_of(mesh).centers.T
    for leg in (y < 8, y > 8):
        for outer, inner in ((x < 11, (x > 13) & (x < 24)), (x > 49, abs(x - 42) < 5)):
            (foot,) = set(after.labels[leg & outer])
            (thigh,) = set(after.labels[leg & inner])
            assert foot != thigh


@pytest.mark.parametrize("n_necked", [0, 1, 2])
def test_legs_without_necks_or_few_of_them_stay_whole(n_necked):
    before, after = cut(insect(n_necked))
    assert after is before


def limb(radii, turn=0.0):
    """Return a turned limb, bent to and fro, that hangs from its upper end."""
    heights = np.arange(len(radii)) * 0.25
    mesh = shapes.turned(radii, heights)
    x, y, along = mesh.vertices.T
    angles = turn * np.clip(np.sin(along), -0.5, 0.5)
    ways = turn * np.clip(np.sin(heights), -0.5, 0.5)
    path = np.cumsum(0.25 * np.stack([np.sin(ways), np.cos(ways)], axis=1), axis=0)
    aside, up = (np.interp(along, heights, column) for column in path.T)
    bent = [aside + x * np.cos(angles), y, up - x * np.sin(angles)]
    return hanging(replace(mesh, vertices=np.stack(bent, axis=1)))


def hanging(mesh):
    """Return a mesh that hangs from its upper end as a limb, None if it is none."""
    graph = graph_of(mesh)
    at_seams = np.zeros(graph.n_polygons, dtype=bool)
    at_seams[np.argsort(graph.centers[:, 2])[-32:]] = True
    return limb_of(PartSurface(graph, np.arange(graph.n_polygons), at_seams))


def test_necks_are_where_a_limb_is_thinnest():
    beads = 1 - 0.3 * np.cos(6 * np.pi * np.linspace(0, 1, 97))
    found = limb(beads)
    joints = find_necks(found)
    middles = [found.far[joints.pieces == piece].mean() for piece in (2, 1, 0)]
    assert len(joints.sizes) == 2
    assert np.diff(middles) == pytest.approx(8, abs=1)


@pytest.mark.parametrize(("end", "is_limb"), [(12.0, True), (1.0, False)])
def test_small_faces_at_the_ends_tell_nothing_between(end, is_limb):
    """The faces between them are as many and as wide, but long."""
    lower = np.linspace(0, end, 49)
    heights = np.concatenate([lower, 24.5 - lower[::-1]])
    found = hanging(shapes.turned(np.full(98, 1.0), heights))
    assert (found is not None) == is_limb


@pytest.mark.parametrize("end", [0.3, 1.0])
@pytest.mark.parametrize("turn", [0.0, 1.5])
def test_limbs_that_taper_or_bend_have_no_necks(end, turn):
    joints = find_necks(limb(np.linspace(end, 1.0, 97), turn))
    assert joints.sizes == []
    assert not joints.pieces.any()


@pytest.mark.parametrize(("turn", "least"), [(0.7, 0.55), (0.9, 0.7)])
def test_limbs_without_sharp_knees_may_have_slight_ones(turn, least):
    sizes = find_knees(limb(np.full(97, 0.5), turn)).sizes
    assert sizes
    assert least <= min(sizes)
    assert max(sizes) < least + 0.15
