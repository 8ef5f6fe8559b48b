import changes
import numpy as np
import pytest
import shapes
from computed import solid_of
from weak_convex_decomposition.core.geometry.cutting.segments import segments_below
from weak_convex_decomposition.core.hulls.cutting.cross_section import (
    contour,
    cross_section,
)

PLANE = np.array([0.0, 0.0, 1.0, -0.5])


@pytest.mark.parametrize(
    ("make", "volume"),
    [
        (shapes.box, 1),
        (shapes.table, 20 + 12),
        (lambda: shapes.sphere(3), 4 / 3 * np.pi),
        (lambda: shapes.hollow_sphere(subdivisions=3), 4 / 3 * np.pi * 7 / 8),
        (lambda: changes.moved(shapes.box(), rotation=changes.any_rotation(1)), 1),
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
    solid = solid_of(make())
    assert solid.volumes.sum() == pytest.approx(volume, rel=0.04, abs=1e-9)


@pytest.mark.parametrize("arm", [3.0, 3.1, 4.0, 5.2])
def test_sides_of_boxes_do_not_mislead_the_volume(arm):
    # A row of lines that all just miss a side of an arm would be a volume of 3 %.
    solid = solid_of(shapes.l_prism(arm))
    assert solid.volume == pytest.approx(2 * arm - 1, rel=0.004)
    leg = solid.volumes[solid.chords[:, 1] > 1].sum()
    assert leg == pytest.approx(arm - 1, rel=0.01)


POLES = [shapes.box((i / 5, 0, 0), (i / 5 + 0.004, 0.004, 1)) for i in range(5)]
TWINS = shapes.joined(shapes.box(), shapes.box((0.5, 0, 0), (1.5, 1, 1)))


@pytest.mark.parametrize(
    ("mesh", "volume", "error"),
    [
        (shapes.l_prism(100.0), 199, 1e-6),
        (shapes.joined(*POLES), 5 * 0.004**2, 1e-6),
        (changes.moved(shapes.hollow_sphere(0.3), (1, 0.1, 0.01)), None, 1e-6),
        (TWINS, 1.5, 0.01),  # what overlaps counts once
        (shapes.joined(TWINS, changes.moved(POLES[0], offset=(2, 0, 0))), 1.5, 0.01),
    ],
    ids=["thin L", "poles", "flat with a cavity", "twins", "twins and a pole"],
)
def test_the_true_volume_however_thin(mesh, volume, error):
    turned = changes.moved(mesh, rotation=changes.any_rotation(1))
    if volume is None:
        a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
        volume = np.einsum("td,td->", a, np.cross(b, c)) / 6
    assert solid_of(turned).true_volume == pytest.approx(volume, rel=error)


def test_the_volume_of_an_open_solid_is_measured():
    """Lines along two of the axes enter and leave a box without its top."""
    solid = solid_of(shapes.open_box())
    assert solid.true_volume == solid.volume == pytest.approx(2 / 3, rel=0.01)


def test_chords_are_inside():
    solid = solid_of(shapes.hollow_sphere())
    radii = np.linalg.norm(solid.chords, axis=1)
    assert radii.max() < 1
    assert radii.min() > 0.47


def test_contours_have_the_inside_on_their_left():
    mesh = changes.moved(shapes.sphere(2), rotation=changes.any_rotation(2))
    segments = contour(mesh.vertices[mesh.triangles], PLANE)
    assert segments[..., 2] == pytest.approx(0.5)
    starts, ends = segments[:, 0], segments[:, 1]
    turn = starts[:, 0] * ends[:, 1] - starts[:, 1] * ends[:, 0]
    assert turn.sum() / 2 == pytest.approx(np.pi * 0.75, rel=0.05)
    assert (turn >= 0).all()


def test_rims_end_at_other_planes():
    section = cross_section(solid_of(shapes.box((-1,) * 3, (1,) * 3)).corners, PLANE)
    planes = np.array([[1.0, 0, 0, -0.25], [0, 1, 0, -5]])
    rim = segments_below(planes, section.rim)
    assert rim.min(axis=(0, 1)) == pytest.approx([-1, -1, 0.5])
    assert rim.max(axis=(0, 1)) == pytest.approx([0.25, 1, 0.5])
    assert len(segments_below(np.array([[1.0, 0, 0, 5]]), section.rim)) == 0
    assert len(segments_below(np.zeros((0, 4)), section.rim)) == len(section.rim)


def test_cross_sections_leave_out_what_is_hollow():
    solid = solid_of(shapes.hollow_sphere(0.5, 3))
    plane = np.array([0.6, 0.0, 0.8, 0.0])
    points = cross_section(solid.corners, plane).spread(solid.vertices)
    radii = np.linalg.norm(points, axis=1)
    assert np.abs(points @ plane[:3]).max() < 1e-12
    assert radii.max() < 1
    assert radii.min() > 0.48
    assert len(points) * 0.04**2 == pytest.approx(np.pi * 0.75, rel=0.05)


def test_open_shapes_have_no_cross_section():
    sheet = solid_of(shapes.sheet())
    low, high = sheet.vertices.min(axis=0), sheet.vertices.max(axis=0)
    normal = np.eye(3)[np.ptp(sheet.vertices, axis=0).argmax()]
    plane = np.r_[normal, -normal @ (low + high) / 2]
    assert len(cross_section(sheet.corners, plane).spread(sheet.vertices)) == 0


def test_domes_seen_from_inside_have_no_cross_section():
    """As they have no volume: else cuts fill their hollow, and hulls stay far off."""
    ball = shapes.uv_sphere()
    is_upper = (ball.vertices[ball.triangles][..., 2] >= -0.01).all(axis=1)
    dome = shapes.mesh_of(ball.vertices, ball.triangles[is_upper])
    for mesh, has_inside in ((dome, True), (changes.inside_out(dome), False)):
        section = cross_section(solid_of(mesh).corners, PLANE)
        assert bool(len(section.spread(mesh.vertices))) == has_inside
        assert section.holds(np.array([[0.1, 0.1, 0.5]])) == has_inside


def test_points_inside_a_cross_section():
    solid = solid_of(shapes.hollow_sphere(0.5, 3))
    section = cross_section(solid.corners, PLANE * [1, 1, 1, 0])
    turns = np.linspace(0, 6, 20)
    for radius, inside in ((0.3, False), (0.6, True), (0.9, True), (1.1, False)):
        circle = radius * np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
        assert (section.holds(circle) == inside).all()
