"""What parts that are written continue: the parts that an object had before."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import bpy
import numpy as np

from .... import core
from ....core.results.parts import Decomposition
from ..cuts.new_faces import NewFaces
from ..mesh.by_label import ByLabel, areas_of
from ..stored.identity import Identity
from ..stored.restore import sharers
from .identities import identities_of_run
from .part_materials import part_materials
from .read import FoundParts, find_parts_on, materials_of
from .rows import Row, kept_rows


@dataclass(frozen=True, eq=False)
class BeforeWriting:
    """What an object has of parts before others are written.

    Attributes
    ----------
    found : FoundParts or None
        The parts on its faces, None if there are none.
    rows : mapping of str to rows
        The rows of all objects that share the mesh, by name.
    materials : mapping of int to bpy.types.Material
        The material of each part, by its number.
    """

    found: FoundParts | None
    rows: Mapping[str, dict[int, Row]]
    materials: Mapping[int, bpy.types.Material | None]

    @classmethod
    def of(cls, obj: bpy.types.Object) -> BeforeWriting:
        """Return what an object has of parts."""
        found = find_parts_on(obj)
        materials: dict[int, bpy.types.Material | None] = {}
        materials |= {n: first for n, (first, *_) in part_materials(obj).items()}
        if found is not None:
            numbers = [each.number for each in found.identities]
            materials |= zip(numbers, materials_of(obj, found), strict=True)
        rows = {each.name: kept_rows(each) for each in sharers(obj)}
        return cls(found, rows, materials)

    def continued_by(
        self,
        obj: bpy.types.Object,
        decomposition: Decomposition,
        faces: NewFaces | None,
    ) -> tuple[Identity, ...]:
        """Return who the parts of a new run are, by the area shared with those here.

        `faces` are those that the object is going to get.
        """
        former: list[Identity | None] = [None] * decomposition.n_parts
        before: tuple[Identity, ...] = ()
        if self.found is not None:
            before = self.found.identities
            labels = self.found.labels
            if faces is None:
                areas = areas_of(obj, len(decomposition.labels))
            else:
                labels, areas = faces.former_labels(obj, labels), faces.areas
            places = core.match_parts(labels, decomposition.labels, areas)
            former = [before[place] if place >= 0 else None for place in places]
        return identities_of_run(former, before, decomposition.pairs)


def by_number(
    obj: bpy.types.Object,
    parts: Decomposition,
    identities: Sequence[Identity],
) -> tuple[Decomposition, ByLabel, list[Identity]]:
    """Return parts, what they have on the object, and who they are, by number."""
    by_label = ByLabel.of(obj, parts.labels, parts.n_parts)
    order = np.argsort([each.number for each in identities])
    places = np.argsort(order)
    ordered = replace(
        parts,
        labels=places[parts.labels],
        areas=parts.areas[order],
        ranks=parts.ranks[order],
        pairs=parts.pairs_at(places),
    )
    return ordered, by_label.in_order(order), [identities[row] for row in order]
