"""What single points of a surface see, shown to the user (fig. 2 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.sampling import Samples, sample_surface
from ..parameters.parts import Parameters
from ..results.views import View
from ..steps.arrays import FloatArray
from ..steps.progress import Progress, Steps, run, within
from .lines import see_pairs
from .prepared import PreparedShape
from .viewpoints import Viewpoints, viewpoints


@dataclass(frozen=True, eq=False)
class PointViewer:
    """A shape with samples that can be looked at from any point of its surface.

    Attributes
    ----------
    shape : PreparedShape
        The shape, normalized.
    views : Viewpoints
        Those of N samples.
    notes : tuple of str
        Sentences to the user.
    """

    shape: PreparedShape
    views: Viewpoints
    notes: tuple[str, ...]

    def look(self, origin: FloatArray, direction: FloatArray) -> View | None:
        """Return the samples that the first surface point along a ray sees.

        Parameters
        ----------
        origin : (3,) float
            Start of the ray, in the space and units of the shape.
        direction : (3,) float
            Direction of the ray, of any length.

        Returns
        -------
        View or None
            In the space and units of the shape. None if the ray misses.
        """
        spot = self._first_point(
            (origin - self.shape.center) / self.shape.diagonal,
            direction / np.linalg.norm(direction),
        )
        if spot is None:
            return None
        samples, marcher = self.views.samples, self.views.marcher
        n_samples = len(samples)
        views = self.views.with_others(run(viewpoints(marcher, spot)))
        pairs = np.full(n_samples, n_samples), np.arange(n_samples)
        visible = run(see_pairs(views, *pairs))
        return View(
            self._in_units(spot.positions[0]),
            self._in_units(samples.positions),
            samples.normals,
            visible,
        )

    def _first_point(self, origin: FloatArray, direction: FloatArray) -> Samples | None:
        """Return the first surface point along a ray, as one sample, or None."""
        marcher = self.views.marcher
        # Ray casters work in single precision: start shortly before the shape.
        origin = origin + direction * max(-float(origin @ direction) - 1.0, 0.0)
        reach = np.linalg.norm(origin) + 1.0
        triangles, distances = marcher.first_hit(
            origin[None], direction[None], np.array([reach])
        )
        if triangles[0] >= 0:
            place = origin + distances[0] * direction
            return Samples(place[None], marcher.normals[triangles], triangles)
        if self.shape.plane is None:
            return None
        # Samples of a flat shape lie on its outline, which rays miss: take the sample
        # nearest to the ray.
        offsets = self.views.samples.positions - origin
        across = offsets - np.outer(offsets @ direction, direction)
        nearest = np.linalg.norm(across, axis=1).argmin(keepdims=True)
        return self.views.samples.at(nearest)

    def _in_units(self, positions: FloatArray) -> FloatArray:
        return positions * self.shape.diagonal + self.shape.center


def point_viewer_in_steps(
    shape: PreparedShape, parameters: Parameters
) -> Steps[PointViewer]:
    """Sample a shape and find the viewpoints, ready for `PointViewer.look`.

    Parameters
    ----------
    shape : PreparedShape
        The shape to look through.
    parameters : Parameters
        Only the number of samples and the seed are used.

    Returns
    -------
    Steps of PointViewer
    """
    yield Progress("Samples", 0.0)
    rng = np.random.default_rng(parameters.seed)
    samples = sample_surface(shape.targets, parameters.samples, rng)
    yield from within(shape.marcher.caster_in_steps(), 0.2, 0.8)
    views = yield from within(viewpoints(shape.marcher, samples), 0.8, 1.0)
    return PointViewer(shape, views, shape.notes)
