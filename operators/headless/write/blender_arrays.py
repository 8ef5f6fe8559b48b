"""NumPy arrays from and to the elements and attributes of Blender's meshes."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float32]
IntArray = NDArray[np.int32]


def read_ints(elements: bpy.types.bpy_prop_collection, field: str) -> IntArray:
    """Return one whole number of each element, (N,)."""
    values = np.empty(len(elements), dtype=np.int32)
    elements.foreach_get(field, values)
    return values


def read_vectors(
    elements: bpy.types.bpy_prop_collection, field: str, width: int
) -> FloatArray:
    """Return a vector of each element, (N, width)."""
    values = np.empty(len(elements) * width, dtype=np.float32)
    elements.foreach_get(field, values)
    return values.reshape(-1, width)


def fill(
    elements: bpy.types.bpy_prop_collection, field: str, values: NDArray[Any]
) -> None:
    """Write a number or a vector to each element; (N,) or (N, width).

    Anything but float32 and int32 is converted value by value, 20 times slower.
    """
    kind = np.float32 if values.dtype.kind == "f" else np.int32
    elements.foreach_set(field, values.astype(kind).ravel())


def read_labels(
    data: bpy.types.ID, name: str, domain: str, n_rows: int, missing: int = -1
) -> IntArray:
    """Return an integer attribute, (n_rows,); `missing` everywhere if there is none.

    Parameters
    ----------
    data : Mesh or PointCloud
    name : str
    domain : {'FACE', 'POINT'}
        An attribute of another domain does not count.
    n_rows : int
        Number of faces or points.
    missing : int, optional
    """
    attribute = data.attributes.get(name)
    if attribute is None or attribute.domain != domain:
        return np.full(n_rows, missing, dtype=np.int32)
    return read_ints(attribute.data, "value")
