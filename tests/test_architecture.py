"""The border between the core and Blender, and what enabling the add-on loads."""

import ast
import subprocess
import sys

import pytest
from conftest import HAS_BLENDER, PACKAGE, ROOT

BLENDER_MODULES = {"bpy", "bmesh", "gpu", "mathutils"}
SUPPORT = str(ROOT / "tests" / "support")
SLOW_MODULES = {"scipy", "sklearn"}
CORE = sorted((ROOT / "core").rglob("*.py"))
SHIPPED = [
    ROOT / "__init__.py",
    *(f for d in ("core", "operators", "ui") for f in sorted((ROOT / d).rglob("*.py"))),
]


def imports(path):
    """Yield (module, level) for each import anywhere in a file."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, 0) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            names = [node.module] if node.module else [a.name for a in node.names]
            yield from ((name, node.level) for name in names)


def run_python(code):
    """Run code in a Python of its own that knows the package.

    Returns the words of the code's last line of output; Blender prints others.
    """
    prelude = f"import sys; sys.path.insert(0, {SUPPORT!r})\n"
    # Blender 4.2's wheel crashes where Python ends after an add-on was registered.
    end = "import os; sys.stdout.flush(); os._exit(0)"
    done = subprocess.run(
        [sys.executable, "-c", f"{prelude}import checkout\n{code}\n{end}"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.rstrip("\n").rpartition("\n")[2].split()


def test_core_names_nothing_of_blender_and_nothing_outside_of_core():
    assert len(CORE) > 50
    for path in CORE:
        depth = len(path.relative_to(ROOT / "core").parts)
        for module, level in imports(path):
            assert module.partition(".")[0] not in BLENDER_MODULES, path
            assert level <= depth, f"{path} reaches out of core for {module}"


def test_the_package_imports_itself_relatively():
    assert len(SHIPPED) > 100
    for path in SHIPPED:
        for module, level in imports(path):
            own = module.startswith((PACKAGE, "core", "operators", "ui"))
            assert level or not own, f"{path} imports {module} absolutely"


def test_scikit_learn_is_imported_in_one_place():
    users = [p.name for p in CORE for m, _ in imports(p) if m.startswith("sklearn")]
    assert set(users) == {"kmeans.py"}


def test_operators_import_nothing_of_the_panels_above_them():
    for path in (ROOT / "operators").rglob("*.py"):
        depth = len(path.relative_to(ROOT).parts) - 1
        for module, level in imports(path):
            above = level > depth and module.partition(".")[0] == "ui"
            assert not above, f"{path} imports {module} from above"


def test_every_core_module_loads_without_blender():
    names = [
        ".".join([PACKAGE, *path.relative_to(ROOT).with_suffix("").parts])
        for path in CORE
        if path.stem != "__init__"
    ]
    loaded = run_python(
        f"import importlib\nfor name in {names!r}: importlib.import_module(name)\n"
        "print(*{name.partition('.')[0] for name in sys.modules})"
    )
    assert "numpy" in loaded
    assert not BLENDER_MODULES & set(loaded)


@pytest.mark.skipif(not HAS_BLENDER, reason="bpy cannot be imported")
def test_enabling_loads_neither_scipy_nor_scikit_learn():
    loaded = run_python(
        f"import bpy, {PACKAGE} as package\npackage.register()\n"
        "loaded = {name.partition('.')[0] for name in sys.modules}\n"
        "print(*loaded)"
    )
    assert "bpy" in loaded
    assert not SLOW_MODULES & set(loaded)


@pytest.mark.skipif(not HAS_BLENDER, reason="bpy cannot be imported")
def test_every_parameter_reaches_the_operator_and_the_settings():
    missing = run_python(
        f"import bpy, {PACKAGE} as package\npackage.register()\n"
        "from dataclasses import fields\n"
        f"from {PACKAGE}.core.parameters.parts import Parameters\n"
        "names = {field.name for field in fields(Parameters)}\n"
        "operator = bpy.ops.wcd.decompose.get_rna_type().properties.keys()\n"
        "settings = bpy.context.scene.wcd.bl_rna.properties.keys()\n"
        "missing = (names - set(operator)) | (names - set(settings))\n"
        "package.unregister()\n"
        "print('missing:', *missing)"
    )
    assert missing == ["missing:"]
