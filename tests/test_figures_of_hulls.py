"""The page on hulls states what hulls come out, in an example and for a cube."""

import re

import pytest
import weak_convex_decomposition as wcd
from conftest import ROOT
from shapes import box

PAGE = (ROOT / "docs" / "hulls.md").read_text(encoding="utf-8")


def error_of_cube(**parameters):
    """Return the largest error of hulls around a cube, as the page writes it."""
    return f"{wcd.build_hulls(box(), **parameters).errors.max():.2f}"


def test_the_example_prints_what_the_page_says():
    (example,) = re.findall(r"^```python\n(import weak.*?)^```", PAGE, re.M | re.S)
    names = {}
    exec(example, names)
    (printed,) = re.findall(r"prints as `(HullDecomposition\(.*?\))`", PAGE)
    assert repr(names["hulls"]) == printed


@pytest.mark.parametrize(
    ("sentence", "many", "parameters"),
    [
        (r"one sphere\s+around a cube strays by ([\d.]+),", 1, {"shape": "SPHERE"}),
        (r"eight eighths by ([\d.]+)\.", 8, {"shape": "SPHERE"}),
        (r"6 vertices strays from a cube by ([\d.]+),", 1, {"max_vertices": 6}),
    ],
)
def test_errors_around_a_cube(sentence, many, parameters):
    (stated,) = re.findall(sentence, PAGE)
    assert error_of_cube(max_hulls=many, **parameters) == stated


def test_many_hulls_of_few_vertices():
    (most,) = re.findall(r"32 by less than ([\d.]+)\. No", PAGE)
    assert float(error_of_cube(max_hulls=32, max_vertices=6)) < float(most)
