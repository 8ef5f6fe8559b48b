"""The public functions, called as a script would."""

from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import numpy as np
import pytest
import weak_convex_decomposition as wcd
from shapes import dumbbell, l_shape
from weak_convex_decomposition.core.steps.progress import Progress

OUTLINE = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
VERTICES = [(x, y, z) for z in (0, 1) for x, y in OUTLINE]
WALLS = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
FACES = [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *WALLS]


class Cloud:
    """A point cloud of another library: vertices, and no faces."""

    vertices = l_shape().vertices[l_shape().triangles].mean(axis=1)


class Readable:
    """An array of another library, which NumPy can read."""

    def __init__(self, values):
        self.values = values

    def __array__(self, dtype=None, copy=None):
        return np.array(self.values, dtype=dtype)


class Trimesh:
    """A mesh of another library."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces


def test_one_part_of_each_face_however_the_mesh_comes():
    mesh = l_shape()
    faces = [  # the quads that the triangles were fanned from
        (*mesh.triangles[2 * row], mesh.triangles[2 * row + 1, 2])
        for row in range(mesh.n_polygons)
    ]
    ways = [
        wcd.decompose(mesh, samples=300),
        wcd.decompose(mesh.vertices, np.array(faces), samples=300),
        wcd.decompose(Readable(mesh.vertices), Readable(faces), samples=300),
        wcd.decompose(mesh.vertices.tolist(), faces, samples=300),
        wcd.decompose(Trimesh(mesh.vertices, faces), samples=300),
    ]
    for found in ways:
        assert isinstance(found, wcd.Decomposition)
        assert found.labels.tolist() == ways[0].labels.tolist()
    assert ways[0].labels.shape == (mesh.n_polygons,)
    assert ways[0].n_parts == 2


def test_triangles_are_faces_of_their_own():
    mesh = dumbbell()
    named = SimpleNamespace(vertices=mesh.vertices, triangles=mesh.triangles)
    for shape in (Trimesh(mesh.vertices, mesh.triangles), named):
        found = wcd.decompose(shape, parts=3, samples=300)
        assert found.labels.shape == (len(mesh.triangles),)
        assert found.n_parts == 3


def test_vertices_without_faces_are_points():
    mesh = l_shape()
    points = mesh.vertices[mesh.triangles].mean(axis=1)
    found = wcd.measure(points, samples=100)
    for shape in (wcd.PointCloud(points), Cloud()):
        again = wcd.measure(shape, samples=100)
        assert (found.rank, found.n_samples) == (again.rank, again.n_samples)


def test_parameters_come_as_a_value_as_keywords_or_both():
    parameters = wcd.Parameters(parts=2, samples=300)
    both = wcd.decompose(VERTICES, FACES, parameters=parameters, parts=3)
    alone = wcd.decompose(VERTICES, FACES, parts=3, samples=300)
    assert both.psi == alone.psi
    assert parameters.parts == 2


def test_the_steps_give_what_the_functions_give():
    cache = wcd.ShapeCache(wcd.choose_ray_caster())
    steps = wcd.decompose_in_steps(l_shape(), wcd.Parameters(samples=300), cache)
    assert isinstance(next(steps), Progress)
    labels = wcd.run(steps).labels
    assert labels.tolist() == wcd.decompose(l_shape(), samples=300).labels.tolist()


def test_several_threads_find_the_parts_that_one_finds():
    def labels(seed):
        found = wcd.decompose(VERTICES, FACES, samples=100, seed=seed)
        return found.labels.tolist()

    with ThreadPoolExecutor(2) as workers:
        assert list(workers.map(labels, range(4))) == list(map(labels, range(4)))


def test_hulls_know_their_parts():
    mesh = l_shape()
    parts = wcd.decompose(mesh, samples=300)
    hulls = wcd.build_hulls(mesh, labels=parts.labels, pieces="PARTS", shape="BOX")
    assert isinstance(hulls, wcd.HullDecomposition)
    assert sorted(hulls.parts) == [0, 1]
    assert {shape.kind for shape in hulls.shapes} == {"BOX"}
    assert {shape.kind for shape in shaped({1: "SPHERE"}).shapes} == {"HULL", "SPHERE"}


def shaped(part_shapes, pieces="PARTS"):
    """Return hulls of two parts, which may have shapes of their own."""
    labels = [0] * 4 + [1] * 4
    return wcd.build_hulls(
        VERTICES, FACES, labels=labels, part_shapes=part_shapes, pieces=pieces
    )


@pytest.mark.parametrize(
    "call",
    [
        lambda tell: wcd.decompose(VERTICES, FACES, progress=tell, samples=300),
        lambda tell: wcd.measure(VERTICES, FACES, progress=tell, samples=300),
        lambda tell: wcd.build_hulls(VERTICES, FACES, progress=tell),
    ],
    ids=["decompose", "measure", "build_hulls"],
)
def test_progress_is_told_as_it_rises(call):
    told = []
    call(lambda stage, fraction: told.append((stage, fraction)))
    stages, fractions = zip(*told, strict=True)
    assert len(told) > 5
    assert all(type(stage) is str for stage in stages)
    assert all(type(fraction) is float for fraction in fractions)
    assert list(fractions) == sorted(fractions)
    assert fractions[0] < 0.1
    assert fractions[-1] == 1.0


def test_a_progress_that_raises_ends_the_work():
    def stop(stage, fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        wcd.measure(VERTICES, FACES, progress=stop)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: wcd.decompose("chair.obj"), "must be vertices with faces.* type str"),
        (lambda: wcd.decompose(None), "must be vertices with faces.* type NoneType"),
        (lambda: wcd.decompose([[0, 0, 0], [1]]), "rows of unequal lengths"),
        (lambda: wcd.decompose(VERTICES, 3), "`faces` must be rows .* type int"),
        (lambda: wcd.decompose(VERTICES, [1, 2, 3]), "Face 0 must be a list"),
        (lambda: wcd.decompose(VERTICES, ["abc"]), "Face 0 must be a list"),
        (lambda: wcd.decompose(VERTICES, [[0.0, 1.0, 2.0]]), "must be whole numbers"),
        (lambda: wcd.decompose(l_shape(), FACES), "The TriangleMesh is a shape"),
        (lambda: wcd.decompose(Trimesh(VERTICES, FACES), FACES), "is a shape already"),
        (lambda: wcd.decompose(VERTICES, FACES, part=3), "'part'; its .* parts, rays,"),
        (
            lambda: wcd.measure(VERTICES, FACES, k=3),
            r"measure\(\) got .* 'k'; its para",
        ),
        (
            lambda: wcd.build_hulls(VERTICES, FACES, hulls=3),
            "'hulls'; its .* max_hulls",
        ),
        (
            lambda: wcd.decompose(VERTICES, parameters={}),
            "must be a Parameters, not .* dict",
        ),
        (
            lambda: wcd.build_hulls(VERTICES, FACES, parameters=wcd.Parameters()),
            "must be a HullParameters, not .* Parameters",
        ),
        (
            lambda: wcd.build_hulls(VERTICES, FACES, labels=[0.5] * 8),
            "`labels` must be whole numbers",
        ),
        (lambda: shaped("ab"), "`part_shapes` must be a dict, .* type str"),
        (lambda: shaped([(0, "BOX")]), "`part_shapes` must be a dict, not a list"),
        (
            lambda: wcd.measure(VERTICES, FACES, caster=np.array([1, 2])),
            "`caster` must be one of BLENDER, EMBREE, not an array",
        ),
        (lambda: wcd.decompose(np.eye(3) > 0), r"not .* dtype bool and shape \(3, 3\)"),
        (lambda: wcd.decompose(np.array([None])), "not an array of dtype object"),
        (lambda: wcd.decompose(VERTICES, np.eye(3) + 0j), "Face 0 .* dtype complex128"),
        (
            lambda: wcd.measure(VERTICES, FACES, progress=5),
            "`progress` must be a function of stage and fraction, not .* type int",
        ),
    ],
)
def test_wrong_types_are_told_in_a_sentence(call, sentence):
    with pytest.raises(TypeError, match=sentence):
        call()


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: wcd.decompose([[0, 0], [1, 1]]), r"shape \(N, 3\), not \(2, 2\)"),
        (lambda: wcd.decompose(VERTICES, []), "has no faces"),
        (lambda: wcd.decompose(VERTICES, [[0, 1]]), "Face 0 has 2 corners"),
        (lambda: wcd.decompose(VERTICES, [[0, 1, 12]]), "missing vertices"),
        (lambda: wcd.decompose(VERTICES, [[0, 1, 2, 12]]), "missing vertices"),
        (lambda: wcd.decompose(VERTICES, [[0, 1, 2], [0, 1, 2, -1]]), "missing vertic"),
        (lambda: wcd.decompose(VERTICES), "too few points"),
        (lambda: wcd.decompose([(0, 0, np.nan)] * 3, [[0, 1, 2]]), "not finite"),
        (lambda: wcd.decompose(VERTICES, FACES, parts=1000), "Parts is 1000"),
        (lambda: wcd.build_hulls([(i, i * i, i**3) for i in range(20)]), "need faces"),
        (lambda: wcd.build_hulls(VERTICES, FACES, pieces="PARTS"), "pass `labels`"),
        (lambda: wcd.build_hulls(VERTICES, FACES, labels=[0, 1]), "must be 8 numbers"),
        (lambda: shaped({7: "BOX"}), "names part 7, which no face has"),
        (lambda: shaped({None: "BOX", "x": "BOX"}), "names part None, which no face"),
        (lambda: shaped({0: "BALL"}), "BALL"),
        (lambda: shaped({0: "BOX"}, pieces="BY_ERROR"), "need Pieces = PARTS"),
        (lambda: wcd.build_hulls(VERTICES, FACES, labels=[-1] * 8), "8 numbers from 0"),
        (
            lambda: wcd.build_hulls(
                VERTICES, FACES, labels=np.full(8, 2**63, dtype=np.uint64)
            ),
            "8 numbers from 0 to",
        ),
        (lambda: wcd.decompose(np.array(VERTICES) * 1e160, FACES), "has a diagonal of"),
    ],
)
def test_bad_values_are_told_in_a_sentence(call, sentence):
    with pytest.raises(wcd.DecompositionError, match=sentence):
        call()


def test_embree_finds_the_parts_that_blender_finds():
    mesh = dumbbell()
    ways = [
        wcd.decompose(mesh, samples=300, caster=caster) for caster in (None, "EMBREE")
    ]
    assert ways[0].labels.tolist() == ways[1].labels.tolist()
    ranks = [wcd.measure(mesh, samples=300, caster=c).rank for c in (None, "EMBREE")]
    assert ranks[0] == pytest.approx(ranks[1], abs=1e-3)


def test_a_caster_that_does_not_exist_is_refused():
    with pytest.raises(wcd.DecompositionError, match="choose one of BLENDER, EMBREE"):
        wcd.decompose(dumbbell(), caster="CUDA")
