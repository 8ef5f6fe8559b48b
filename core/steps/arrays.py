"""The types of arrays, by what is in them: the names that signatures use.

Docstrings tell the rest. "(N, 3) float" is N rows of three numbers, "(N,) int" are N
whole numbers, and "(N,) bool" is a mask: which of N things are meant. These have the
first three types below. An array of any other type is an `NDArray` of that.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

# Positions, directions, areas, weights. All is computed in double precision.
FloatArray: TypeAlias = NDArray[np.float64]

# Labels, rows of other arrays, numbers of faces and vertices.
IntArray: TypeAlias = NDArray[np.int64]

# Masks: which of the faces, samples or rows of another array.
BoolArray: TypeAlias = NDArray[np.bool_]

# What Blender has of positions, areas and colors; it takes no other type as quickly.
# Large matrices are like that, too, such as those of lines of sight and of winding
# numbers: they take half of the room.
Float32Array: TypeAlias = NDArray[np.float32]

# What Blender has of corners, edges and attributes of whole numbers.
Int32Array: TypeAlias = NDArray[np.int32]
