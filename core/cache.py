"""What is kept of the latest shape, so that new parts of it take a moment."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import fields

from .geometry.shape import Shape, content_key
from .parameters.parameter import info_of
from .parameters.parts import Parameters
from .parts.part_memo import PartMemo
from .sight.prepared import PreparedShape, prepare_in_steps
from .sight.ray_march import MakeCaster
from .sight.visibility import see_in_steps
from .steps.progress import Steps


class ShapeCache:
    """The latest shape made ready, its visibility, and what was found from it.

    Whoever computes owns one. Shapes are told apart by content, so that no change of a
    mesh goes unnoticed. Results never depend on what is kept.

    Parameters
    ----------
    make_caster : callable
        Returns a `RayCaster` for the mesh it is given.
    """

    def __init__(self, make_caster: MakeCaster) -> None:
        self._make_caster = make_caster
        self.forget()

    def forget(self) -> None:
        """Free the memory."""
        self._shape: tuple[Hashable, PreparedShape] | None = None
        self._seen: tuple[Hashable, PartMemo] | None = None

    def prepare(self, shape: Shape) -> Steps[PreparedShape]:
        """Return a shape made ready: the latest one if it is the same."""
        key = content_key(shape)
        if self._shape is None or self._shape[0] != key:
            prepared = yield from prepare_in_steps(shape, self._make_caster)
            self._shape, self._seen = (key, prepared), None
        return self._shape[1]

    def see(self, shape: PreparedShape, parameters: Parameters) -> Steps[PartMemo]:
        """Return the visibility of a prepared shape, and what was found from it.

        The visibility of a part of the latest shape is computed, but not kept.
        """
        key = _sight_key(parameters)
        latest = self._shape is not None and self._shape[1] is shape
        if latest and self._seen is not None and self._seen[0] == key:
            return self._seen[1]
        memo = PartMemo((yield from see_in_steps(shape, parameters)))
        if latest:
            self._seen = key, memo
        return memo

    def has_seen(self, shape: Shape, parameters: Parameters) -> bool:
        """Return whether the visibility of a shape is there already."""
        if self._shape is None or self._seen is None:
            return False
        known = self._shape[0], self._seen[0]
        return known == (content_key(shape), _sight_key(parameters))


def _sight_key(parameters: Parameters) -> Hashable:
    """Return the values of the parameters that lines of sight depend on."""
    return tuple(
        getattr(parameters, field.name)
        for field in fields(parameters)
        if info_of(field).affects_sight
    )
