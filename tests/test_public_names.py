"""The public names: loaded when first used, documented, typed."""

import doctest
import inspect
import subprocess
import sys

import pytest
import weak_convex_decomposition as wcd
from conftest import PACKAGE, ROOT
from weak_convex_decomposition.operators import scripting

PUBLIC = {
    *("decompose", "build_hulls", "measure", "Parameters", "HullParameters"),
    *("TriangleMesh", "PointCloud", "DecompositionError"),
    *("Decomposition", "HullDecomposition", "Measurement"),
    *("decompose_in_steps", "build_hulls_in_steps", "measure_in_steps", "run"),
    "stretch",
}


def loaded_after(code):
    """Return the modules that a Python of its own has after running code."""
    prelude = f"import sys\nsys.path.insert(0, {str(ROOT / 'tests' / 'support')!r})\n"
    done = subprocess.run(
        [
            *(sys.executable, "-W", "error", "-c"),
            f"{prelude}import checkout\n{code}\nprint(*sys.modules)",
        ],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    return {name.partition(".")[0] for name in done.stdout.split()}


def test_importing_the_package_loads_nothing():
    loaded = loaded_after(f"import {PACKAGE}")
    assert not loaded & {"numpy", "scipy", "sklearn", "bpy", "mathutils", "embreex"}


def test_importing_the_functions_loads_neither_scipy_nor_blender():
    names = "decompose, build_hulls, measure, Parameters, TriangleMesh, PointCloud"
    loaded = loaded_after(f"from {PACKAGE} import {names}, HullParameters")
    assert "numpy" in loaded
    assert not loaded & {"scipy", "sklearn", "bpy", "mathutils", "embreex"}


def test_every_public_name_is_listed_and_found():
    assert set(wcd.__all__) >= PUBLIC
    assert set(dir(wcd)) >= set(wcd.__all__)
    for name in wcd.__all__:
        assert getattr(wcd, name).__doc__, name


def test_types_are_declared_for_every_lazy_name():
    text = (ROOT / "__init__.py").read_text(encoding="utf-8")
    declared = text.partition("if TYPE_CHECKING:")[2].partition("_HOMES")[0]
    for name in set(wcd.__all__) - {"register", "unregister"}:
        assert f" {name} as {name}\n" in declared, name


def test_a_name_that_is_not_public_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'decomposed'"):
        _ = wcd.decomposed


def test_the_examples_are_true():
    homes = {sys.modules[getattr(wcd, name).__module__] for name in wcd.__all__}
    done = {home.__name__: doctest.testmod(home) for home in homes}
    assert not [name for name, results in done.items() if results.failed]
    assert sum(results.attempted for results in done.values()) > 40


@pytest.mark.parametrize("name", ["decompose", "measure", "build_hulls"])
def test_docstrings_have_every_section_and_parameter(name):
    function = getattr(scripting, name)
    text = inspect.cleandoc(function.__doc__)
    for title in ("Parameters", "Returns", "Raises", "References", "Examples"):
        assert f"\n{title}\n{'-' * len(title)}\n" in text
    for parameter in inspect.signature(function).parameters.values():
        assert f"\n{str(parameter).split(':')[0]}" in text, parameter
