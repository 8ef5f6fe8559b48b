"""Counts parts, and pairs of samples by parts: how good parts are by psi."""

from __future__ import annotations

import numpy as np

from ..parameters.parts import Parameters
from ..sight.pair_tally import PairTally
from ..sight.pair_visibility import PairVisibility
from ..steps.arrays import IntArray
from ..steps.memo import digest
from .part_memo import PartMemo

# With other N samples, the psi of a shape differs by about this over √N.
_SAMPLING_ERROR = 0.2


class PartPsi:
    """Tells the psi of any parts of a shape.

    Parameters
    ----------
    memo : PartMemo
        The visibility; it also keeps what was counted.
    parameters : Parameters

    Attributes
    ----------
    memo, parameters
        As given.
    visibility : Visibility
    transfer : Transfer
    sampling_error : float
        Differences of psi below this tell nothing.
    """

    def __init__(self, memo: PartMemo, parameters: Parameters) -> None:
        self.memo, self.parameters = memo, parameters
        self.visibility = memo.visibility
        self.transfer = memo.transfer
        self.sampling_error = _SAMPLING_ERROR / np.sqrt(len(memo.visibility.samples))

    def tally(self, parts: IntArray) -> PairTally:
        """Count likely and known pairs of samples by parts (P,) of the nodes."""
        return self._counted(self.visibility.likely_pairs, parts)

    def tally_seen(self, parts: IntArray) -> PairTally:
        """Count pairs of samples by parts (P,) of the nodes, by lines of sight."""
        return self._counted(self.visibility.psi_pairs, parts)

    def _counted(self, pairs: PairVisibility, parts: IntArray) -> PairTally:
        """Count pairs of samples by parts (P,) of the nodes, each kind once."""
        labels, n_parts = self.transfer.to_samples(parts), count_parts(parts)
        key = digest(labels), n_parts, pairs is self.visibility.psi_pairs
        return self.memo.tallies.recall(key, lambda: pairs.tally(labels, n_parts))

    def psi(self, parts: IntArray) -> float:
        """Return psi (eq. 5) of parts (P,) of the nodes, from likely pairs."""
        return self.tally(parts).psi(self.parameters.alpha)

    def psi_seen(self, parts: IntArray) -> float:
        """Return psi (eq. 5) of parts (P,) of the nodes, from lines of sight alone."""
        return self.tally_seen(parts).psi(self.parameters.alpha)


def count_parts(parts: IntArray) -> int:
    """Return the number of parts K of labels (P,) in 0…K − 1."""
    return int(parts.max()) + 1
