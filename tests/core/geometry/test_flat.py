"""Flat meshes: their outline, and their decomposition from end to end."""

from dataclasses import replace

import changes
import flats
import numpy as np
import pytest
import shapes
from computed import decompose, graph_of, lines_of_sight, measure, normalized
from definitions import agreement
from weak_convex_decomposition.core.geometry.cutting.triangulation import triangulate
from weak_convex_decomposition.core.geometry.flat import flat_mesh
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run

L = flats.filled(flats.L, spacing=0.25)
COMB = flats.filled(flats.comb(4), spacing=0.5)
HAND = flats.filled(flats.HAND, spacing=0.12)
RING = flats.filled(flats.circle(2.0), flats.circle(1.2), spacing=0.2)
UPRIGHT = changes.any_rotation(2)


def split_up(mesh, **values):
    values = {"samples": 200, "max_parts": 8, **values}
    return decompose(mesh, Parameters(**values))


def length(outline):
    return np.linalg.norm(outline - np.roll(outline, 1, axis=0), axis=1).sum()


def wall_length(mesh):
    """Return the length of the outline found, in the units of the mesh."""
    walls = flat_mesh(normalized(mesh)).walls
    feet = walls.vertices[walls.triangles[::2, :2]]
    return np.linalg.norm(feet[:, 1] - feet[:, 0], axis=1).sum() * mesh.diagonal


def test_walls_stand_along_outlines_and_holes():
    assert wall_length(COMB) == pytest.approx(length(flats.comb(4)))
    holed = length(flats.circle(2.0)) + length(flats.circle(1.2))
    assert wall_length(RING) == pytest.approx(holed)


@pytest.mark.parametrize("rotation", [np.eye(3), np.diag([1, -1, -1]), UPRIGHT])
def test_walls_face_away_from_the_faces_in_the_plane(rotation):
    mesh = normalized(changes.moved(RING, 7.0, rotation, (20, 3, 5)))
    flat = flat_mesh(mesh)
    assert abs(flat.normal @ rotation[:, 2]) == pytest.approx(1)
    centers = flat.walls.vertices[flat.walls.triangles].mean(axis=1)
    middles = np.linalg.norm(centers, axis=1)  # the ring is centered
    outwards = (centers * flat.walls.normals).sum(axis=1)
    assert (np.sign(outwards) == np.where(middles > middles.mean(), 1, -1)).all()
    assert abs(flat.walls.normals @ flat.normal).max() < 1e-9


def test_each_wall_belongs_to_the_face_at_its_foot():
    walls = flat_mesh(normalized(HAND)).walls
    centers = walls.vertices[walls.triangles].mean(axis=1)
    faces = normalized(HAND).vertices[HAND.triangles[walls.polygons]]
    away = np.linalg.norm(faces - centers[:, None], axis=2)
    assert np.sort(away, axis=1)[:, :2].sum(axis=1).max() < 0.12  # both ends of it


def test_the_winding_of_faces_does_not_matter():
    mixed = np.where(np.arange(len(HAND.triangles))[:, None] % 3 == 0, 1, -1)
    triangles = np.where(mixed > 0, HAND.triangles, HAND.triangles[:, ::-1])
    mixed = replace(HAND, triangles=triangles)
    assert wall_length(mixed) == pytest.approx(wall_length(HAND))
    found = split_up(mixed)
    assert found.notes == ()
    assert (found.labels == split_up(HAND).labels).all()


def test_two_layers_have_the_outline_of_one():
    both = shapes.joined(RING, changes.inside_out(RING))
    assert wall_length(both) == pytest.approx(wall_length(RING))
    found = split_up(both, parts=3)
    front, back = np.split(found.labels, 2)
    assert found.n_parts == 3
    assert (front == back).mean() > 0.95


def test_collinear_corners_leave_no_wall_inside():
    """A square below a vertex on its upper edge, which two others above it share."""
    vertices = [(0, 0), (2, 0), (2, 1), (1, 1), (0, 1), (0, 2), (1, 2), (2, 2)]
    square = [(0, 1, 2), (0, 2, 4), (4, 2, 3)]  # the last one without area
    above = [(4, 3, 6), (4, 6, 5), (3, 2, 7), (3, 7, 6)]
    for polygons in ([0, 0, 0, 1, 1, 2, 2], range(7)):
        flat = shapes.TriangleMesh(
            np.pad(vertices, ((0, 0), (0, 1))), square + above, list(polygons)
        )
        assert wall_length(flat) == pytest.approx(8)


def test_what_is_not_in_one_plane_is_not_flat():
    for bend in (0.001, 0.01, 0.1):
        vertices = HAND.vertices.copy()
        vertices[:, 2] = bend * vertices[:, 0] ** 2
        assert flat_mesh(normalized(replace(HAND, vertices=vertices))) is None
    assert flat_mesh(normalized(shapes.box((0, 0, 0), (1, 1, 0.001)))) is None
    assert flat_mesh(normalized(shapes.l_shape())) is None


def test_single_precision_far_from_the_origin_is_flat():
    far = changes.moved(HAND, rotation=UPRIGHT, offset=(300, 200, 100))
    rounded = far.vertices.astype(np.float32)
    assert flat_mesh(normalized(replace(far, vertices=rounded))) is not None


def test_a_plate_without_thickness_is_flat():
    plate = shapes.box((0, 0, 0), (1, 1, 1e-5), divisions=4)
    found = split_up(plate)
    assert flat_mesh(normalized(plate)) is not None
    assert found.psi_before == 1
    assert found.areas.sum() == pytest.approx(2, rel=1e-3)


@pytest.mark.parametrize("values", [{}, {"sight": "CONE", "samples": 400}])
def test_a_hand_has_a_palm_and_five_fingers(values):
    """Figure 3 of the paper, and the areas are those of the faces."""
    found = split_up(HAND, **values)
    centers = HAND.vertices[HAND.triangles].mean(axis=1)[:, :2]
    assert found.n_parts == 6
    assert found.areas.sum() == pytest.approx(HAND.areas.sum())
    for finger in flats.FINGERS:
        within = flats.inside(centers, [np.array(finger)])
        counts = np.bincount(found.labels[within], minlength=6)
        assert counts.argmax() > 0  # the palm is the largest part
        assert counts.max() > 0.9 * within.sum()
        assert counts.max() > 0.9 * (found.labels == counts.argmax()).sum()
    assert found.ranks.min() > 0.9


def test_cones_lie_flat_in_any_plane():
    turned = changes.moved(HAND, rotation=UPRIGHT)
    for mesh in (HAND, turned):
        parameters = Parameters(samples=200, rays=10, sight="CONE", psi_pairs="RAYS")
        seen = lines_of_sight(mesh, parameters).affinity_pairs.visible
        # Each sample, most of its ten rays, and theirs in turn.
        assert seen.nnz > 200 * (1 + 12)


@pytest.mark.parametrize("n_teeth", [4, 5, 6])
def test_a_comb_has_a_bar_and_its_teeth_with_straight_seams(n_teeth):
    mesh = flats.filled(flats.comb(n_teeth), spacing=0.5)
    found = split_up(mesh, samples=600)
    x, y, _ = mesh.vertices[mesh.triangles].mean(axis=1).T
    expected = np.where(y > 1, 1 + x // 2, 0).astype(int)
    assert found.n_parts == n_teeth + 1
    parts = np.unique(np.stack([expected, found.labels]), axis=1)
    assert parts.shape[1] == n_teeth + 1


def test_an_l_has_two_arms_with_a_straight_seam():
    found = split_up(L)
    assert sorted(found.areas) == pytest.approx([3, 4], abs=0.01)
    assert found.ranks == pytest.approx([1, 1])


def test_nothing_is_seen_across_a_hole():
    rank = measure(RING, Parameters(samples=300)).rank
    full = flats.filled(flats.circle(2.0), spacing=0.3)
    assert measure(full, Parameters(samples=300)).rank > 0.99
    assert rank < 0.4
    found = split_up(RING, parts=4)
    assert found.n_parts == 4
    assert found.areas.max() < 2 * found.areas.min()


@pytest.mark.parametrize(("mesh", "parts", "samples"), [(COMB, 5, 600), (HAND, 6, 300)])
def test_the_same_parts_in_any_plane(mesh, parts, samples):
    turned = changes.moved(mesh, 30.0, UPRIGHT, (9, 2, 5))
    found, other = (split_up(m, samples=samples) for m in (mesh, turned))
    assert found.n_parts == other.n_parts == parts
    assert agreement(found.labels, other.labels, mesh.areas) > 0.97
    assert found.psi == pytest.approx(other.psi, abs=0.02)


def test_a_single_face_says_what_it_needs():
    face = replace(HAND, polygons=np.zeros_like(HAND.polygons))
    found = split_up(face)
    assert found.n_parts == 1
    assert len(found.notes) == 1
    assert "Triangulate" in found.notes[0]
    assert found.psi_before < 0.5


def test_samples_on_faces_work():
    found = split_up(
        COMB, sampling="FACES", sight="CONE", rays=8, psi_pairs="RAYS", parts=5
    )
    y = graph_of(COMB).centers[:, 1]
    assert found.n_parts == 5
    assert len(set(found.labels[y < 0.7])) == 1


# Triangles of no area, whose corners coincide at a concave corner.
@pytest.mark.parametrize("more", [[], [(3, 3, 4)], [(6, 3, 3)], [(3, 3, 3)]])
def test_edges_between_concave_corners_are_creases(more):
    """The edge below the square on a bar has two such corners, those in a ring none."""
    corners = [(0, 0), (3, 0), (3, 1), (2, 1), (2, 2), (1, 2), (1, 1), (0, 1)]
    faces = [(0, 1, 7), (1, 6, 7), (1, 3, 6), (1, 2, 3), (3, 4, 6), (4, 5, 6)]
    mesh = shapes.TriangleMesh(
        np.pad(corners, ((0, 0), (0, 1))),
        np.array(faces + more),
        np.array([*range(6), *[4 for _ in more]]),
    )
    graph = run(flat_mesh(normalized(mesh)).graph())
    creased = np.unique(np.sort(graph.neighbors[graph.bends > 0]), axis=0)
    assert creased.tolist() == [[2, 4]]
    assert graph.bends.max() == pytest.approx(np.pi / 2)
    assert not run(flat_mesh(normalized(RING)).graph()).bends.any()


def test_a_face_that_crosses_itself_lies_in_the_plane():
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
    crossed = TriangleMesh(corners, *triangulate(np.array(corners), [(0, 1, 2, 3)]))
    assert wall_length(crossed) == pytest.approx(3 + 2 * np.sqrt(2))  # of its triangles
    assert 0.1 < measure(crossed, Parameters(samples=100)).rank < 0.9
