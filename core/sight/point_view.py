"""What single points of a surface see, for people to look at (fig. 2 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..geometry.sampling import Samples, sample_surface
from ..parameters.parts import Parameters
from ..results import View
from ..steps.progress import Progress, Steps, run
from .lines import Viewpoints, see_pairs, viewpoints
from .prepared import PreparedShape

Rows = TypeVar("Rows", Samples, Viewpoints)


@dataclass(frozen=True, eq=False)
class PointViewer:
    """A shape with samples, ready to tell what any of its points sees.

    Attributes
    ----------
    shape : PreparedShape
    samples : Samples
    views : Viewpoints
        Of the samples.
    notes : tuple of str
        Sentences to the user.
    """

    shape: PreparedShape
    samples: Samples
    views: Viewpoints
    notes: tuple[str, ...]

    def look(
        self, origin: NDArray[np.float64], direction: NDArray[np.float64]
    ) -> View | None:
        """Return what the first point along a ray sees, None if the ray misses.

        Parameters
        ----------
        origin, direction : (3,) float
            In the units of the shape. `direction` may have any length.
        """
        spot = self._first_point(
            (origin - self.shape.center) / self.shape.diagonal,
            direction / np.linalg.norm(direction),
        )
        if spot is None:
            return None
        n_samples, marcher = len(self.samples), self.shape.marcher
        visible = run(
            see_pairs(
                marcher,
                _joined(self.samples, spot),
                _joined(self.views, viewpoints(marcher, spot)),
                np.full(n_samples, n_samples),
                np.arange(n_samples),
            )
        )
        return View(
            self._in_units(spot.positions[0]),
            self._in_units(self.samples.positions),
            self.samples.normals,
            visible,
        )

    def _first_point(
        self, origin: NDArray[np.float64], direction: NDArray[np.float64]
    ) -> Samples | None:
        """Return the first point along a ray, as a sample."""
        marcher = self.shape.marcher
        reach = np.linalg.norm(origin) + 1.0
        triangles, distances = marcher.caster.first_hit(
            origin[None], direction[None], np.array([reach])
        )
        if triangles[0] >= 0:
            place = origin + distances[0] * direction
            return Samples(place[None], marcher.normals[triangles], triangles)
        if self.shape.plane is None:
            return None
        # A flat shape is its outline, which no ray meets: take the nearest sample.
        offsets = self.samples.positions - origin
        across = offsets - np.outer(offsets @ direction, direction)
        nearest = [np.linalg.norm(across, axis=1).argmin()]
        chosen = (getattr(self.samples, field.name) for field in fields(Samples))
        return Samples(*(values[nearest] for values in chosen))

    def _in_units(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        return positions * self.shape.diagonal + self.shape.center


def _joined(rows: Rows, more: Rows) -> Rows:
    """Return samples, or viewpoints, with more of them behind."""
    names = [field.name for field in fields(rows)]
    pairs = [(getattr(rows, name), getattr(more, name)) for name in names]
    return type(rows)(*map(np.concatenate, pairs))


def point_viewer_in_steps(
    shape: PreparedShape, parameters: Parameters
) -> Steps[PointViewer]:
    """Make a shape ready to tell what its points see.

    Parameters
    ----------
    shape : PreparedShape
    parameters : Parameters
        The number of samples and the seed count alone.
    """
    yield Progress("Samples", 0.0)
    rng = np.random.default_rng(parameters.seed)
    samples = sample_surface(shape.targets, parameters.samples, rng)
    yield Progress("Ray tree", 0.2)
    _ = shape.marcher.caster
    yield Progress("Lines of sight", 0.8)
    return PointViewer(shape, samples, viewpoints(shape.marcher, samples), shape.notes)
