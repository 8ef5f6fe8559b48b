"""Builds hulls of the objects of a file, those of the next objects at the same time."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Sequence
from contextlib import suppress

import bpy

from ....core.errors import DecompositionError
from ....core.results.hulls import HullDecomposition
from ....core.steps.processes import Processes
from ....core.steps.progress import Steps
from ...bridge.work.computing_hulls import build_hulls_of
from ..request.options import Request

# Seconds of work before other processes start: they need a second to load.
_PATIENCE = 2.0
# Number of objects that are read ahead, as a multiple of the number of processes.
_AHEAD = 3


class HullsAhead:
    """Hulls of objects, asked for in their order.

    Once that has taken a while, other processes build those of the next objects. The
    hulls are the same.

    Parameters
    ----------
    objects : sequence of Object
        Those that get hulls. Of objects that share a mesh, only the first is built
        ahead.
    request : Request
    """

    def __init__(self, objects: Sequence[bpy.types.Object], request: Request) -> None:
        self._request = request
        firsts: dict[bpy.types.ID, bpy.types.Object] = {}
        for obj in objects:
            firsts.setdefault(obj.data, obj)
        self._coming = deque(firsts.values())
        self._begun: dict[bpy.types.Object, Steps[HullDecomposition]] = {}
        self._processes: Processes | None = None
        self._started = time.perf_counter()

    def steps_of(self, obj: bpy.types.Object) -> Steps[HullDecomposition]:
        """Return the steps that build the hulls of the next object.

        Raises
        ------
        DecompositionError
            If the object cannot be read or can have no hulls.
        """
        if self._coming and self._coming[0] == obj:
            self._coming.popleft()
        self._begin()
        if obj in self._begun:
            return self._begun.pop(obj)
        return self._build(obj)

    def close(self) -> None:
        """End the other processes."""
        if self._processes:
            self._processes.close()

    def _begin(self) -> None:
        """Begin the next objects in other processes, if there is much to do."""
        count = self._request.processes
        if self._processes is None:
            waited = time.perf_counter() - self._started
            if count < 2 or len(self._coming) < 2 or waited < _PATIENCE:
                return
            self._processes = Processes(count)
        while self._coming and len(self._begun) < _AHEAD * count:
            obj = self._coming.popleft()
            with suppress(DecompositionError):  # it comes again at the object's turn
                self._begun[obj] = self._build(obj)

    def _build(self, obj: bpy.types.Object) -> Steps[HullDecomposition]:
        """Return the steps that build the hulls of an object."""
        parameters = self._request.parameters
        wanted = self._request.hull_parameters
        return build_hulls_of(obj, parameters, wanted, processes=self._processes)
