import numpy as np
import pytest
import shapes
from computed import apart, marcher_of, normalized
from weak_convex_decomposition.core.geometry.sampling import sample_surface
from weak_convex_decomposition.core.sight.all_pairs import see_all_pairs
from weak_convex_decomposition.core.sight.lines import faces_inside, see_pairs
from weak_convex_decomposition.core.sight.viewpoints import viewpoints
from weak_convex_decomposition.core.steps.progress import run

BOXES_AS_L = shapes.joined(
    shapes.box((0, 0, 0), (4, 1, 1)), shapes.box((0.1, 0.1, 0.1), (0.9, 4, 0.9))
)


def look_at(mesh, n_samples=60, seed=0):
    mesh = normalized(mesh)
    samples = sample_surface(mesh, n_samples, np.random.default_rng(seed))
    return run(viewpoints(marcher_of(mesh), samples))


def see(mesh, n_samples=60, seed=0):
    """Return the samples of a mesh and which of them see each other."""
    views = look_at(mesh, n_samples, seed)
    return views.samples, run(see_all_pairs(views)).visible > 0


def winding_numbers(points, corners):
    """Return how often triangles wind around points, by their solid angles."""
    a, b, c = np.moveaxis(corners[None] - points[:, None, None], 2, 0)
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    above = (a * np.cross(b, c)).sum(axis=2)
    below = la * lb * lc + (a * b).sum(2) * lc + (b * c).sum(2) * la
    below = below + (c * a).sum(2) * lb
    return np.arctan2(above, below).sum(axis=1) / (2 * np.pi)


def crossings(start, end, corners):
    """Return where a segment meets triangles, as shares of its length."""
    shares = []
    for a, b, c in corners:
        normal = np.cross(b - a, c - a)
        from_plane, to_plane = (start - a) @ normal, (end - a) @ normal
        if from_plane * to_plane >= 0:
            continue
        share = from_plane / (from_plane - to_plane)
        point = start + share * (end - start)
        turns = [
            np.cross(v - u, point - u) @ normal for u, v in ((a, b), (b, c), (c, a))
        ]
        if min(turns) >= 0:
            shares.append(share)
    return sorted(shares)


def oracle(mesh, positions):
    """Return which points see each other, by winding numbers between crossings."""
    corners = mesh.vertices[mesh.triangles]
    los = np.eye(len(positions), dtype=bool)
    for i, j in np.argwhere(np.triu(~los)):
        cuts = [0.0, *crossings(positions[i], positions[j], corners), 1.0]
        middles = (np.array(cuts[:-1]) + cuts[1:])[:, None] / 2
        points = positions[i] + middles * (positions[j] - positions[i])
        los[i, j] = los[j, i] = (winding_numbers(points, corners) > 0.5).all()
    return los


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.box(),
        shapes.l_prism(),
        BOXES_AS_L,
        shapes.hollow_sphere(0.5, 0),
        shapes.joined(shapes.box(), shapes.box((2, 0, 0), (3, 1, 1))),
        shapes.joined(shapes.box(), shapes.box((0.2,) * 3, (0.8,) * 3)),
    ],
    ids=["box", "L", "crossing", "hollow", "apart", "nested"],
)
def test_lines_of_sight_agree_with_a_naive_oracle(mesh):
    views = look_at(mesh, 30)
    los = run(see_all_pairs(views)).visible > 0
    expected = oracle(normalized(mesh), views.positions)
    samples = views.samples
    towards = samples.positions[None] - samples.positions[:, None]
    heights = (towards * samples.normals[:, None]).sum(axis=2)
    # Viewpoints under the surface look around an edge that their samples do not.
    below = (heights < 1e-9) | (views.depths > 1)[:, None]
    expected &= below & below.T
    # Just above a tangent plane it matters how deep the viewpoints lie.
    flat = (heights > 1e-9) & (heights < 2e-3)
    clear = ~(flat | flat.T)
    assert clear.mean() > 0.9
    assert (los == expected)[clear].all()
    assert (los == los.T).all()
    assert los.diagonal().all()


@pytest.mark.parametrize("make", [shapes.box, shapes.uv_sphere])
def test_all_samples_of_a_convex_shape_see_each_other(make):
    assert see(make())[1].all()


def test_the_arms_of_an_l_are_hidden_from_each_other():
    samples, los = see(shapes.l_prism())
    x, y, _ = (samples.positions - samples.positions.min(axis=0)).T
    long_x, long_y = x > x.max() / 2, y > y.max() / 2
    assert not los[np.ix_(long_x, long_y)].any()
    assert los[np.ix_(long_x, long_x)].all()


def test_separate_solids_do_not_see_each_other():
    samples, los = see(shapes.joined(shapes.box(), shapes.box((3, 0, 0), (4, 1, 1))))
    left = samples.positions[:, 0] < 0
    assert not los[np.ix_(left, ~left)].any()
    assert los[np.ix_(left, left)].all()


def test_interpenetrating_shells_are_seen_through():
    beam = shapes.box((-2, 0.3, 0.3), (3, 0.7, 0.7))
    samples, los = see(shapes.joined(shapes.box(), beam), 100)
    x = samples.positions[:, 0]
    ends = np.abs(x) > np.abs(x).max() * 0.5
    assert (x[ends] < 0).any()
    assert (x[ends] > 0).any()
    assert los[np.ix_(ends, ends)].all()


def test_a_cavity_blocks_the_view():
    samples, los = see(shapes.hollow_sphere(0.6, 1), 100)
    outer = np.linalg.norm(samples.positions, axis=1) > 0.2
    positions = samples.positions / np.linalg.norm(samples.positions, axis=1)[:, None]
    opposite = positions @ positions.T < -0.8
    assert not los[opposite].any()
    assert opposite[np.ix_(outer, ~outer)].any()


def test_rays_out_of_a_hole_end_nowhere():
    mesh = shapes.open_box()
    _, los = see(mesh)
    assert los.shape == (60, 60)
    assert los.mean() > 0.9


def test_viewpoints_lie_under_the_surface_even_of_a_thin_wall():
    thin = shapes.box((0, 0, 0), (1, 1, 1e-4))
    views = look_at(thin)
    samples = views.samples
    depths = ((samples.positions - views.positions) * samples.normals).sum(axis=1)
    assert depths.min() > 0
    top = samples.normals[:, 2] ** 2 > 0.9
    assert depths[top].max() < 0.5e-4
    assert see(thin)[1].all()


def test_depths_count_the_shells_around_a_viewpoint():
    mesh = shapes.joined(shapes.box(), shapes.box((0.3,) * 3, (0.7,) * 3))
    views = look_at(mesh)
    inner = np.abs(views.samples.positions).max(axis=1) < 0.2
    assert inner.any()
    assert (views.depths[inner] == 2).all()
    assert (views.depths[~inner] == 1).all()


@pytest.mark.parametrize("copies", [2, 100])
def test_coincident_faces_do_not_hold_rays_up(copies):
    box = shapes.box()
    _, los = see(shapes.joined(*[box] * copies), 20)
    assert los.all()


def test_the_order_of_touching_solids_does_not_matter():
    """Two boxes share a wall; a third one lies beyond a gap."""
    boxes = [shapes.box((x, 0, 0), (x + 1, 1, 1)) for x in (0.0, 1.0, 2.5)]
    rates = [
        see(apart(shapes.joined(*(boxes[i] for i in order))), 120)[1].mean()
        for order in ((0, 1, 2), (1, 0, 2), (2, 1, 0))
    ]
    assert max(rates) - min(rates) < 0.06


def test_pairs_of_one_sample_see_themselves_and_repeated_pairs_agree():
    views = look_at(shapes.l_prism())
    los = run(see_all_pairs(views)).visible > 0
    first, second = np.random.default_rng(0).integers(60, size=(2, 300))
    visible = run(see_pairs(views, first, second))
    assert (visible == los[first, second]).all()
    assert run(see_pairs(views, first, first)).all()


def test_ends_of_a_segment_are_alike():
    views = look_at(shapes.l_prism(), 200)
    first, second = np.random.default_rng(0).integers(200, size=(2, 2000))
    there = faces_inside(views, first, second)
    assert (there == faces_inside(views, second, first)).all()
    assert 0.1 < there.mean() < 0.9


def test_normals_that_may_be_off_face_more_of_the_others():
    views = look_at(shapes.sphere(2), 100)
    first, second = np.triu_indices(100, 1)
    exact = faces_inside(views, first, second)
    views.marcher.tilt = 0.2
    tolerant = faces_inside(views, first, second)
    assert tolerant[exact].all()
    samples = views.samples
    segments = samples.positions[second] - samples.positions[first]
    segments /= np.linalg.norm(segments, axis=1, keepdims=True)
    rises = (segments * samples.normals[first]).sum(axis=1)
    falls = (segments * samples.normals[second]).sum(axis=1)
    assert tolerant[(rises < 0.19) & (falls > -0.19)].all()
    assert not tolerant[(rises > 0.3) | (falls < -0.3)].any()


def test_sight_reports_its_progress():
    views = look_at(shapes.box(), 200)
    fractions = [p.fraction for p in see_all_pairs(views)]
    assert len(fractions) >= 4
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] <= fractions[-1] <= 1
