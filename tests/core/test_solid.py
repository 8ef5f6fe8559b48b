import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.cutting import cross_section, cut_triangles
from weak_convex_decomposition.core.solid import solid_of

PLANE = np.array([0.0, 0.0, 1.0, -0.5])


@pytest.mark.parametrize(
    ("make", "volume"),
    [
        (shapes.box, 1),
        (shapes.table, 20 + 12),
        (lambda: shapes.sphere(3), 4 / 3 * np.pi),
        (lambda: shapes.hollow_sphere(subdivisions=3), 4 / 3 * np.pi * 7 / 8),
        (lambda: shapes.moved(shapes.box(), rotation=shapes.any_rotation(1)), 1),
        (shapes.cup, 1 - 0.8**2 * 0.9),
        # Where shells overlap counts once.
        (
            lambda: shapes.joined(
                shapes.box(), shapes.box((0.5, 0.1, 0.1), (1.5, 0.9, 0.9))
            ),
            1 + 0.5 * 0.64,
        ),
        (shapes.sheet, 0),
    ],
    ids=["box", "table", "sphere", "hollow", "turned", "cup", "overlap", "sheet"],
)
def test_the_volume_along_lines(make, volume):
    solid = solid_of(make(), 0)
    assert solid.volumes.sum() == pytest.approx(volume, rel=0.04, abs=1e-9)


def test_chords_are_inside():
    solid = solid_of(shapes.hollow_sphere(), 0)
    radii = np.linalg.norm(solid.chords, axis=1)
    assert radii.max() < 1
    assert radii.min() > 0.47


def test_cut_triangles_keep_the_surface():
    mesh = shapes.moved(shapes.sphere(2), rotation=shapes.any_rotation(2))
    corners = mesh.vertices[mesh.triangles]
    below, above, segments = cut_triangles(corners, PLANE)
    assert below[..., 2].max() <= 0.5 + 1e-12
    assert above[..., 2].min() >= 0.5 - 1e-12
    areas = [
        np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum() / 2
        for t in (below, above)
    ]
    assert sum(areas) == pytest.approx(mesh.areas.sum())
    # The rim is a circle, the inside on its left.
    assert segments[..., 2] == pytest.approx(0.5)
    starts, ends = segments[:, 0], segments[:, 1]
    turn = starts[:, 0] * ends[:, 1] - starts[:, 1] * ends[:, 0]
    assert turn.sum() / 2 == pytest.approx(np.pi * 0.75, rel=0.05)
    assert (turn >= 0).all()


def test_cross_sections_leave_out_what_is_hollow():
    solid = solid_of(shapes.hollow_sphere(0.5, 3), 0)
    plane = np.array([0.6, 0.0, 0.8, 0.0])
    points = cross_section(solid, plane).spread(solid.vertices)
    radii = np.linalg.norm(points, axis=1)
    assert np.abs(points @ plane[:3]).max() < 1e-12
    assert radii.max() < 1
    assert radii.min() > 0.48
    assert len(points) * 0.04**2 == pytest.approx(np.pi * 0.75, rel=0.05)


def test_open_shapes_have_no_cross_section():
    sheet = solid_of(shapes.sheet(), 0)
    low, high = sheet.vertices.min(axis=0), sheet.vertices.max(axis=0)
    normal = np.eye(3)[np.ptp(sheet.vertices, axis=0).argmax()]
    plane = np.r_[normal, -normal @ (low + high) / 2]
    assert len(cross_section(sheet, plane).spread(sheet.vertices)) == 0


def test_points_inside_a_cross_section():
    section = cross_section(
        solid_of(shapes.hollow_sphere(0.5, 3), 0), PLANE * [1, 1, 1, 0]
    )
    turns = np.linspace(0, 6, 20)
    for radius, inside in ((0.3, False), (0.6, True), (0.9, True), (1.1, False)):
        circle = radius * np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
        assert (section.holds(circle) == inside).all()
