"""Parts decomposed again: their own samples, their own faces, nothing else."""

import numpy as np
import pytest
import shapes
from computed import decompose, graph_of, parts_of, prepare
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.describe import describe
from weak_convex_decomposition.core.sight.visibility import find_lines_of_sight
from weak_convex_decomposition.core.steps.progress import run

SETTINGS = {"samples": 60, "max_parts": 6}


def hand_on_a_wall():
    """Return a comb of three fingers at y > 5, at the end of a larger block."""
    fingers = [((x, x + 1), (5, 9), (0, 1)) for x in (0, 2, 4)]
    return shapes.blocks(
        (6, 9, 3), ((0, 6), (0, 3), (0, 3)), ((0, 5), (3, 5), (0, 1)), *fingers
    )


def split(mesh, members, **values):
    parameters = Parameters(**{**SETTINGS, **values})
    return decompose(mesh, parameters, members)


@pytest.fixture(scope="module")
def hand():
    mesh = hand_on_a_wall()
    surface = graph_of(mesh)
    return mesh, surface, surface.centers[:, 1] > 3


def test_fingers_come_apart_when_the_hand_is_split(hand):
    mesh, surface, members = hand
    parts = split(mesh, members, parts=4, samples=100)
    assert parts.labels.shape == (members.sum(),)
    assert parts.n_parts == 4
    tips = surface.centers[members][:, 1] > 6
    columns = surface.centers[members][tips][:, 0] // 2
    tip_parts = {c: set(parts.labels[tips][columns == c]) for c in range(3)}
    assert [len(found) for found in tip_parts.values()] == [1, 1, 1]
    assert len(set.union(*tip_parts.values())) == 3
    assert parts.areas.sum() == pytest.approx(surface.areas[members].sum())
    assert parts.face_counts.tolist() == np.bincount(parts.labels).tolist()


def hand_on_a_cliff():
    """Return the same hand on a block that most samples are on, and its finger tips."""
    fingers = [((x, x + 1), (7, 11), (0, 1)) for x in (0, 2, 4)]
    mesh = shapes.blocks(
        (10, 11, 5), ((0, 10), (0, 5), (0, 5)), ((0, 5), (5, 7), (0, 1)), *fingers
    )
    return mesh, graph_of(mesh).centers[:, 1] > 8


def parts_by_levels(mesh, **values):
    parameters = Parameters(samples=80, max_parts=6, containers="HOLLOW", **values)
    return decompose(mesh, parameters)


def parts_of_tips(mesh, tips, found):
    columns = graph_of(mesh).centers[tips][:, 0] // 2
    return [set(found.labels[tips][columns == c].tolist()) for c in range(3)]


def test_fingers_of_a_large_body_come_apart_by_default():
    mesh, tips = hand_on_a_cliff()
    one, auto = (parts_by_levels(mesh, **values) for values in ({"levels": 1}, {}))
    assert len(set.union(*parts_of_tips(mesh, tips, one))) < 3
    fingers = parts_of_tips(mesh, tips, auto)
    assert [len(parts) for parts in fingers] == [1, 1, 1]
    assert len(set.union(*fingers)) == 3
    # Other parts are as they were.
    hand = set(one.labels[tips].tolist())
    others = ~np.isin(one.labels, list(hand))
    assert all(len(set(one.labels[auto.labels == p])) == 1 for p in range(auto.n_parts))
    assert len(set(auto.labels[others])) == len(set(one.labels[others]))
    assert (auto.psi_by_k, auto.best_k) == (one.psi_by_k, one.best_k)
    assert auto.psi > one.psi


def test_details_are_not_looked_for_if_the_number_of_parts_is_given():
    mesh, _ = hand_on_a_cliff()
    assert parts_by_levels(mesh, parts=3).n_parts == 3


def test_a_bent_arm_without_fingers_hides_no_detail():
    # It sees itself badly, but another look would only divide it at its bends.
    upper, lower = ((0, 1), (5, 9), (0, 1)), ((0, 6), (9, 10), (0, 1))
    mesh = shapes.blocks((10, 10, 5), ((0, 10), (0, 5), (0, 5)), upper, lower)
    one, auto = (parts_by_levels(mesh, **values) for values in ({"levels": 1}, {}))
    assert one.ranks.min() < 0.8
    assert auto.labels.tolist() == one.labels.tolist()


def test_fingers_of_a_large_body_come_apart_at_the_second_level():
    mesh, tips = hand_on_a_cliff()
    one, two = (parts_by_levels(mesh, levels=n) for n in (1, 2))
    assert len(set.union(*parts_of_tips(mesh, tips, one))) < 3
    fingers = parts_of_tips(mesh, tips, two)
    assert [len(parts) for parts in fingers] == [1, 1, 1]
    assert len(set.union(*fingers)) == 3
    # Other parts are as they were, and none reaches over what was a boundary.
    assert all(len(set(one.labels[two.labels == p])) == 1 for p in range(two.n_parts))
    assert (np.diff(two.areas) <= 0).all()
    assert two.areas.sum() == pytest.approx(one.areas.sum())
    assert len(two.ranks) == two.n_parts
    assert two.psi > one.psi
    assert (two.psi_by_k, two.best_k) == (one.psi_by_k, one.best_k)


def test_levels_leave_convex_parts_whole():
    mesh = shapes.l_shape()
    one, three = (parts_by_levels(mesh, levels=n) for n in (1, 3))
    assert three.labels.tolist() == one.labels.tolist()
    assert three.ranks.tolist() == one.ranks.tolist()


def test_all_faces_as_a_part_are_the_whole_shape(seen):
    mesh = shapes.dumbbell()
    whole = split(mesh, np.ones(mesh.n_polygons, dtype=bool), samples=150)
    settings = Parameters(**{**SETTINGS, "samples": 150})
    direct = parts_of(seen(shapes.dumbbell), settings)
    assert (whole.labels == direct.labels).all()
    assert whole.psi == direct.psi


def test_a_convex_part_stays_whole_by_psi_and_splits_on_demand(hand):
    mesh, surface, members = hand
    finger = members & (surface.centers[:, 1] > 5) & (surface.centers[:, 0] < 1.01)
    assert split(mesh, finger, max_parts=3).n_parts == 1
    assert split(mesh, finger, parts=2, max_parts=2).n_parts == 2


def test_lines_of_sight_of_a_part_run_through_the_whole_shape():
    # The ends of a bar see each other through its middle, which is not of the part.
    bar = shapes.blocks((9, 2, 2), ((0, 9), (0, 2), (0, 2)))
    x = graph_of(bar).centers[:, 0]
    ends = prepare(bar).part((x < 1.1) | (x > 7.9))
    sight = run(find_lines_of_sight(ends, Parameters(**SETTINGS)))
    assert sight.rank_pairs.rank_of_all()[0] > 0.99


def test_a_part_without_area_is_refused_with_a_sentence():
    flat = shapes.sheet(6)
    x, y = graph_of(flat).centers[:, :2].T
    inner = (abs(x - 0.5) < 0.3) & (abs(y - 0.5) < 0.3)
    with pytest.raises(DecompositionError, match="no area outside that samples"):
        split(flat, inner)


def test_given_labels_are_described_as_they_were_found(seen):
    parameters = Parameters(**SETTINGS)
    memo = seen(shapes.dumbbell)
    visibility, found = memo.visibility, parts_of(memo, parameters)
    again = describe(visibility, found.labels, parameters, found.psi_by_k, found.best_k)
    assert (again.labels == found.labels).all()
    assert again.psi == found.psi
    assert again.psi_before == found.psi_before
    assert again.ranks.tolist() == found.ranks.tolist()
    assert again.areas == pytest.approx(found.areas)
    turned = describe(visibility, found.n_parts - 1 - found.labels, parameters, {}, 1)
    assert turned.areas == pytest.approx(found.areas[::-1])
