import numpy as np
import pytest
import shapes
import trimesh
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.solids.mass import mass_of_mesh, mass_of_surface
from weak_convex_decomposition.core.solids.mass_properties import combined_mass

DENSITY = 7.0
SOLIDS = {
    "l_prism": shapes.l_prism,
    "cup": shapes.cup,
    "mug": shapes.mug,
    "bowl": shapes.bowl,
    "dumbbell": shapes.dumbbell,
    "plus": shapes.plus,
    "sphere": shapes.sphere,
}


def torus(ring=2.0, tube=0.5, around=400, across=200):
    """Return a torus about the z axis."""
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    turns, tilts = 2 * np.pi * u / around, 2 * np.pi * v / across
    reach = ring + tube * np.cos(tilts)
    places = [reach * np.cos(turns), reach * np.sin(turns), tube * np.sin(tilts)]

    def at(i, j):
        return ((u + i) % around * across + (v + j) % across).ravel()

    quads = np.stack([at(0, 0), at(1, 0), at(1, 1), at(0, 1)], axis=1)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    vertices = np.stack(places, axis=-1).reshape(-1, 3)
    return TriangleMesh(vertices, triangles, np.arange(len(triangles)))


def moved(mesh, matrix, shift=(0, 0, 0)):
    return TriangleMesh(
        mesh.vertices @ np.asarray(matrix, float).T + shift,
        mesh.triangles,
        mesh.polygons,
    )


def assert_same(found, expected, rel=1e-9):
    assert found.mass == pytest.approx(expected.mass, rel=rel)
    size = np.sqrt(np.trace(expected.inertia) / expected.mass)
    assert found.center == pytest.approx(expected.center, abs=rel * size)
    top = np.abs(expected.inertia).max()
    assert found.inertia == pytest.approx(expected.inertia, abs=rel * top)


@pytest.mark.parametrize("middle", [(0, 0, 0), (1, -2, 3), (1e5, 0, 0)])
def test_box(middle):
    low, high = np.add(middle, (-1, -2, -3)), np.add(middle, (1, 2, 3))
    found = mass_of_mesh(shapes.box(low, high), DENSITY)
    assert found.mass == pytest.approx(48 * DENSITY)
    assert found.center == pytest.approx(middle)
    # m / 12 (b² + c²) and so on
    expected = found.mass / 12 * np.diag([16 + 36, 4 + 36, 4 + 16])
    assert found.inertia == pytest.approx(expected, abs=1e-6)


def test_tetrahedron():
    corners = np.concatenate([np.zeros((1, 3)), np.eye(3)])
    triangles = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    found = mass_of_surface(corners, triangles, 6.0)
    assert found.mass == pytest.approx(1)
    assert found.center == pytest.approx([0.25] * 3)
    # ∫x² = 1/10 and ∫xy = 1/20 about the corner, less 1/16 each
    expected = np.full((3, 3), -(1 / 20 - 1 / 16)) + np.eye(3) * (1 / 20 - 1 / 16)
    expected += np.eye(3) * 2 * (1 / 10 - 1 / 16)
    assert found.inertia == pytest.approx(expected)


def test_sphere_and_torus():
    ball = mass_of_mesh(shapes.sphere(5, radius=2), 1.0)
    assert ball.mass == pytest.approx(4 / 3 * np.pi * 8, rel=2e-3)
    expected = 2 / 5 * ball.mass * 4 * np.eye(3)
    assert ball.inertia == pytest.approx(expected, rel=2e-3, abs=1e-6)
    ring = mass_of_mesh(torus(), 1.0)
    assert ring.mass == pytest.approx(2 * np.pi**2 * 2 * 0.25, rel=1e-3)
    across, along = 0.5 * 4 + 5 / 8 * 0.25, 4 + 0.75 * 0.25
    expected = ring.mass * np.diag([across, across, along])
    assert ring.inertia == pytest.approx(expected, rel=1e-3, abs=1e-6)


@pytest.mark.parametrize("name", SOLIDS)
def test_as_trimesh(name):
    matrix = np.array([(1.0, 0.3, 0.0), (-0.2, 2.0, 0.1), (0.0, 0.4, -0.7)])
    mesh = moved(SOLIDS[name](), matrix, (3.0, 1.0, -2.0))
    read = trimesh.Trimesh(mesh.vertices, mesh.triangles[:, ::-1], process=False)
    read.density = DENSITY
    assert read.is_volume
    expected = read.mass_properties
    found = mass_of_mesh(mesh, DENSITY)
    assert found.mass == pytest.approx(expected["mass"])
    assert found.center == pytest.approx(expected["center_mass"])
    top = np.abs(expected["inertia"]).max()
    assert found.inertia == pytest.approx(expected["inertia"], abs=1e-9 * top)


def test_parts_together_are_the_whole():
    halves = [shapes.box((0, 0, 0), (1, 1, 1)), shapes.box((1, 0, 0), (4, 1, 1))]
    whole = mass_of_mesh(shapes.box((0, 0, 0), (4, 1, 1)), DENSITY)
    assert_same(combined_mass([mass_of_mesh(half, DENSITY) for half in halves]), whole)


def test_turns_scales_and_mirrors():
    mesh = shapes.l_prism()
    plain = mass_of_mesh(mesh, DENSITY)
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    for matrix in (turn, -turn):
        found = mass_of_mesh(moved(mesh, 1e-3 * matrix), DENSITY)
        assert found.mass == pytest.approx(plain.mass * 1e-9)
        assert found.center == pytest.approx(1e-3 * matrix @ plain.center)
        expected = 1e-15 * matrix @ plain.inertia @ matrix.T
        assert found.inertia == pytest.approx(expected, rel=1e-6)


def test_shells_are_turned_and_cavities_are_empty():
    hollow = shapes.hollow_sphere(inner=0.5, subdivisions=3)
    full, hole = shapes.sphere(3), shapes.sphere(3, radius=0.5)
    whole, inner = mass_of_mesh(full, 1.0), mass_of_mesh(hole, 1.0)
    found = mass_of_mesh(hollow, 1.0)
    assert found.mass == pytest.approx(whole.mass - inner.mass)
    assert found.inertia == pytest.approx(whole.inertia - inner.inertia, abs=1e-9)
    one, other = shapes.box(), shapes.box((2, 0, 0), (3, 1, 1))
    inverted = TriangleMesh(other.vertices, other.triangles[:, ::-1], other.polygons)
    assert mass_of_mesh(shapes.joined(one, inverted), 1.0).mass == pytest.approx(2)


def test_what_is_open_or_flat_has_none():
    assert mass_of_mesh(shapes.open_box(), 1.0) is None
    assert mass_of_mesh(shapes.joined(shapes.box(), shapes.sheet()), 1.0) is None
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    two_sided = TriangleMesh(
        corners, [(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)], range(4)
    )
    assert mass_of_mesh(two_sided, 1.0) is None


@pytest.mark.parametrize("size", [(10, 3e-4, 3e-4), (1, 1, 1e-5)])
def test_thin_solids_weigh_something(size):
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    found = mass_of_mesh(moved(shapes.box((0, 0, 0), size), turn), 8000.0)
    assert found.mass == pytest.approx(8000 * np.prod(size))
    least, middle, most = np.linalg.eigvalsh(found.inertia)
    assert least > 0
    assert least + middle >= most * (1 - 1e-14)


@pytest.mark.parametrize("corners", [(0, 0, 1), (0, 0, 0), (0, 1, 0)])
def test_triangles_without_area_open_no_solid(corners):
    box = shapes.box()
    mesh = TriangleMesh(box.vertices, [*box.triangles, corners], range(13))
    assert mass_of_mesh(mesh, DENSITY).mass == pytest.approx(DENSITY)


def test_solids_that_touch_weigh_as_much_as_both():
    both = shapes.joined(shapes.box(), shapes.box((1, 0, 0), (2, 1, 1)))
    found = mass_of_mesh(both, DENSITY)
    assert_same(found, mass_of_mesh(shapes.box((0, 0, 0), (2, 1, 1)), DENSITY))


def test_a_face_too_many_is_no_solid():
    box = shapes.box()
    mesh = TriangleMesh(box.vertices, [*box.triangles, box.triangles[0]], range(13))
    assert mass_of_mesh(mesh, DENSITY) is None
