"""What single points of a surface see, for people to look at (fig. 2 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..geometry.sampling import Samples, sample_surface
from ..parameters.parts import Parameters
from ..steps.progress import Progress, Steps, run, within
from .lines import Viewpoints, see_pairs, viewpoints
from .prepared import Form, Shape, form_of
from .ray_march import MakeCaster, RayMarcher

Rows = TypeVar("Rows", Samples, Viewpoints)


@dataclass(frozen=True, eq=False)
class View:
    """What a point of a surface sees. Lengths are in the units of the shape.

    Attributes
    ----------
    point : (3,) float
    places : (N, 3) float
        Samples of the surface.
    normals : (N, 3) float
        Outward unit vectors.
    visible : (N,) bool
        Which samples are in line of sight of the point.
    """

    point: NDArray[np.float64]
    places: NDArray[np.float64]
    normals: NDArray[np.float64]
    visible: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class PointViewer:
    """A shape with samples, ready to tell what any of its points sees.

    Attributes
    ----------
    form : Form
    samples : Samples
    scene : RayMarcher
    views : Viewpoints
        Of the samples.
    center : (3,) float
        Of the shape, in its units.
    diagonal : float
        Of the shape, in its units.
    notes : tuple of str
        Sentences to the user about what is worth knowing.
    """

    form: Form
    samples: Samples
    scene: RayMarcher
    views: Viewpoints
    center: NDArray[np.float64]
    diagonal: float
    notes: tuple[str, ...]

    def look(
        self, origin: NDArray[np.float64], direction: NDArray[np.float64]
    ) -> View | None:
        """Return what the first point along a ray sees, None if the ray misses.

        Parameters
        ----------
        origin, direction : (3,) float
            In the units of the shape; `direction` of any length.
        """
        spot = self._spot(
            (origin - self.center) / self.diagonal,
            direction / np.linalg.norm(direction),
        )
        if spot is None:
            return None
        n_samples = len(self.samples)
        visible = run(
            see_pairs(
                self.scene,
                _joined(self.samples, spot),
                _joined(self.views, viewpoints(self.scene, spot)),
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

    def _spot(
        self, origin: NDArray[np.float64], direction: NDArray[np.float64]
    ) -> Samples | None:
        """Return the first point along a ray, as a sample."""
        reach = np.linalg.norm(origin) + 1.0
        triangles, distances = self.scene.caster.first_hit(
            origin[None], direction[None], np.array([reach])
        )
        if triangles[0] >= 0:
            place = origin + distances[0] * direction
            return Samples(place[None], self.scene.normals[triangles], triangles)
        if self.form.plane is None:
            return None
        # Flat shapes are their outlines, which no ray meets: the nearest sample.
        offsets = self.samples.positions - origin
        across = offsets - np.outer(offsets @ direction, direction)
        nearest = [np.linalg.norm(across, axis=1).argmin()]
        chosen = (getattr(self.samples, each.name) for each in fields(Samples))
        return Samples(*(values[nearest] for values in chosen))

    def _in_units(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        return positions * self.diagonal + self.center


def _joined(rows: Rows, more: Rows) -> Rows:
    """Return samples, or viewpoints, with more of them behind."""
    names = [each.name for each in fields(rows)]
    pairs = [(getattr(rows, name), getattr(more, name)) for name in names]
    return type(rows)(*map(np.concatenate, pairs))


def make_point_viewer(
    shape: Shape, parameters: Parameters, make_caster: MakeCaster
) -> Steps[PointViewer]:
    """Make a shape ready to tell what its points see.

    Parameters and errors are those of `visibility.look`; of the parameters only the
    number of samples and the seed matter.
    """
    form = yield from within(form_of(shape), 0.0, 0.4)
    yield Progress("Samples", 0.4)
    rng = np.random.default_rng(parameters.seed)
    samples = sample_surface(form.targets, parameters.samples, rng)
    yield Progress("Ray tree", 0.5)
    scene = RayMarcher(form.targets, make_caster(form.targets), form.grain, form.tilt)
    yield Progress("Lines of sight", 0.9)
    views = viewpoints(scene, samples)
    return PointViewer(
        form, samples, scene, views, shape.center, shape.diagonal, form.notes
    )
