"""Tells by known lines of sight whether parts come apart where their surface shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ...sight.pair_tally import PairTally
from ...steps.arrays import BoolArray, IntArray
from ..part_memo import PartMemo
from .limb import Joints

Count: TypeAlias = Callable[[IntArray, int], PairTally]

# What is left of a part without its spikes sees at least so much of itself: a wing of
# feathers has no spikes.
_LEAST_BODY = 0.8
# Fewer samples of a spike say nothing. Where not all pairs are known, it needs as many
# known pairs as so many samples have.
_FEWEST_SAMPLES = 10


class Demands(NamedTuple):
    """What lines of sight have to say of the two pieces beside a joint.

    Attributes
    ----------
    least_rank : float
        Least share of the pairs within a piece that see each other.
    most_seen : float
        The share of the pairs across the joint that do is below this.
    fewest_samples : int
        A piece with fewer pairs than so many have says nothing.
    """

    least_rank: float
    most_seen: float
    fewest_samples: int


def count_pairs(
    memo: PartMemo, kept: IntArray, labels: IntArray, n_labels: int
) -> PairTally:
    """Count pairs of samples by labels (M,) of a part's nodes; the rest comes last."""
    on_all = np.full(memo.transfer.graph.n_polygons, n_labels)
    on_all[kept] = labels
    samples = memo.transfer.to_samples(on_all)
    return memo.visibility.psi_pairs.tally(samples, n_labels + 1)


def seen_apart(
    n_nodes: int, spikes: list[IntArray], count: Count, alpha: float
) -> IntArray:
    """Return the number (M,) of the spike that each node lies on, 0 for the body.

    Only spikes count without which psi is larger. The body has to be nearly convex.

    Parameters
    ----------
    n_nodes : int
        Number of nodes M.
    spikes : list of (S,) int
        Nodes of each.
    count : callable
        Counts pairs of samples by labels.
    alpha : float
        Weight in psi.
    """
    labels = np.zeros(n_nodes, dtype=np.int64)
    for number, spike in enumerate(spikes, 1):
        labels[spike] = number
    if not spikes:
        return labels
    tally = count(labels, len(spikes) + 1)
    for number in range(len(spikes), 0, -1):
        loss = tally.merge_gains(alpha)[0, number]
        if loss >= 0 or not _sampled(tally, _FEWEST_SAMPLES)[number]:
            tally = tally.merged(0, number)
            labels[labels == number] = 0
            labels[labels > number] -= 1
    return labels if tally.ranks()[0] >= _LEAST_BODY else np.zeros_like(labels)


def seen_beyond(joints: Joints, count: Count, demands: Demands) -> Joints:
    """Return the joints whose two pieces are as demanded, the clearest ones first.

    Parameters
    ----------
    joints : Joints
    count : callable
        Counts pairs of samples by labels.
    demands : Demands
    """
    pieces, sizes = joints.pieces, list(joints.sizes)
    if not sizes:
        return joints
    tally = count(pieces, len(sizes) + 1)
    shares = tally.visible / np.maximum(tally.known, 1)
    seen = np.diagonal(shares, 1)[:-1].tolist()
    while sizes:
        whole = tally.ranks() >= demands.least_rank
        whole &= _sampled(tally, demands.fewest_samples)
        fine = whole[:-2] & whole[1:-1] & (np.array(seen) < demands.most_seen)
        if fine.all():
            break
        joint = int(np.where(fine, np.inf, sizes).argmin())
        del sizes[joint], seen[joint]
        tally = tally.merged(joint, joint + 1)
        pieces = np.where(pieces > joint, pieces - 1, pieces)
    return Joints(pieces, sizes)


def _sampled(tally: PairTally, fewest: int) -> BoolArray:
    """Return which pieces have as many known pairs as so many samples have (K,)."""
    return np.diag(tally.known) >= fewest**2
