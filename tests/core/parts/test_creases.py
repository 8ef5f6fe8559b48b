"""Parts between closed loops of creases."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from computed import decompose, decomposer, graph_of, part_count_search, see
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.merging.flush import flush_seams
from weak_convex_decomposition.core.parts.merging.pieces import pieces_between


def pins():
    """Return a plate with a pin on either side."""
    radii = [0, *[0.5] * 4, *np.linspace(0.5, 3, 6), *np.linspace(3, 0.5, 6)]
    heights = [-2, *np.linspace(-2, -0.5, 4), *[0] * 6, *[0.3] * 6]
    rise = [0.8, 1.3, 1.8, 2.3, 2.3]
    return shapes.turned([*radii, *[0.5] * 4, 0], heights + rise, 48)


def crease_pieces(graph):
    """Return the pieces between all creases."""
    return pieces_between(graph, graph.bends > 0.25)


@pytest.mark.parametrize(
    ("make", "expected"),
    [(pins, 3), (shapes.l_prism, 1), (shapes.dumbbell, 3), (shapes.box, 1)],
)
def test_only_loops_of_creases_divide(make, expected):
    assert len(set(crease_pieces(graph_of(make())))) == expected


def test_shells_that_touch_are_one_piece():
    graph = graph_of(shapes.joined(shapes.box(), shapes.box((1, 0, 0), (2, 1, 1))))
    linked = type(graph)(**(vars(graph) | {"links": np.array([[0, 11]])}))
    assert len(set(crease_pieces(linked))) == 1


def low_step():
    """Return a short shaft with one low step."""
    heights = [0, *np.linspace(0, 2, 6), *np.linspace(2, 3, 6), 3]
    return shapes.turned([0, *[1.0] * 6, *[0.85] * 6, 0], heights, 48)


@pytest.mark.parametrize("parts", [0, 2])
def test_a_low_step_is_a_seam(parts):
    """By psi alone, such a shaft would stay whole."""
    mesh = low_step()
    found = decompose(mesh, Parameters(parts=parts))
    heights = graph_of(mesh).centers[:, 2]
    assert found.n_parts == 2
    assert set(found.labels[heights < 2]).isdisjoint(found.labels[heights > 2.05])


def test_the_floor_of_a_pocket_is_no_part():
    """A crease runs around it, as around the foot of a pin."""
    corners, steps = range(6), np.linspace(0, 5, 31)
    radii = np.interp(steps, corners, [0, 3, 3, 2, 2, 0])
    mesh = shapes.turned(radii, np.interp(steps, corners, [0, 0, 2, 2, 1, 1]), 48)
    assert len(set(crease_pieces(graph_of(mesh)))) == 2
    assert decompose(mesh, Parameters()).n_parts == 1


# Radii and heights of lines around the z axis, up on the outside and down within.
VESSELS = [
    ([0, 0.5, 1, 1.2, 1.1, 0.92, 0.45, 0], [0, 0, 0.5, 1, 1, 0.55, 0.12, 0.12]),
    (
        [0, 0.5, 0.9, 0.5, 0.6, 0.5, 0.42, 0.8, 0.45, 0],
        [0, 0, 0.8, 1.8, 2.2, 2.2, 1.8, 0.8, 0.1, 0.1],
    ),
]


@pytest.mark.parametrize(("radii", "heights"), VESSELS)
def test_a_shape_stays_whole_if_pieces_are_worse(radii, heights):
    """Creases run around the inside of a thick bowl and of a vase."""
    found = decomposer(shapes.turned(radii, heights))
    assert found().n_parts == 1
    assert found(min_parts=3).n_parts >= 3
    assert found(parts=2).n_parts == 2


@pytest.mark.parametrize("seed", [0, 1])
def test_parts_follow_loops_that_cost_little_psi(seed):
    """Psi alone would cut a slice off a pin."""
    mesh = pins()
    found = decompose(mesh, Parameters(seed=seed))
    assert (found.n_parts, found.best_k) == (3, 3)
    pieces = crease_pieces(graph_of(mesh))
    assert len(set(zip(found.labels, pieces, strict=True))) == 3
    assert found.psi == pytest.approx(found.psi_by_k[3])


@pytest.mark.parametrize("parts", [0, 2])
def test_what_rounds_off_a_crease_is_no_part(parts):
    """A pin on a plate, and a chamfer around its foot."""
    radii = [0, *np.linspace(0, 3, 6)[1:], *np.linspace(3, 1.2, 6), *[1.0] * 6, 0]
    heights = [0, *[0] * 5, *[1] * 6, *np.linspace(1.2, 4, 6), 4]
    mesh = shapes.turned(radii, heights, 48)
    graph = graph_of(mesh)
    assert len(set(crease_pieces(graph))) == 3
    found = decompose(mesh, Parameters(parts=parts))
    assert found.n_parts == 2
    is_pin = graph.centers[:, 2] > 1.2
    assert set(found.labels[is_pin]).isdisjoint(found.labels[graph.centers[:, 2] < 1])


def test_other_numbers_and_limits_are_kept():
    found = decomposer(pins())
    assert found(parts=2).n_parts == 2
    assert found(parts=5).n_parts == 5
    assert found(min_parts=4, max_parts=6).n_parts >= 4


@pytest.mark.parametrize("tip", [0.25, 0.1])
def test_what_lies_between_a_seam_and_a_loop_is_no_part(tip):
    """Two balls without a loop between them, and a tail behind a step.

    Where the tail tapers, the loop around its foot is longer than the seam beside it.
    """
    heights = np.array([*np.linspace(-4, 2, 73), 2.0, 2.05, *np.linspace(2.1, 4, 8)])
    radii = 0.5 + 0.5 * np.sin(np.pi * (heights + 4) / 3) ** 2
    radii[73:], radii[[0, -1]] = np.linspace(0.25, tip, 10), 0.0
    parameters = Parameters(samples=300, smallest_part=0.002)
    memo = see(shapes.turned(radii, heights, 32), parameters)
    creases = part_count_search(memo, parameters, 2, 9).creases
    along = memo.transfer.graph.centers[:, 2]
    step = along[creases.pieces == creases.pieces[along.argmax()]].min()
    beside = np.digitize(along, [(along.min() + step) / 2, step + 0.01])
    found = creases.better(beside, 1, 9)
    assert found is not beside
    assert len(set(found)) == 3
    assert set(found[along < step - 1e-3]).isdisjoint(found[along > step + 1e-3])


@pytest.mark.parametrize(("bend", "expected"), [(0.17, 1), (0.2, 2)])
def test_auto_leaves_no_seams_that_gain_next_to_nothing(bend, expected):
    """Both halves of a bent bar gain 0.007, or 0.114; the seam costs 0.127."""
    bar, few = shapes.box((-3, 0, 0), (3, 1, 1), 8), Parameters(samples=300)
    sunk = bar.vertices - [0, 0, bend] * np.abs(bar.vertices[:, :1])
    memo = see(replace(bar, vertices=sunk), few)
    halves = (memo.transfer.graph.centers[:, 0] > 0).astype(np.int64)
    better = part_count_search(memo, few, 2, 9).creases.better
    assert len(set(better(halves, 1, 9))) == expected
    assert len(set(better(halves, 2, 2))) == 2


def ears():
    """Return a flat disc with two small square ears, fanned from its center."""
    angles = np.linspace(0.0, 2 * np.pi, 48, endpoint=False)
    disc = 2 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    faces = [(48, n, (n + 1) % 48) for n in range(48)]
    vertices = [*disc, (0.0, 0.0)]
    for foot in (5, 17):
        outwards = 0.25 * disc[[foot, foot + 1]].mean(axis=0) / 2
        first = len(vertices)
        vertices += list(disc[[foot, foot + 1]] + outwards)
        faces += [(foot + 1, foot, first), (foot + 1, first, first + 1)]
    triangles = np.array(faces)
    return shapes.TriangleMesh(
        np.pad(vertices, ((0, 0), (0, 1))), triangles, np.arange(len(triangles))
    )


def test_seams_between_concave_corners_divide_flat_shapes():
    """By psi alone, what so small an ear hides is too little to count."""
    found = decompose(ears(), Parameters())
    disc, one, other = found.labels[:48], found.labels[48:50], found.labels[50:]
    assert found.n_parts == 3
    assert [len(set(part)) for part in (disc, one, other)] == [1, 1, 1]


def test_pieces_of_flat_shapes_are_merged_to_the_number_allowed():
    assert decompose(ears(), Parameters(max_parts=2)).n_parts == 2


def both(*numbers):
    """Return ascending numbers below 0, and the same above 0."""
    return np.array([*numbers, *(-number for number in reversed(numbers))])


# Corners of the boxes of two figures, by axis, and which of these across arms and legs
# extend to. Parts of the second one hide less of each other.
FIGURES = [
    (
        both(-1.6, -1.0, -0.6, -0.1),
        both(-0.6, -0.4, -0.3, -0.2),
        np.array([-3.2, 0.0, 0.6, 2.5, 2.6, 3.8]),
        ((2, 5), (3, 4)),
    ),
    (
        both(-2.8, -0.86, -0.46, -0.29),
        both(-0.63, -0.53, -0.49, -0.41),
        np.array([-2.2, 0.0, 2.1, 2.7, 2.9, 3.9]),
        ((3, 4), (2, 5)),
    ),
]


def figure(*lines, across):
    """Return a low-poly figure of boxes, and the number of the box of each face."""
    body, head = ((1, 6), (1, 6), (1, 4)), ((2, 5), (0, 7), (4, 5))
    arms = [(x, across[0], (2, 3)) for x in ((0, 1), (6, 7))]
    legs = [(x, across[1], (0, 1)) for x in ((1, 3), (4, 6))]
    boxes = [body, head, *arms, *legs]
    mesh = shapes.blocks((7, 7, 5), *boxes)
    corners = mesh.vertices.astype(int).T
    places = [line[numbers] for line, numbers in zip(lines, corners, strict=True)]
    inside = graph_of(mesh).centers - 0.1 * graph_of(mesh).normals
    within = [
        (inside > np.array(box)[:, 0]).all(axis=1)
        & (inside < np.array(box)[:, 1]).all(axis=1)
        for box in boxes
    ]
    mesh = replace(mesh, vertices=np.stack(places, axis=1))
    return mesh, np.argmax(within, axis=0)


@pytest.mark.parametrize("number", [0, 1])
def test_a_low_poly_figure_comes_apart_where_its_boxes_meet(number):
    *lines, across = FIGURES[number]
    mesh, boxes = figure(*lines, across=across)
    assert len(mesh.triangles) < 600
    found = decompose(mesh, Parameters())
    assert found.n_parts == 6
    assert len(set(zip(found.labels, boxes, strict=True))) == 6


def test_loops_are_closed_where_blocks_are_flush():
    """The legs of a figure and its body have their outer sides in one plane."""
    *lines, across = FIGURES[1]
    mesh, boxes = figure(*lines, across=across)
    graph = graph_of(mesh)
    creases = graph.bends > 0.25
    closed = pieces_between(graph, creases | flush_seams(graph, creases))
    assert len(set(crease_pieces(graph))) == 4
    assert len(set(closed)) == 6
    assert len(set(zip(closed, boxes, strict=True))) == 6


@pytest.mark.parametrize("make", [shapes.l_shape, shapes.plus, shapes.box])
def test_what_is_more_flat_than_crease_is_no_loop(make):
    graph = graph_of(make())
    assert not flush_seams(graph, graph.bends > 0.25).any()
