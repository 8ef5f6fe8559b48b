"""Bent limbs and rings that are kept whole, and what is kept apart."""

from dataclasses import replace

import changes
import flats
import numpy as np
import pytest
import shapes
from computed import decompose, graph_of, see
from definitions import agreement
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.merging.limbs import LimbMerger
from weak_convex_decomposition.core.parts.partition import Partitioner
from weak_convex_decomposition.core.steps.progress import run

CUT = Parameters(samples=150, max_parts=6)
KEEP = replace(CUT, bends="KEEP")


def tube(path, radius=0.25, closed=False, around=10):
    """Return a tube around points of the plane z = 0, with flat ends or closed."""
    path = np.asarray(path, dtype=float)
    n = len(path)
    ahead = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    if not closed:
        ahead[0], ahead[-1] = path[1] - path[0], path[-1] - path[-2]
    side = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    turns = np.linspace(0, 2 * np.pi, around, endpoint=False)[None, :, None]
    radii = np.broadcast_to(radius, n)[:, None, None]
    rings = path[:, None] + radii * np.cos(turns) * side[:, None]
    heights = np.broadcast_to(radii * np.sin(turns), (n, around, 1))
    vertices = np.concatenate([rings, heights], axis=2).reshape(-1, 3)
    faces = []
    for low in range(n if closed else n - 1):
        one, two = low * around, (low + 1) % n * around
        for s in range(around):
            t = (s + 1) % around
            faces.append((one + t, one + s, two + s, two + t))
    if not closed:
        faces += [range(around), range((n - 1) * around, n * around)[::-1]]
    return shapes.mesh_of(vertices, faces)


def arc(degrees, n=24):
    turns = np.radians(np.linspace(0, degrees, n, endpoint=degrees < 360))
    return np.stack([np.cos(turns), np.sin(turns)], axis=1)


def ring():
    return tube(arc(360), closed=True)


def horseshoe():
    return tube(arc(250), 0.2)


def banana():
    radii = 0.1 + 0.2 * np.sin(np.linspace(0.6, np.pi - 0.6, 36))
    return tube(arc(170, 36), radii)


def bent_arm():
    lengths = np.linspace(0, 1.5, 16)[:, None]
    upper, lower = lengths[::-1] * [-1, 0], lengths[1:] * [0.5, 0.75**0.5]
    return tube(np.concatenate([upper, lower]), 0.2)


def flat_horseshoe():
    outline = np.concatenate([1.3 * arc(250), 0.7 * arc(250)[::-1]])
    return flats.filled(outline, spacing=0.12)


LIMBS = {ring: 150, horseshoe: 150, banana: 150, bent_arm: 150, flat_horseshoe: 300}


@pytest.mark.parametrize("make", LIMBS)
def test_a_bent_limb_of_one_thickness_is_one_part(make):
    samples = LIMBS[make]
    assert decompose(make(), replace(CUT, samples=samples)).n_parts > 1
    kept = decompose(make(), replace(KEEP, samples=samples))
    assert kept.n_parts == kept.best_k == 1
    assert kept.psi == pytest.approx(kept.psi_before)


def snowman():
    """Return two balls of one size that meet in a crease."""
    turns = np.linspace(0.15, 0.78 * np.pi, 8)
    radii, heights = np.sin(turns), -np.cos(turns) - np.cos(0.22 * np.pi)
    radii = [0, *radii, *radii[-2::-1], 0]
    below, above = [heights[0], *heights], [*-heights[-2::-1], -heights[0]]
    return shapes.turned(np.array(radii), np.array([*below, *above]), 12)


def flat_t():
    stem = [(0.5, 0), (0.5, 3), (-0.5, 3), (-0.5, 0)]
    outline = np.array([(-3, -1), (3, -1), (3, 0), *stem, (-3, 0)], dtype=float)
    return flats.filled(outline, spacing=0.35)


APART = [shapes.dumbbell, shapes.plus, shapes.table, shapes.comb, snowman, flat_t]


@pytest.mark.parametrize("make", APART)
def test_creases_necks_and_junctions_divide(make):
    cut = decompose(make(), CUT)
    assert cut.n_parts > 1
    assert decompose(make(), KEEP).labels.tolist() == cut.labels.tolist()


def test_a_given_number_is_met_by_what_is_kept_whole():
    ball = shapes.sphere(1, 0.5, (1.1, -0.4, 0))
    mesh = shapes.joined(horseshoe(), ball)
    shells = (np.arange(mesh.n_polygons) >= horseshoe().n_polygons).astype(int)

    def share(parameters):
        found = decompose(mesh, replace(parameters, parts=2))
        assert found.n_parts == 2
        return agreement(found.labels, shells, graph_of(mesh).areas)

    assert share(CUT) < 0.9 < 0.95 < share(KEEP)


def test_bends_are_cut_where_a_given_number_asks_for_it():
    found = decompose(ring(), replace(KEEP, parts=3))
    assert (
        found.labels.tolist()
        == decompose(ring(), replace(CUT, parts=3)).labels.tolist()
    )
    assert (found.n_parts, found.best_k) == (3, 1)


HEIGHTS = np.linspace(-3, 3, 25)
# Radii along an axis, and whether what lies above and below its middle is one limb.
BARS = {
    "bar": (np.full(25, 0.6), True),
    "step": (np.where(HEIGHTS > 0, 0.57, 0.6), False),
    "waist": (0.6 - 0.3 * np.exp(-(HEIGHTS**2)), False),
    "taper": (0.6 + 0.1 * HEIGHTS, False),
}


@pytest.mark.parametrize("name", BARS)
def test_halves_of_a_bar_are_one_limb_where_nothing_ends(name):
    radii, whole = BARS[name]
    heights = np.where((name == "step") & (HEIGHTS == 0.25), 1e-3, HEIGHTS)
    mesh = shapes.turned([0, *radii, 0], [-3, *heights, 3], 16)
    partitioner = Partitioner(see(mesh, CUT), CUT)
    halves = (partitioner.graph.centers[:, 2] > 2e-3).astype(np.int64)
    merged = run(LimbMerger(partitioner).merge(halves))
    assert merged.tolist() == (0 * halves if whole else halves).tolist()


def paddle():
    """Return a handle and a blade as thick as it, three times as wide, in one plane."""
    mesh = shapes.blocks(
        (18, 16, 2), ((6, 12), (0, 8), (0, 2)), ((0, 18), (8, 16), (0, 2))
    )
    return mesh, (graph_of(mesh).centers[:, 1] > 8).astype(np.int64)


def junction():
    """Return a bar in three pieces, and a branch from the middle one."""
    mesh = shapes.blocks(
        (24, 8, 2), ((0, 24), (0, 2), (0, 2)), ((11, 13), (2, 8), (0, 2))
    )
    x, y, _ = graph_of(mesh).centers.T
    return mesh, np.where(y > 2, 3, np.digitize(x, [8, 16])).astype(np.int64)


def collar():
    """Return the two halves of a bar, with a thick block around all but one side."""
    mesh = shapes.blocks(
        (24, 9, 7), ((0, 24), (3, 6), (0, 3)), ((8, 16), (0, 9), (0, 7))
    )
    x, y, z = graph_of(mesh).centers.T
    below = (z == 0) & (abs(y - 4.5) < 1.5)
    bar = below | (x < 8) | (x > 16)
    return mesh, np.where(bar, x > 12, 2).astype(np.int64)


@pytest.mark.parametrize("make", [paddle, junction, collar])
def test_parts_that_widen_branch_or_meet_beside_a_third_stay(make):
    mesh, parts = make()
    merged = run(LimbMerger(Partitioner(see(mesh, CUT), CUT)).merge(parts))
    assert len(set(merged)) == len(set(parts))


@pytest.mark.parametrize("seed", range(3))
def test_more_parts_than_asked_for_are_no_reason_to_cut_bends(seed):
    """The best parts are more than two once bends are kept; later ones are two."""
    rods = [
        changes.moved(
            shapes.box((1.1, -0.12, -0.12), (end, 0.12, 0.12), 4),
            rotation=np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
        )
        for end, turn in ((3.1, 0.2), (2.1, 0.2 + np.pi))
        for c, s in [(np.cos(turn), np.sin(turn))]
    ]
    whole = tube(arc(360, 32), closed=True, around=12)
    mesh = shapes.joined(whole, *rods)
    kept = Parameters(samples=600, parts=2, bends="KEEP", seed=seed)
    found, cut = (decompose(mesh, p) for p in (kept, replace(kept, bends="CUT")))
    assert found.n_parts == cut.n_parts == 2
    halves = np.bincount(cut.labels[: whole.n_polygons])
    assert np.ptp(halves) < 0.2 * whole.n_polygons  # they end at bends
    assert len(set(found.labels[: whole.n_polygons])) == 1
