"""Values that are computed once and kept."""

from weak_convex_decomposition.core.steps.memo import Memo


def test_the_value_that_was_not_asked_for_longest_is_dropped_first():
    memo = Memo(2)
    for key in ("a", "b", "a", "c"):
        assert memo.recall(key, lambda key=key: [key]) == [key]
    assert "a" in memo
    assert "b" not in memo


def test_a_value_that_is_kept_is_not_computed_again():
    memo, made = Memo(), []
    values = [memo.recall("a", lambda: made.append(1) or 5) for _ in range(2)]
    assert (values, made) == ([5, 5], [1])
