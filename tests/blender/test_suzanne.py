"""What everybody tries first: Blender's monkey, subdivided, with the defaults."""

import functools

import numpy as np
import pytest
from computed import decompose, graph_of
from definitions import agreement
from hand_made import subdivided_suzanne
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.find import Decomposition
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster
from weak_convex_decomposition.operators.bridge.read.shape import read_shape

# Places of Suzanne's own features, in her own space.
EARS = ((-1.3, 0.3, 0.4), (1.3, 0.3, 0.4))
CHIN = (0.0, -0.7, -0.9)
CROWN = (0.0, 0.5, 0.9)


@functools.cache
def suzanne(subdivisions: int) -> TriangleMesh:
    return read_shape(subdivided_suzanne(subdivisions))


def parts_of(mesh: TriangleMesh) -> Decomposition:
    return decompose(mesh, Parameters(), make_caster=BvhRayCaster)


@functools.cache
def reference() -> Decomposition:
    return parts_of(suzanne(2))


def with_vertices(mesh, vertices):
    return TriangleMesh(vertices, mesh.triangles, mesh.polygons)


def centers(mesh):
    corners = mesh.vertices[mesh.triangles].mean(axis=1)
    counts = np.bincount(mesh.polygons)
    sums = [np.bincount(mesh.polygons, corners[:, axis]) for axis in range(3)]
    return np.stack(sums, axis=1) / counts[:, None]


def test_muzzle_and_ears_are_parts_of_their_own():
    mesh, found = suzanne(2), reference()
    nearest = cKDTree(centers(mesh)).query([*EARS, CHIN, CROWN])[1]
    assert len(set(found.labels[nearest])) == 4
    ears = np.sort(found.areas[found.labels[nearest[:2]]]) / found.areas.sum()
    assert 0.03 < ears[0] <= ears[1] < 0.1
    assert ears[1] - ears[0] < 0.01


def test_no_part_is_a_speck():
    assert reference().areas.min() >= 0.005 * reference().areas.sum()


def test_faces_may_be_shuffled():
    mesh = suzanne(2)
    order = np.random.default_rng(1).permutation(mesh.n_polygons)
    place = np.argsort(order)[mesh.polygons]
    rows = np.argsort(place, kind="stable")
    shuffled = TriangleMesh(mesh.vertices, mesh.triangles[rows], place[rows])
    labels = parts_of(shuffled).labels[np.argsort(order)]
    areas = np.bincount(mesh.polygons, mesh.areas)
    # Several numbers of parts have nearly the same psi: a small part may come or go.
    assert agreement(labels, reference().labels, areas) >= 0.92


@pytest.mark.parametrize(
    ("turn", "scale"), [((0, 0, 0), 1000.0), ((0, 0, 0), 0.001), ((40, 70, 20), 1.0)]
)
def test_pose_and_size_do_not_matter(turn, scale):
    mesh = suzanne(2)
    rotation = Rotation.from_euler("xyz", turn, degrees=True).as_matrix()
    moved = with_vertices(mesh, scale * mesh.vertices @ rotation.T)
    areas = np.bincount(mesh.polygons, mesh.areas)
    assert agreement(parts_of(moved).labels, reference().labels, areas) >= 0.97


def test_a_further_subdivision_does_not_matter():
    coarse, fine = suzanne(2), suzanne(3)
    nearest = cKDTree(centers(coarse)).query(centers(fine))[1]
    areas = np.bincount(fine.polygons, fine.areas)
    labels = parts_of(fine).labels
    # As above.
    assert agreement(labels, reference().labels[nearest], areas) >= 0.92


def test_parts_have_no_specks():
    mesh, found = suzanne(2), reference()
    surface = graph_of(mesh)
    areas = surface.areas_of(surface.pieces(found.labels, 0.0))
    assert areas.min() >= 0.005 * areas.sum()


def test_more_detail_finds_more_parts_and_less_finds_fewer():
    counts = [
        decompose(suzanne(2), Parameters(alpha=alpha), make_caster=BvhRayCaster).n_parts
        for alpha in (0.2, 10.0)
    ]
    assert counts[0] < reference().n_parts < counts[1]
