"""An object whose faces are worth cutting."""

import pytest
from hand_made import mesh_object

OUTLINE = [(1, 1), (1, 4), (0, 4), (0, 0), (4, 0), (4, 1)]


@pytest.fixture
def angle():
    """An L with two caps of six corners."""
    walls = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    places = [(x, y, z) for z in (0, 1) for x, y in OUTLINE]
    return mesh_object("L", places, [range(6, 12), range(5, -1, -1), *walls])
