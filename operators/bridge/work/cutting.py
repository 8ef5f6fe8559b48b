"""Decompose an object from its whole faces, and cut them where parts meet on them."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.parameters.parts import Parameters
from ....core.results.parts import Decomposition
from ....core.steps.arrays import IntArray
from ....core.steps.progress import Progress, Steps, within
from ..cuts.cut_mesh import CutMesh
from ..cuts.new_faces import NewFaces, Pieces
from ..cuts.users_work import bound_modifier, sculpted_details
from ..cuts.whole_mesh import is_cut, whole_mesh_of
from ..mesh.attributes import vertex_positions
from ..parts.write import check_writable
from ..read.evaluated import SeenMesh
from ..read.reading_notes import reading_notes
from ..read.shape import read_mesh, stretch
from ..stored.restore import sharers
from .libraries import load_libraries
from .run_edit import Edited
from .session_cache import session_cache

# A cut that is this near to a corner runs through it, in longest edges of the refined
# mesh.
_NEAR = 0.5


def gets_new_faces(
    obj: bpy.types.Object, parameters: Parameters, seen: SeenMesh | None
) -> bool:
    """Return whether a run cuts faces of an object, or makes cut ones whole.

    Raises
    ------
    DecompositionError
        If faces are to be cut in Edit Mode, those of a mesh as it is seen, or those
        that sculpted details or modifiers are bound to.
    """
    cuts = parameters.seams == "CUT"
    if seen is not None and cuts:
        raise DecompositionError(
            "Only faces of the mesh itself are cut; choose Original for Mesh, or Keep"
            " Faces for Seams."
        )
    if seen is not None or obj.type != "MESH" or not obj.data.polygons:
        return False
    if not cuts:
        return is_cut(obj) and not obj.data.is_editmode
    _check_free_faces(obj)
    if obj.data.is_editmode:
        raise DecompositionError(
            "Faces are cut in Object Mode only; switch the mode, or choose Keep Faces"
            " for Seams."
        )
    return True


def _check_free_faces(obj: bpy.types.Object) -> None:
    """Raise if something is stored by the faces or vertices of an object's mesh."""
    for each in sharers(obj):
        if sculpted_details(each):
            raise DecompositionError(
                f"{each.name} has a Multires modifier, whose sculpted details cuts"
                " would spoil; apply it, or choose Keep Faces for Seams."
            )
    bound = bound_modifier(obj)
    if bound is not None:
        raise DecompositionError(
            f"The modifier {bound.name} of {bound.id_data.name} is bound to the faces"
            f" of {obj.name} as they are, and cuts would spoil that; apply it, or"
            " choose Keep Faces for Seams."
        )


def decompose_whole_faces(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[Edited]:
    """Return the steps that decompose an object from its whole faces.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    check_writable(obj)
    # Faces are cut of the mesh itself only: see `gets_new_faces`.
    notes = reading_notes(obj, has_choice=parameters.seams != "CUT")
    matrix, mesh = stretch(obj), whole_mesh_of(obj)
    shape, made = read_mesh(mesh, matrix), CutMesh(mesh, matrix)
    places = vertex_positions(mesh)

    def work() -> Steps[Edited]:
        yield from load_libraries()
        cache, refined = session_cache(), None
        if parameters.seams == "CUT":
            yield Progress("Surface", 0.0)
            refined = core.refined(shape)
        split = refined.mesh if refined else shape
        steps = core.decompose_in_steps(split, parameters, cache)
        found = yield from within(steps, 0.0, 0.98)
        pieces = None
        with made:
            if refined:
                found, pieces = yield from _cut(made, refined, found, parameters)
            faces = NewFaces(
                shape.n_polygons, places, made.wholes(), made.areas(), pieces
            )
        found = replace(found, notes=(*notes, *found.notes))
        return Edited(found, None, parameters, faces=faces)

    return work()


def _cut(
    made: CutMesh,
    refined: core.RefinedMesh,
    found: Decomposition,
    parameters: Parameters,
) -> Steps[tuple[Decomposition, Pieces | None]]:
    """Cut faces along the seams of parts that were found on a refined mesh.

    Return the parts of the faces, and how they are cut; None if no face is.
    """
    yield Progress("Seams", 1.0)
    n_wholes, near = len(made.wholes()), _NEAR * refined.size
    cuts = core.find_cuts(refined, found.labels)
    made.cut(cuts, near)
    of_pieces, of_polygons = core.labels_of_pieces(
        refined, found.labels, made.triangles(), made.wholes()
    )
    made.join(of_pieces.tolist())
    labels, triangles = made.parts(), made.triangles()
    areas = np.bincount(labels[triangles.polygons], triangles.areas, found.n_parts)
    # The largest part comes first. A part that got no piece is left out.
    order = np.argsort(-areas, kind="stable")
    order = order[np.isin(order, labels)]
    places = np.full(found.n_parts, -1)
    places[order] = np.arange(len(order))
    # Should joining pieces lose a part, its polygons are measured with the largest.
    measured = np.maximum(places[of_polygons], 0)
    after = replace(
        (yield from _measured(refined, measured, found, parameters)),
        labels=places[labels],
        areas=areas[order].astype(np.float64),
        pairs=found.pairs_at(places),
        notes=(*found.notes, *_notes_on_patches(found.n_parts - len(order))),
    )
    if parameters.levels != 1:  # each part was measured by samples of its own
        after = replace(after, ranks=found.ranks[order])
    if len(labels) == n_wholes:
        return after, None
    return after, Pieces(cuts, near, made.stretch, of_pieces)


def _notes_on_patches(n_left_out: int) -> tuple[str, ...]:
    """Return a note if parts were left out that are mere patches within faces."""
    if n_left_out == 0:
        return ()
    one = n_left_out == 1
    what = "1 part is a mere patch" if one else f"{n_left_out} parts are mere patches"
    return (
        f"{what} within a face, and left out, as faces are cut right across alone;"
        " subdivide the mesh to keep such parts.",
    )


def _measured(
    refined: core.RefinedMesh,
    labels: IntArray,
    found: Decomposition,
    parameters: Parameters,
) -> Steps[Decomposition]:
    """Return the figures of parts (Q,) after their seams were straightened."""
    if found.n_parts == 1:
        return found
    cache = session_cache()
    prepared = yield from cache.prepare(refined.mesh)
    memo = yield from cache.see(prepared, parameters)
    return core.describe(
        memo.visibility, labels, parameters, found.psi_by_k, found.best_k
    )
