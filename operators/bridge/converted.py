"""Objects with parts or hulls that the user converted to a curve or the like.

The curve is the user's. What is left of ours is the record, the rows of the table, the
hulls and the pictures.
"""

from __future__ import annotations

from typing import Any

from .hulls.hull_objects import erase_hulls
from .parts.materials import discard_unused, our_materials
from .parts.rows import erase_rows
from .read.carrier import clear_carrier
from .refusals import WORKED_ON
from .stored.names import CARRIER_TAG
from .stored.record import forget_result, record_if_ours
from .views.images import erase_images


def was_converted(obj: Any) -> bool:
    """Return whether an object has a record of ours that is not of its present type."""
    if obj is None or obj.type in WORKED_ON:
        return False
    return bool(record_if_ours(obj))


def clear_converted(obj: Any) -> None:
    """Remove what is left of ours from such an object, and from the file."""
    erase_hulls(obj)
    erase_images(obj)
    erase_rows(obj)
    discard_unused(our_materials())
    forget_result(obj)
    if CARRIER_TAG in obj:
        clear_carrier(obj)
