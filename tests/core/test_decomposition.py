import changes
import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from computed import graph_of, parts_of, split_up
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters


@pytest.mark.parametrize("make", [shapes.comb, shapes.plus, shapes.dumbbell])
def test_the_figures_agree_with_each_other(decomposed, make):
    found, surface = decomposed(make), graph_of(make())
    labels = found.labels
    assert labels.shape == (surface.n_polygons,)
    assert set(labels) == set(range(found.n_parts))
    assert found.face_counts.tolist() == np.bincount(labels).tolist()
    assert found.areas == pytest.approx(np.bincount(labels, surface.areas))
    assert (np.diff(found.areas) <= 1e-9).all()
    assert ((found.ranks >= 0) & (found.ranks <= 1)).all()
    assert found.psi_by_k[1] == found.psi_before
    # Fewer parts may be preferred where psi hardly differs.
    best = max(found.psi_by_k.values())
    assert found.psi_by_k[found.n_parts] == pytest.approx(best, abs=0.01)
    assert found.psi > found.psi_before
    assert found.psi == pytest.approx(found.psi_by_k[found.n_parts], abs=0.1)


def test_a_given_number_of_parts_has_its_psi(seen):
    found = parts_of(seen(shapes.comb), Parameters(samples=150, parts=4))
    assert found.n_parts == 4
    searched = parts_of(seen(shapes.comb), Parameters(samples=150))
    # Of four parts, those compete too that five parts leave: their seams are shorter.
    others = found.psi_by_k | {4: searched.psi_by_k[4]}
    assert others == searched.psi_by_k
    assert found.psi_by_k[4] == pytest.approx(searched.psi_by_k[4], abs=0.05)
    assert found.best_k == searched.best_k == searched.n_parts
    assert found.good_k == searched.good_k
    assert found.best_k in found.good_k
    assert found.notes == ()


def test_psi_is_that_of_the_search_but_for_the_seams(seen):
    found = parts_of(seen(shapes.comb), Parameters(samples=150, smoothness=0.0))
    assert found.n_parts > 1
    assert found.psi == found.psi_by_k[found.n_parts]


def test_detail_decides_how_far_to_split(seen):
    counts = [
        parts_of(seen(shapes.comb), Parameters(samples=150, alpha=alpha)).n_parts
        for alpha in (0.0, 1.0, 10.0)
    ]
    assert counts[0] == 1
    assert counts == sorted(counts)
    assert counts[2] > 1


@pytest.mark.parametrize(
    "make",
    [shapes.box, shapes.l_prism, lambda: shapes.sphere(1)],
    ids=["box", "L", "s"],
)
@pytest.mark.parametrize("parts", [4, 100])
def test_fewer_parts_than_asked_for_come_with_a_note(make, parts):
    found = split_up(make(), parts=parts, samples=100)
    assert 1 <= found.n_parts <= min(parts, len(found.labels))
    assert set(found.labels) == set(range(found.n_parts))
    if found.n_parts == parts:
        assert "could be made" not in " ".join(found.notes)
        return
    (note,) = found.notes
    assert f"{found.n_parts} of the {parts}" in note


def test_faces_that_lie_in_several_parts_come_with_a_note():
    (note,) = split_up(shapes.l_prism(), parts=2, samples=200).notes
    assert "of the area lie in several parts" in note
    for fine in (shapes.l_shape(), shapes.box()):
        assert split_up(fine, samples=200).notes == ()


def test_more_loose_pieces_than_samples_come_with_a_note():
    specks = [shapes.box(low, np.add(low, 0.1)) for low in np.ndindex(4, 4, 4)]
    fast = {"parts": 2, "containers": "HOLLOW"}
    (note,) = split_up(shapes.joined(*specks), samples=20, **fast).notes
    assert "of 64 loose pieces are too small" in note
    assert split_up(shapes.joined(*specks[:8]), samples=160, **fast).notes == ()


def test_double_faces_and_sheets_inside_leave_the_parts_as_they_are():
    mesh = shapes.dumbbell()
    inner = shapes.sheet()
    doubled = shapes.joined(mesh, mesh)
    crossed = shapes.joined(mesh, changes.moved(inner, 0.2, offset=(1.5, 1.5, 1.5)))
    for shape in (doubled, crossed):
        found = split_up(shape, samples=100, parts=2, containers="HOLLOW")
        labels = found.labels[: mesh.n_polygons]
        x = mesh.vertices[mesh.triangles].mean(axis=1)[:, 0]
        ends = [labels[mesh.polygons[side]] for side in (x < 2.9, x > 6.1)]
        assert all((end == np.bincount(end).argmax()).mean() > 0.95 for end in ends)
        assert np.bincount(ends[0]).argmax() != np.bincount(ends[1]).argmax()


def test_progress_rises_from_nothing_to_all():
    parameters = Parameters(samples=100)
    cache = ShapeCache(BruteCaster)
    steps = decompose_in_steps(shapes.l_shape(), parameters, cache)
    progress = list(steps)
    fractions = [p.fraction for p in progress]
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] < 0.1
    assert 0.8 < fractions[-1] <= 1
    assert all(p.stage for p in progress)


# Shapes that are hardly any, and such that are none.


def test_few_samples_and_many_parts():
    found = split_up(shapes.l_prism(), samples=16, max_parts=64)
    assert found.n_parts == 2
    assert found.psi_before < found.psi < 2
    found = split_up(shapes.l_prism(), samples=16, parts=16)
    assert 2 < found.n_parts <= 8  # it has eight faces
    assert f"{found.n_parts} of the 16" in found.notes[0]


@pytest.mark.parametrize(
    "make",
    [shapes.open_box, lambda: shapes.hollow_sphere(0.5, 1)],
    ids=["open", "hollow"],
)
@pytest.mark.parametrize("sight", ["ALL_PAIRS", "CONE"])
def test_odd_surfaces_have_parts(make, sight):
    found = split_up(make(), samples=60, sight=sight, psi_pairs="RAYS")
    assert found.n_parts >= 1
    assert np.isfinite(found.psi)
    assert np.isfinite(found.ranks).all()


@pytest.mark.parametrize("make", [shapes.open_box, shapes.dumbbell])
@pytest.mark.parametrize("sight", ["BLOCKS", "ALL_PAIRS", "CONE"])
def test_parts_are_found_with_one_ray_a_sample(make, sight):
    found = split_up(make(), samples=200, sight=sight, rays=1)
    assert found.n_parts >= 1
    assert np.isfinite(found.ranks).all()


def test_polygons_without_area_get_a_part_too():
    mesh = shapes.l_shape()
    flat = shapes.mesh_of(mesh.vertices[:3], [(0, 0, 1), (2, 2, 2)])
    found = split_up(shapes.joined(mesh, flat))
    assert len(found.labels) == 106
    assert found.n_parts == 2


@pytest.mark.parametrize(
    ("vertices", "triangles", "text"),
    [
        (np.eye(3), np.zeros((0, 3)), "no faces"),
        ([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]], [[0, 1, 2]], "not finite"),
        ([[0, 0, 0], [1, 0, 0], [0, np.inf, 0]], [[0, 1, 2]], "not finite"),
        ([[0, 0, 0], [1, 1, 1], [2, 2, 2]], [[0, 1, 2]], "no area"),
        (np.ones((3, 3)), [[0, 1, 2]], "no area"),
        (np.eye(3), [[0, 1, 3]], "missing vertices"),
        (np.eye(3), [[0, 1, -1]], "missing vertices"),
    ],
    ids=["no faces", "nan", "inf", "degenerate", "coincident", "beyond", "below"],
)
def test_bad_input_is_refused_with_a_sentence(vertices, triangles, text):
    with pytest.raises(DecompositionError, match=text) as error:
        split_up(TriangleMesh(vertices, triangles, np.zeros(len(triangles), int)))
    assert str(error.value).endswith(".")


def test_boxes_put_together_flush_are_the_box_they_make():
    """Faces at the same place are neither passed unseen nor met twice."""
    flush = shapes.joined(
        shapes.box((0, 0, 0), (2, 1, 1)), shapes.box((1, 0, 0), (3, 1, 1))
    )
    found = split_up(flush)
    assert found.n_parts == 1
    assert found.psi_before > 0.99
    twice = shapes.joined(shapes.box(), shapes.box())
    assert split_up(twice).psi_before > 0.99
