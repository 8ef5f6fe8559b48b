"""The stages that can be switched off, and what is not on by default."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any
from unittest import mock

import numpy as np
from weak_convex_decomposition.core.clusters.embedding import embed
from weak_convex_decomposition.core.parameters.presets import preset
from weak_convex_decomposition.core.parts import (
    part_count,
    part_memo,
    part_psi,
    partition,
)
from weak_convex_decomposition.core.parts.details import levels
from weak_convex_decomposition.core.parts.merging.creases import CreaseParts
from weak_convex_decomposition.core.sight import visibility
from weak_convex_decomposition.core.sight.pair_visibility import PairVisibility


def of_equal_length(embedding: np.ndarray) -> np.ndarray:
    """Return the embedding with eigenvectors that are not scaled by eigenvalues."""
    lengths = np.linalg.norm(embedding, axis=0)
    return embedding / lengths * np.sqrt(len(embedding))


def by_sight_alone(pairs: PairVisibility, _positions: np.ndarray) -> Iterator[None]:
    """Return, as steps, lines of sight in place of likely pairs."""
    yield from ()
    return pairs


def no_sides(*_: object) -> Iterator[None]:
    """Return, as steps, that a shape has no mirror plane."""
    yield from ()
    return ()


def nothing_cut(_memo: object, found: object, _parameters: object) -> Iterator[None]:
    """Return, as steps, parts without a look for spikes, knees and necks."""
    yield from ()
    return found


better = CreaseParts.better


def without_parts_of_auto(by: CreaseParts, *given: Any) -> np.ndarray:
    """Return the best parts of a given number, but for those that Auto's make."""
    return better(by, *given[:3])


FULL = "full"
CONE = {"sight": "CONE", "samples": 3000}
# What each line changes of the parameters.
CHANGES: dict[str, dict[str, object]] = {
    FULL: {},
    "all pairs of samples": {"sight": "ALL_PAIRS"},
    "cone sight": CONE,
    "cone sight, psi from ray hits": {**CONE, "psi_pairs": "RAYS"},
    "containers hollow": {"containers": "HOLLOW"},
    "balance alpha = 1": {"alpha": 1.0},
    "eigenvectors of equal length": {},
    "no likely pairs": {},
    "no loops of creases": {},
    "no psi-raising moves": {},
    "no psi in moves and seams": {"refinement": "EMBEDDING"},
    "no graph cut": {"smoothness": 0.0},
    "no symmetry": {},
    "no tolerance in the search for k": {},
    "bends kept": {"bends": "KEEP"},
    "no details": {"levels": 1},
    "no spikes, knees and necks": {},
    "Auto's parts do not compete": {},
    "two levels": {"levels": 2},
    "preset of the paper": preset("PAPER").changes,
}
# What lines replace in the code, where no parameter does: module, name, replacement.
PATCHES: dict[str, Sequence[tuple[Any, str, Any]]] = {
    "eigenvectors of equal length": [
        (part_memo, "embed", lambda *given: of_equal_length(embed(*given)))
    ],
    "no likely pairs": [(visibility, "likely_pairs", by_sight_alone)],
    "no loops of creases": [(CreaseParts, "better", lambda _, parts, *__: parts)],
    "no spikes, knees and necks": [(levels, "cut_joints", nothing_cut)],
    "Auto's parts do not compete": [(CreaseParts, "better", without_parts_of_auto)],
    "no psi-raising moves": [
        (partition, "raise_psi", lambda _pairs, labels, *_: labels)
    ],
    "no tolerance in the search for k": [
        (part_psi, "_NEGLIGIBLE", 0.0),
        (part_count, "_GAIN_TOLERANCE", 0.0),
        (part_count, "_WIDE_TOLERANCE", 0.0),
    ],
    "no symmetry": [(part_memo, "find_sides", no_sides)],
}


@contextmanager
def patched(replacements: Sequence[tuple[Any, str, Any]]) -> Iterator[None]:
    """Put replacements in the place of what modules have under a name."""
    with ExitStack() as stack:
        for module, name, replacement in replacements:
            stack.enter_context(mock.patch.object(module, name, replacement))
        yield
