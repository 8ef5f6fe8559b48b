from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import shells_of
from weak_convex_decomposition.core.solids.orientation import oriented
from weak_convex_decomposition.core.steps.progress import run


def facing_out(mesh):
    """Return the mesh with its own shells oriented, and notes."""
    return run(oriented(mesh, shells_of(mesh)))


def mobius(n_steps=24):
    """Return a strip with one twist, which nothing can wind consistently."""
    angles = np.arange(n_steps) * 2 * np.pi / n_steps
    vertices = []
    for angle in angles:
        around = np.array([np.cos(angle), np.sin(angle), 0])
        across = np.cos(angle / 2) * around + np.sin(angle / 2) * np.eye(3)[2]
        vertices += [around - across / 4, around + across / 4]
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(n_steps - 1)]
    return shapes.mesh_of(vertices, [*faces, (2 * n_steps - 2, 1, 0, 2 * n_steps - 1)])


def partly_turned(mesh, chosen):
    """Return the mesh with the chosen triangles turned."""
    chosen = np.asarray(chosen, dtype=bool)[:, None]
    return replace(
        mesh, triangles=np.where(chosen, mesh.triangles[:, ::-1], mesh.triangles)
    )


def assert_untouched(mesh):
    result, notes = facing_out(mesh)
    assert result is mesh
    assert notes == ()


def assert_same_winding(result, expected):
    """Compare the triangles as sets of directed edges."""
    for mine, other in zip(result.triangles, expected.triangles, strict=True):
        assert {*np.roll(mine, -1).tolist()} == {*other.tolist()}
        start = other.tolist().index(mine[0])
        assert mine.tolist() == np.roll(other, -start).tolist()


SOLIDS = {
    "box": shapes.box,
    "L": shapes.l_shape,
    "sphere": shapes.uv_sphere,
    "split": lambda: changes.split(shapes.box(divisions=2)),
    "hollow": lambda: shapes.hollow_sphere(0.5, 1),
    "apart": lambda: shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))),
    "crossing": lambda: shapes.joined(
        shapes.box((0, 0, 0), (3, 1, 1)), shapes.box((0.2, 0.3, -1), (0.8, 0.7, 2))
    ),
    "nested": lambda: shapes.joined(shapes.box(), shapes.box((0.3,) * 3, (0.6,) * 3)),
    "core in a cavity": lambda: shapes.joined(
        shapes.hollow_sphere(0.5, 1), shapes.sphere(1, 0.2)
    ),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_what_faces_out_stays_as_it_is(name):
    assert_untouched(SOLIDS[name]())


@pytest.mark.parametrize("name", SOLIDS)
def test_what_is_inside_out_is_turned_whole(name):
    mesh = SOLIDS[name]()
    result, notes = facing_out(changes.inside_out(mesh))
    assert_same_winding(result, mesh)
    assert len(notes) == 1
    assert "inside out" in notes[0]


@pytest.mark.parametrize("name", [name for name in SOLIDS if name != "nested"])
def test_inconsistent_winding_is_mended(name):
    mesh = SOLIDS[name]()
    turned = np.random.default_rng(3).random(len(mesh.triangles)) < 0.3
    result, notes = facing_out(partly_turned(mesh, turned))
    assert_same_winding(result, mesh)
    assert len(notes) == 1
    assert "inconsistently" in notes[0]


def test_one_of_two_separate_solids_is_turned():
    one, other = shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))
    result, notes = facing_out(shapes.joined(one, changes.inside_out(other)))
    assert_same_winding(result, shapes.joined(one, other))
    assert len(notes) == 1


def test_one_of_two_interpenetrating_solids_is_turned():
    one, other = shapes.box(), shapes.box((0.5, 0.5, 0.5), (2, 2, 2))
    result, _ = facing_out(shapes.joined(one, changes.inside_out(other)))
    assert_same_winding(result, shapes.joined(one, other))


@pytest.mark.parametrize("make", [shapes.sheet, mobius], ids=lambda m: m.__name__)
def test_open_shells_keep_their_sense(make):
    assert_untouched(make())
    assert_untouched(changes.inside_out(make()))


def test_an_open_shell_that_is_nearly_closed_is_turned_outwards():
    box = shapes.open_box()
    assert_untouched(box)
    away = changes.moved(box, offset=(5, -3, 2))
    result, notes = facing_out(changes.inside_out(away))
    assert_same_winding(result, away)
    assert "inside out" in notes[0]


def test_a_solid_with_a_sliver_is_still_closed():
    """A triangle without area between two others, as many files have them."""
    box = changes.split(shapes.box())
    sliver = shapes.mesh_of(box.vertices[[0, 0, 1]], [(0, 1, 2)])
    mesh = shapes.joined(box, sliver)
    result, notes = facing_out(changes.inside_out(mesh))
    assert notes
    assert_same_winding(
        changes.without(result, lambda centers: np.arange(len(centers)) >= 12), box
    )


def test_positions_and_polygons_are_kept():
    mesh = changes.inside_out(shapes.box(divisions=2))
    result, _ = facing_out(mesh)
    assert (result.vertices == mesh.vertices).all()
    assert (result.polygons == mesh.polygons).all()


def test_what_is_open_turns_with_an_object_that_is_inside_out():
    both = shapes.joined(shapes.box(), changes.moved(shapes.sheet(), offset=(5, 0, 0)))
    assert_untouched(both)
    result, notes = facing_out(changes.inside_out(both))
    assert_same_winding(result, both)
    assert "inside out" in notes[0]


def test_a_sheet_with_two_sides_is_not_inside_out():
    sheet = shapes.sheet(8)
    bent = sheet.vertices + np.sin(5 * sheet.vertices[:, :1]) * [0, 0, 0.3]
    sheet = replace(sheet, vertices=bent)
    for seed in range(5):
        turned = changes.moved(sheet, rotation=changes.any_rotation(seed))
        assert_untouched(shapes.joined(turned, changes.inside_out(turned)))
