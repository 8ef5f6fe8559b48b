"""Labels before and after edits by hand."""

import numpy as np
import pytest
import shapes
from computed import graph_of
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parts.editing import compacted, give, mirror
from weak_convex_decomposition.core.parts.seams.smoothing import smooth_seams
from weak_convex_decomposition.core.steps.progress import run


def normalized(mesh):
    return graph_of(run(mesh.normalized_in_steps()))


def seam(surface, labels):
    """Return the length of all seams."""
    one, other = labels[surface.neighbors].T
    return surface.lengths[one != other].sum()


def test_giving_touches_nothing_else():
    labels = np.array([0, 1, 2, 3, 2, 1])
    faces = np.array([True, False, False, True, False, False])
    assert give(labels, faces, 1).labels.tolist() == [1, 1, 2, 1, 2, 1]
    assert labels.tolist() == [0, 1, 2, 3, 2, 1]


def test_labels_are_compacted_in_order():
    labels, former = compacted(np.array([7, 2, 2, 9]))
    assert labels.tolist() == [1, 0, 0, 2]
    assert former.tolist() == [2, 7, 9]


@pytest.mark.parametrize("to_negative", [True, False])
def test_a_part_that_crosses_the_plane_goes_on_and_others_get_images(to_negative):
    surface = normalized(shapes.dumbbell())
    x, sign = surface.centers[:, 0], 1 if to_negative else -1
    # The bar is one part throughout; the target side's cube is cut in two.
    labels = np.where(sign * x > 0.17, 1, 0)
    labels[sign * x < -0.3] = 2
    change = run(mirror(labels, surface, 0.0, to_negative))
    (image,) = change.mirrored
    assert change.mirrored == {image: 1}
    assert change.side == ("L" if to_negative else "R")
    assert (change.labels[sign * x > 0.17] == 1).all()
    assert (change.labels[sign * x < -0.17] == image).all()
    assert (change.labels[abs(x) < 0.17] == 0).all()


def test_what_has_no_mirror_image_is_refused():
    surface = normalized(shapes.l_shape())
    labels = np.zeros(surface.n_polygons, dtype=np.int64)
    with pytest.raises(DecompositionError, match="not symmetric"):
        run(mirror(labels, surface, 0.3, True))
    with pytest.raises(DecompositionError, match="not symmetric"):
        run(mirror(labels, surface, 5.0, True))


@pytest.fixture(scope="module")
def ragged():
    """Return a sphere in bands along x, with a ragged seam at 0 and one at 0.3."""
    surface = normalized(shapes.sphere(4))
    x = surface.centers[:, 0]
    noise = np.random.default_rng(0).normal(0, 0.02, len(x))
    return surface, (x + noise > 0).astype(np.int64) + (x + noise > 0.2)


def test_smoother_seams_are_shorter_and_stay_where_they_are(ragged):
    surface, labels = ragged
    lengths, moved = [seam(surface, labels)], []
    for smoothness in (0.0, 0.5, 2.0, 8.0):
        smoothed = run(smooth_seams(surface, labels, [0, 1, 2], smoothness))
        lengths.append(seam(surface, smoothed))
        moved.append(surface.areas[smoothed != labels].sum() / surface.areas.sum())
        assert set(smoothed) == {0, 1, 2}
    assert lengths[1] == lengths[0]
    assert moved[0] == 0
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[3] < 0.5 * lengths[0]
    assert moved[2] < 0.08


def test_only_seams_of_chosen_parts_move(ragged):
    surface, labels = ragged
    smoothed = run(smooth_seams(surface, labels, [0], 2.0))
    assert ((smoothed == 2) == (labels == 2)).all()
    assert (smoothed != labels).any()


def test_no_part_vanishes_however_smooth(ragged):
    surface, _ = ragged
    labels = np.zeros(surface.n_polygons, dtype=np.int64)
    labels[7] = 1
    labels[surface.neighbors[surface.neighbors[:, 0] == 900][0]] = 2
    smoothed = run(smooth_seams(surface, labels, [0, 1, 2], 100.0))
    assert set(smoothed) == {0, 1, 2}
