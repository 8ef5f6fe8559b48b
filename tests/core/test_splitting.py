"""One part decomposed again: its own samples, its own faces, nothing else."""

import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from weak_convex_decomposition.core.decomposition import describe, find_parts
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters import Parameters
from weak_convex_decomposition.core.progress import run
from weak_convex_decomposition.core.splitting import split_part
from weak_convex_decomposition.core.surface import surface_of
from weak_convex_decomposition.core.visibility import see

SETTINGS = {"samples": 60, "max_parts": 6}


def hand_on_a_wall():
    """Return a comb of three fingers at y > 5, at the end of a larger block."""
    fingers = [((x, x + 1), (5, 9), (0, 1)) for x in (0, 2, 4)]
    return shapes.blocks(
        (6, 9, 3), ((0, 6), (0, 3), (0, 3)), ((0, 5), (3, 5), (0, 1)), *fingers
    )


def split(mesh, members, **values):
    parameters = Parameters(**{**SETTINGS, **values})
    return run(split_part(mesh, members, parameters, BruteCaster))


@pytest.fixture(scope="module")
def hand():
    mesh = hand_on_a_wall()
    surface = surface_of(mesh)
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


def test_all_faces_as_a_part_are_the_whole_shape(seen):
    mesh = shapes.dumbbell()
    whole = split(mesh, np.ones(mesh.n_polygons, dtype=bool), samples=150)
    settings = Parameters(**{**SETTINGS, "samples": 150})
    direct = run(find_parts(seen(shapes.dumbbell), settings))
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
    x = surface_of(bar).centers[:, 0]
    visibility = run(
        see(bar, Parameters(**SETTINGS), BruteCaster, (x < 1.1) | (x > 7.9))
    )
    assert visibility.ranked.rank_of_all()[0] > 0.99


def test_a_part_without_area_is_refused_with_a_sentence():
    flat = shapes.sheet(6)
    x, y = surface_of(flat).centers[:, :2].T
    inner = (abs(x - 0.5) < 0.3) & (abs(y - 0.5) < 0.3)
    with pytest.raises(DecompositionError, match="no surface"):
        split(flat, inner)


def test_given_labels_are_described_as_they_were_found(seen):
    parameters = Parameters(**SETTINGS)
    visibility = seen(shapes.dumbbell)
    found = run(find_parts(visibility, parameters))
    again = describe(visibility, found.labels, parameters, found.psi_by_k, found.best_k)
    assert (again.labels == found.labels).all()
    assert again.psi == found.psi
    assert again.psi_before == found.psi_before
    assert again.ranks.tolist() == found.ranks.tolist()
    assert again.areas == pytest.approx(found.areas)
    turned = describe(visibility, found.n_parts - 1 - found.labels, parameters, {}, 1)
    assert turned.areas == pytest.approx(found.areas[::-1])
