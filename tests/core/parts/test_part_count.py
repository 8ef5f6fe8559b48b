"""The number of parts: which of the tried ones is chosen."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import flats
import numpy as np
import pytest
import shapes
from computed import decompose, graph_of, part_count_search, see
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.part_count import PartCountSearch
from weak_convex_decomposition.core.parts.part_count_given import (
    given,
    knows,
    own_parts,
)
from weak_convex_decomposition.core.parts.part_memo import Candidate, FoundMemo
from weak_convex_decomposition.core.parts.part_psi import count_parts
from weak_convex_decomposition.core.steps.progress import run

# Psi of 1 to 6 parts: 3 to 6 are good enough.
PSI = (0.3, 0.9, 1.49, 1.492, 1.495, 1.5)


class KnownParts:
    """Stands for the partitioner: psi is known, seams stay."""

    by_psi, sampling_error = True, 0.006
    graph = graph_of(shapes.box())  # no loop of creases divides it

    def __init__(self, tried, alpha, guessed):
        self.found = FoundMemo()
        self.found.searches.recall((2, 6), lambda: tried)
        self.visibility = SimpleNamespace(
            is_guessed=guessed,
            shows_all_of_solid=guessed,
            shape=SimpleNamespace(shells=None),
        )
        self.parameters = Parameters(alpha=alpha, max_parts=len(PSI), smoothness=0.0)

    def psi(self, parts):
        return PSI[parts.max()]

    psi_seen = psi

    def merged(self, parts, *_, **__):
        return parts


def chosen(even, alpha=2.0, guessed=False):
    """Return the number of parts chosen; those in `even` are symmetric."""
    tried = {
        k: Candidate(np.arange(k), psi, k in even) for k, psi in enumerate(PSI, start=1)
    }
    return run(PartCountSearch(KnownParts(tried, alpha, guessed)).best()).best_k


@pytest.mark.parametrize(
    ("even", "expected"), [((), 3), ((3, 5), 3), ((4, 6), 4), ((5, 6), 3), ((2,), 3)]
)
def test_symmetric_parts_are_preferred(even, expected):
    assert chosen(even) == expected


def test_more_detail_takes_more_parts():
    numbers = [chosen((), alpha) for alpha in (0.0, 0.5, 2.0, 10.0)]
    assert numbers == [3, 3, 3, 4]


def test_parts_from_likely_pairs_may_lack_less_gain_unless_symmetric():
    assert chosen((), alpha=10.0, guessed=True) == 5
    assert chosen((4,), alpha=10.0, guessed=True) == 4


def test_psi_of_sight_decides_on_the_number():
    class Guessed(KnownParts):
        def psi_seen(self, parts):
            return self.psi(parts) if parts.max() < 4 else 0.0

    tried = {k: Candidate(np.arange(k), psi) for k, psi in enumerate(PSI, start=1)}
    found = run(PartCountSearch(Guessed(tried, 10.0, True)).best())
    assert (found.best_k, found.psi_by_k[5]) == (3, 0.0)


@pytest.mark.parametrize("number", [2, 3, 4])
def test_parts_given_are_those_chosen_split_or_merged(number):
    """By psi alone, one of two parts would be a ball and a slice of the bar."""
    mesh, few = shapes.dumbbell(), Parameters(samples=600)
    chosen, given = decompose(mesh, few), decompose(mesh, replace(few, parts=number))
    both = set(zip(chosen.labels, given.labels, strict=True))
    assert (chosen.n_parts, given.n_parts, given.best_k) == (3, number, 3)
    assert len(both) == max(3, number)


def cubes(number):
    """Return cubes in a row, apart from each other."""
    return shapes.joined(
        *(shapes.box((2 * x, 0, 0), (2 * x + 1, 1, 1)) for x in range(number))
    )


@pytest.mark.parametrize(
    ("number", "most", "expected"), [(12, 100, 12), (24, 100, 24), (24, 17, 17)]
)
def test_more_are_tried_while_the_last_number_is_the_best(number, most, expected):
    found = decompose(cubes(number), Parameters(samples=600, max_parts=most))
    assert (found.n_parts, found.best_k) == (expected, expected)
    assert max(found.psi_by_k) == max(expected, 13)


def test_fewest_parts_may_be_more_than_are_tried_at_first():
    found = decompose(cubes(16), Parameters(samples=600, min_parts=14))
    assert found.n_parts == 16
    given = decompose(cubes(16), Parameters(samples=600, parts=15))
    assert (given.n_parts, given.best_k) == (15, 16)


@pytest.fixture(scope="module")
def comb():
    """Return the visibility of a comb."""
    return see(shapes.comb(), Parameters(samples=500))


def test_above_five_every_second_number_has_parts_of_its_own(comb):
    search = part_count_search(comb, Parameters(samples=500), 2, 10)
    _, tried = run(search.tried())
    known = [k for k in range(1, 12) if k in search.found.candidates]
    assert known == [1, 2, 3, 4, 5, 6, 8, 10]
    assert sorted(tried) == list(range(1, 11))
    assert all(count_parts(tried[k].parts) == k for k in tried)


def test_the_papers_way_looks_for_every_number_itself(comb):
    paper = Parameters(samples=500, refinement="EMBEDDING")
    search = part_count_search(comb, paper, 2, 10)
    run(search.tried())
    assert [k for k in range(1, 12) if k in search.found.candidates] == [*range(1, 11)]


def test_more_parts_than_are_tried_have_a_larger_psi_than_clusters(comb):
    search = part_count_search(comb, Parameters(samples=500), 2, 8)
    psi, gains = search.partitioner.psi, []
    for n_parts in range(9, 21):
        own = run(own_parts(search, n_parts))
        assert count_parts(own) == n_parts
        gains.append(psi(own) - run(search.alone(n_parts)).psi)
    assert np.mean(gains) > 0.002


@pytest.mark.parametrize("numbers", [range(9, 14), range(14, 27)])
def test_of_many_parts_one_more_divides_one(comb, numbers):
    search = part_count_search(comb, Parameters(samples=500), 2, 8)
    found = [run(own_parts(search, n_parts)) for n_parts in numbers]
    for fewer, more in pairwise(found):
        assert len(np.unique(np.stack([fewer, more]), axis=1).T) == count_parts(more)


def test_parts_given_are_kept(comb):
    search = part_count_search(comb, Parameters(samples=500), 2, 8)
    first = run(given(search, 12))
    assert run(given(search, 12)) is first
    assert count_parts(first.seams.parts) == 12
    assert first.best_k == run(search.best()).best_k


def test_numbers_are_rated_once_a_search(comb, monkeypatch):
    search = part_count_search(comb, Parameters(samples=500), 2, 8)
    tried = run(search.tried())
    monkeypatch.setattr(search, "rated", None)
    assert run(search.tried()) is tried


def test_parts_given_are_known_even_if_more_were_tried_meanwhile():
    few = Parameters(samples=600)
    memo = see(flats.filled(flats.comb(20), spacing=0.5), few)
    search = part_count_search(memo, few, 2, 20)
    run(given(search, 5))
    assert (search.first_high, run(search.tried())[0]) == (13, 20)
    assert search.searched
    assert knows(search, 5)
    assert not knows(part_count_search(memo, few, 2, 18), 5)
