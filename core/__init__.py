"""The algorithm, without Blender: it needs NumPy, SciPy and scikit-learn.

Each name below imports its module when it is first used. SciPy and scikit-learn take a
second to import, and enabling the add-on must not wait for them.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import missing_library

if TYPE_CHECKING:
    from .cache import ShapeCache as ShapeCache
    from .cache import no_rays as no_rays
    from .clouds.splats import thinned_splats as thinned_splats
    from .decomposition import decompose_in_steps as decompose_in_steps
    from .geometry.cutting.piece_labels import labels_by_area as labels_by_area
    from .geometry.cutting.piece_labels import labels_of_pieces as labels_of_pieces
    from .geometry.cutting.planes import find_cuts as find_cuts
    from .geometry.cutting.refined import RefinedMesh as RefinedMesh
    from .geometry.cutting.refined import refined as refined
    from .hulls.build import build_hulls_in_steps as build_hulls_in_steps
    from .hulls.outline import faces_of as faces_of
    from .hulls.outline import outline_of as outline_of
    from .hulls.refit import refit_in_steps as refit_in_steps
    from .measurement import measure_in_steps as measure_in_steps
    from .parts.describe import describe as describe
    from .parts.describe import notes_on_count as notes_on_count
    from .parts.editing import Change as Change
    from .parts.editing import compacted as compacted
    from .parts.editing import give as give
    from .parts.editing import mirror as mirror
    from .parts.matching import given_back as given_back
    from .parts.matching import match_parts as match_parts
    from .parts.pairs import mirror_pairs as mirror_pairs
    from .parts.part_memo import PartMemo as PartMemo
    from .parts.seams.smoothing import smooth_seams as smooth_seams
    from .pictures import draw_picture as draw_picture
    from .sight.point_view import PointViewer as PointViewer
    from .sight.point_view import point_viewer_in_steps as point_viewer_in_steps
    from .solids.mass import mass_of_mesh as mass_of_mesh
    from .solids.mass import mass_of_surface as mass_of_surface

_NAMES = {
    "cache": ("ShapeCache", "no_rays"),
    "clouds.splats": ("thinned_splats",),
    "decomposition": ("decompose_in_steps",),
    "geometry.cutting.piece_labels": ("labels_of_pieces", "labels_by_area"),
    "geometry.cutting.planes": ("find_cuts",),
    "geometry.cutting.refined": ("RefinedMesh", "refined"),
    "hulls.build": ("build_hulls_in_steps",),
    "hulls.refit": ("refit_in_steps",),
    "hulls.outline": ("faces_of", "outline_of"),
    "solids.mass": ("mass_of_mesh", "mass_of_surface"),
    "measurement": ("measure_in_steps",),
    "parts.editing": ("Change", "compacted", "give", "mirror"),
    "parts.matching": ("match_parts", "given_back"),
    "parts.describe": ("describe", "notes_on_count"),
    "parts.pairs": ("mirror_pairs",),
    "parts.part_memo": ("PartMemo",),
    "parts.seams.smoothing": ("smooth_seams",),
    "pictures": ("draw_picture",),
    "sight.point_view": ("PointViewer", "point_viewer_in_steps"),
}
_HOMES = {name: home for home, names in _NAMES.items() for name in names}
# The modules, to be imported one at a time.
MODULES = tuple(f"{__name__}.{home}" for home in _NAMES)


def __getattr__(name: str) -> Any:
    """Import the module that defines `name`, and return the object of that name.

    A library that is missing is an error for the user, as in Blender from pip.
    """
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        module = import_module(f".{_HOMES[name]}", __name__)
    except ImportError as error:
        raise missing_library(error) from error
    value = getattr(module, name)
    globals()[name] = value
    return value
