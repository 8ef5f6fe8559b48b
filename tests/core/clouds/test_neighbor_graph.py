import changes
import clouds
import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.clouds.neighbor_graph import neighbor_graph
from weak_convex_decomposition.core.clouds.splats import areas_of_points
from weak_convex_decomposition.core.steps.progress import run


def surface_on(mesh, n_points=2000):
    points, normals = clouds.drawn(mesh, n_points)
    areas = areas_of_points(points, normals)
    return run(neighbor_graph(points, normals, areas))


def test_a_seam_is_about_as_long_as_the_line_it_follows():
    surface = surface_on(shapes.box(high=(3, 1, 1), divisions=6))
    across = (surface.centers[:, 0] > 1.5)[surface.neighbors]
    seam = surface.lengths[across[:, 0] != across[:, 1]].sum()
    assert seam == pytest.approx(4, rel=0.25)


def test_neighbors_are_pairs_without_repetition():
    surface = surface_on(shapes.sphere(3), 500)
    assert (surface.neighbors[:, 0] < surface.neighbors[:, 1]).all()
    assert len(np.unique(surface.neighbors, axis=0)) == len(surface.neighbors)
    assert len(surface.lengths) == len(surface.bends) == len(surface.neighbors)


def test_bends_are_positive_in_creases_and_negative_on_edges():
    surface = surface_on(changes.refined(shapes.l_prism()), 4000)
    bent = np.abs(surface.bends) > 1.0
    middles = surface.centers[surface.neighbors].mean(axis=1)
    bent &= np.abs(middles[:, 2] - 0.5) < 0.3  # away from the caps
    crease = np.linalg.norm(middles[:, :2] - 1, axis=1) < 0.3
    assert (surface.bends[bent & crease] > 0).mean() > 0.9
    assert (surface.bends[bent & ~crease] < 0).mean() > 0.9


def test_shells_that_lie_apart_are_not_connected():
    surface = surface_on(shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))))
    shells = surface.shells()
    right = surface.centers[:, 0] > 2
    assert not set(shells[right]) & set(shells[~right])
