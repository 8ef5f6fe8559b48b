"""A cache of the latest shape, for other parameters, and of results of small shapes."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import fields
from functools import partial
from hashlib import blake2b
from typing import Any, NoReturn

from .geometry.array_checks import described
from .geometry.mesh import TriangleMesh
from .geometry.shape import Shape, are_equal, digest_of, size_of
from .parameters.parameter import info_of
from .parameters.parts import Parameters
from .parts.find import find_parts
from .parts.part_memo import PartMemo
from .results.parts import Decomposition
from .sight.prepared import PreparedShape, prepare_in_steps
from .sight.ray_caster import MakeCaster
from .sight.visibility import see_in_steps
from .steps.memo import Memo
from .steps.progress import Steps, T

# The visibility of so many parts is kept, if they took at most so many samples.
_DETAILS = 24
_FEW_SAMPLES = 500
# Results are kept of shapes that are made of so many numbers at most.
_SMALL = 500_000


def no_rays(_: TriangleMesh) -> NoReturn:
    """Make no ray caster: for computations that need none, as hulls by error.

    Raises
    ------
    RuntimeError
    """
    raise RuntimeError("there is no ray caster in this process")


class ShapeCache:
    """Keeps the latest prepared shape, its visibility, and the parts found from it.

    The caller owns the cache. Shapes are compared by content, so a changed mesh is
    always prepared again. Results do not depend on what is in the cache.

    Parameters
    ----------
    make_caster : callable
        Takes a `TriangleMesh` and returns a `RayCaster` for it.
    n_results : int, optional
        Most results of small shapes that are kept. Files have many objects of one
        shape, each with a mesh of its own.

    Raises
    ------
    TypeError
        If `make_caster` cannot be called.

    Examples
    --------
    >>> import weak_convex_decomposition as wcd
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> mesh = wcd.TriangleMesh(vertices, triangles, [0, 1, 2, 3])
    >>> cache = wcd.ShapeCache(wcd.choose_ray_caster())
    >>> one = wcd.run(wcd.decompose_in_steps(mesh, wcd.Parameters(parts=1), cache))
    >>> two = wcd.run(wcd.decompose_in_steps(mesh, wcd.Parameters(parts=2), cache))
    >>> one.n_parts, two.n_parts
    (1, 2)
    """

    def __init__(self, make_caster: MakeCaster, n_results: int = 0) -> None:
        if not callable(make_caster):
            raise TypeError(
                "`make_caster` must be a class of ray casters, as `choose_ray_caster()`"
                f" returns, not {described(make_caster)}."
            )
        self._make_caster, self._n_results = make_caster, n_results
        self.forget()

    def forget(self) -> None:
        """Empty the cache, and so free its memory."""
        self._results: Memo[Hashable, Any] = Memo(self._n_results)
        self._forget_latest()

    def _forget_latest(self) -> None:
        """Forget the latest shape and all that was seen of it."""
        self._shape: tuple[Shape, PreparedShape] | None = None
        self._seen: Memo[Hashable, PartMemo] = Memo(1)
        self._details: Memo[Hashable, PartMemo] = Memo(_DETAILS)

    def recall(
        self, shape: Shape, key: Hashable, make: Callable[[], Steps[T]]
    ) -> Steps[T]:
        """Return a result of a shape; that of an earlier, equal one if it is kept.

        A result that was kept does not make its shape the latest.

        Parameters
        ----------
        shape : TriangleMesh or PointCloud
        key : hashable
            What is asked for, and all else that it depends on.
        make : callable
            Returns the steps that compute the result.

        Returns
        -------
        Steps of the result
        """
        if self._n_results == 0 or size_of(shape) > _SMALL:
            return make()
        return self._results.recall_steps((digest_of(shape), key), make)

    def prepare(self, shape: Shape) -> Steps[PreparedShape]:
        """Return the shape made ready for rays; the cached one if its content is equal.

        Parameters
        ----------
        shape : TriangleMesh or PointCloud
            In any units.

        Returns
        -------
        Steps of PreparedShape

        Raises
        ------
        DecompositionError
            If the surface has no area, or is too large or too small to compute with.
        """
        if self._shape is None or not are_equal(self._shape[0], shape):
            prepared = yield from prepare_in_steps(shape, self._make_caster)
            self._forget_latest()
            self._shape = shape, prepared
        return self._shape[1]

    def see(self, shape: PreparedShape, parameters: Parameters) -> Steps[PartMemo]:
        """Return the visibility of a prepared shape, with the parts found from it.

        The visibility of the latest whole shape is kept, and of parts of it that took
        few samples.

        Parameters
        ----------
        shape : PreparedShape
        parameters : Parameters
            Settings that affect neither samples nor lines of sight are not used.

        Returns
        -------
        Steps of PartMemo

        Raises
        ------
        DecompositionError
            If no sample can be placed, or if faces are the samples and there are too
            many.
        """
        key, make = _sight_key(parameters), partial(_seen, shape, parameters)
        if self._shape is None or self._shape[1].marcher is not shape.marcher:
            return make()
        if self._shape[1] is shape:
            return self._seen.recall_steps(key, make)
        if parameters.samples > _FEW_SAMPLES:
            return make()
        return self._details.recall_steps((_digest_of_part(shape), key), make)

    def find_ahead(
        self, parameters: Parameters, rough: bool = False
    ) -> Steps[Decomposition] | None:
        """Return steps that find parts which may be asked for later.

        Parameters
        ----------
        parameters : Parameters
        rough : bool, optional
            Whether a first look at the parts is enough.

        Returns
        -------
        Steps of Decomposition, or None
            What they compute is kept with the visibility of the latest shape. None if
            no visibility is kept that was computed with these parameters.
        """
        key = _sight_key(parameters)
        if key not in self._seen:
            return None
        return find_parts(self._seen[key], parameters, rough)


def _seen(shape: PreparedShape, parameters: Parameters) -> Steps[PartMemo]:
    """Return the visibility of a shape."""
    return PartMemo((yield from see_in_steps(shape, parameters)))


def _digest_of_part(part: PreparedShape) -> bytes:
    """Return a digest of which faces or points of the whole shape a part has.

    Points of a cloud that are close share a splat, so splats alone do not tell.
    """
    found = blake2b(part.targets.polygons.data)
    found.update(part.nodes.data)
    return found.digest()


def _sight_key(parameters: Parameters) -> Hashable:
    """Return the values of the parameters that samples or lines of sight depend on."""
    return tuple(
        getattr(parameters, field.name)
        for field in fields(parameters)
        if info_of(field).affects_sight
    )
