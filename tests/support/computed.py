"""The core's computations, finished at once, with rays cast by the oracle."""

from dataclasses import replace

from brute_caster import BruteCaster
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.geometry.graphs.face_graph import face_graph
from weak_convex_decomposition.core.hulls import solid
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.measurement import measure_in_steps
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.find import find_parts
from weak_convex_decomposition.core.parts.part_count import PartCountSearch
from weak_convex_decomposition.core.parts.part_memo import PartMemo
from weak_convex_decomposition.core.parts.partition import Partitioner
from weak_convex_decomposition.core.parts.seams.cutter import SeamCutter
from weak_convex_decomposition.core.sight.prepared import prepare_in_steps
from weak_convex_decomposition.core.sight.ray_march import RayMarcher
from weak_convex_decomposition.core.sight.visibility import (
    find_lines_of_sight,
    see_in_steps,
)
from weak_convex_decomposition.core.solids.shells import find_shells, set_apart
from weak_convex_decomposition.core.steps.progress import run


def decompose(shape, parameters, members=None, make_caster=BruteCaster):
    """Return the decomposition of a shape, or of some of its faces."""
    cache = ShapeCache(make_caster)
    return run(decompose_in_steps(shape, parameters, cache, members))


def decomposer(shape):
    """Return a function from values of parameters to a shape's decomposition.

    What it has found serves the next values, too.
    """
    cache = ShapeCache(BruteCaster)
    return lambda **values: run(decompose_in_steps(shape, Parameters(**values), cache))


def split_up(mesh, **values):
    """Return the decomposition of a mesh, with few samples unless told otherwise."""
    values = {"samples": 150, "max_parts": 5, **values}
    return decompose(mesh, Parameters(**values))


def measure(shape, parameters, faces=None, make_caster=BruteCaster):
    """Return the measurement of a shape, or of some of its faces."""
    return run(measure_in_steps(shape, parameters, ShapeCache(make_caster), faces))


def build_hulls(shape, parameters, labels=None, seed=0):
    """Return the hulls of a mesh."""
    cache = ShapeCache(BruteCaster)
    return run(build_hulls_in_steps(shape, parameters, cache, labels, seed))


def solid_of(mesh):
    """Return the solid that hulls are fitted to."""
    return run(solid.solid_of(mesh, seed=0))


def normalized(mesh):
    """Return a mesh with a bounding box of diagonal 1."""
    return run(mesh.normalized_in_steps())


def prepare(shape, make_caster=BruteCaster):
    """Return a shape made ready."""
    return run(prepare_in_steps(shape, make_caster))


def see(shape, parameters, make_caster=BruteCaster):
    """Return the visibility of a shape, with nothing found from it."""
    return PartMemo(run(see_in_steps(prepare(shape, make_caster), parameters)))


def lines_of_sight(shape, parameters, make_caster=BruteCaster):
    """Return what the samples of a shape see through the inside alone."""
    return run(find_lines_of_sight(prepare(shape, make_caster), parameters))


def parts_of(memo, parameters):
    """Return the decomposition that a visibility gives."""
    return run(find_parts(memo, parameters))


def graph_of(mesh):
    """Return the graph of a mesh's polygons."""
    return run(face_graph(mesh))


def shells_of(mesh):
    """Return the shells of a mesh."""
    return run(find_shells(mesh))


def apart(mesh):
    """Return a mesh with the shells that touch set apart."""
    return run(set_apart(mesh, shells_of(mesh)))


def marcher_of(mesh):
    """Return what sends rays through a mesh as it is."""
    shells = shells_of(mesh)
    return RayMarcher(mesh, BruteCaster, shells.closed[shells.of_triangle])


def cut_seams_of(partitioner, parts):
    """Return parts of a partitioner with their seams cut."""
    return run(SeamCutter(partitioner).cut(parts)).parts


def part_count_search(memo, parameters, low, high):
    """Return a search for the number of parts."""
    parameters = replace(parameters, min_parts=low, max_parts=high)
    return PartCountSearch(Partitioner(memo, parameters))


def search_part_count(memo, parameters, low, high):
    """Return what the search for the number of parts finds, and its partitioner."""
    search = part_count_search(memo, parameters, low, high)
    return run(search.best()), search.partitioner
