"""Spikes come off bodies, and limbs come apart at knees, by default."""

import numpy as np
import pytest
import shapes
from computed import decompose, graph_of, see
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.describe import describe
from weak_convex_decomposition.core.parts.details import limb_joints
from weak_convex_decomposition.core.parts.details.joints import cut_joints
from weak_convex_decomposition.core.parts.details.knees import find_knees
from weak_convex_decomposition.core.parts.details.limb import Joints
from weak_convex_decomposition.core.steps.progress import run


def parts(mesh, **values):
    return decompose(mesh, Parameters(samples=300, **values))


def head(n_antennae, length=14, width=1):
    """Return a head, a thin neck and a body, and which faces are thin bars on top."""
    places = (1, 7)[:n_antennae]
    bars = [((x, x + width), (4, 4 + width), (9, 9 + length)) for x in places]
    mesh = shapes.blocks(
        (21, 9, 9 + length),
        ((0, 9), (0, 9), (0, 9)),
        ((9, 11), (3, 6), (3, 6)),
        ((11, 21), (0, 9), (0, 9)),
        *bars,
    )
    x, _, z = graph_of(mesh).centers.T
    return mesh, [(z > 9) & (abs(x - at) < 1) for at in np.add(places, 0.5)]


def joints_of(mesh):
    """Return the parts after joints are cut in a head at x < 10 and its body."""
    parameters = Parameters(samples=400)
    memo = see(mesh, parameters)
    halves = (graph_of(mesh).centers[:, 0] > 10).astype(np.int64)
    two = describe(memo.visibility, halves, parameters, {}, 2)
    return two, run(cut_joints(memo, two, parameters))


@pytest.mark.parametrize("n_antennae", [1, 2])
def test_antennae_come_off_a_head(n_antennae):
    mesh, antennae = head(n_antennae)
    before, after = joints_of(mesh)
    assert after.n_parts == 2 + n_antennae
    for antenna in antennae:
        (part,) = set(after.labels[antenna])
        assert (after.labels == part).sum() == antenna.sum()
    assert after.psi > before.psi
    assert (np.diff(after.areas) <= 0).all()
    assert len(after.ranks) == after.n_parts


def test_a_broad_nose_stays_on_its_head():
    before, after = joints_of(head(1, length=4, width=4)[0])
    assert after is before


def spider(bent):
    """Return a body with four legs that go aside, and then down if they are bent."""
    boxes = [((14, 26), (0, 16), (10, 20))]
    for y in (2, 10):
        boxes += [((0, 14), (y, y + 2), (14, 16)), ((26, 40), (y, y + 2), (14, 16))]
        if bent:
            boxes += [((0, 2), (y, y + 2), (0, 16)), ((38, 40), (y, y + 2), (0, 16))]
    return shapes.blocks((40, 16, 20), *boxes)


def test_legs_come_apart_at_their_knees():
    mesh = spider(bent=True)
    before, after = parts(mesh, levels=1), parts(mesh)
    assert (before.n_parts, after.n_parts) == (5, 9)
    x, y, z = graph_of(mesh).centers.T
    for side in (x < 20, x > 20):
        for leg in (side & (y < 5), side & (y > 9)):
            far = abs(x - 20)
            shank, thigh = leg & (far > 17) & (z < 13), leg & (far > 7) & (far < 17)
            assert len(set(after.labels[shank])) == len(set(after.labels[thigh])) == 1
            assert after.labels[shank][0] != after.labels[thigh][0]


def test_what_is_cut_on_one_side_is_cut_on_the_other(monkeypatch):
    def on_one_side(limb):
        knees = find_knees(limb)
        left = limb.part.graph.centers[:, 0].mean() < 0
        return Joints(np.zeros_like(knees.pieces), []) if left else knees

    monkeypatch.setattr(limb_joints, "find_knees", on_one_side)
    assert parts(spider(bent=True)).n_parts == 9


@pytest.mark.parametrize(("far", "expected"), [(0.3, 9), (-0.3, 7), (-1.0, 5)])
def test_slight_knees_count_if_most_limbs_have_others(far, expected, monkeypatch):
    """Of one leg, of all but one, whose mirror image is cut as it is, or of all."""

    def slighter(limb):
        knees = find_knees(limb)
        x, y, _ = limb.part.graph.centers.mean(axis=0)
        return knees._replace(sizes=[0.6]) if x + y > far else knees

    monkeypatch.setattr(limb_joints, "find_knees", slighter)
    assert parts(spider(bent=True)).n_parts == expected


def test_straight_legs_stay_whole():
    mesh = spider(bent=False)
    before, after = parts(mesh, levels=1), parts(mesh)
    assert after.n_parts == 5
    assert after.labels.tolist() == before.labels.tolist()
