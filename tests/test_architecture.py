"""The border between the core and Blender, what enabling the add-on loads, and size."""

import ast
import subprocess
import sys

import pytest
from conftest import HAS_BLENDER, PACKAGE, ROOT

BLENDER_MODULES = {"bpy", "bmesh", "gpu", "mathutils"}
SUPPORT = str(ROOT / "tests" / "support")
SLOW_MODULES = {"scipy", "sklearn"}
CORE = sorted((ROOT / "core").rglob("*.py"))
# From the ground up: each floor knows those below it alone.
FLOORS = ("core", "operators", "ui")
SHIPPED = [
    ROOT / "__init__.py",
    *(path for floor in FLOORS for path in sorted((ROOT / floor).rglob("*.py"))),
]


def parsed(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def imports(path):
    """Yield (module, level) for each import anywhere in a file."""
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.Import):
            yield from ((alias.name, 0) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or "", node.level


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


def name_of(path):
    """Return the dotted name of a module, that of the folder for an __init__."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for path in SHIPPED}


def imported_by(name, path):
    """Yield the names of the project's modules that one of them imports, anywhere."""
    folder = [part for part in name.split(".") if part]
    folder = folder if path.stem == "__init__" else folder[:-1]
    for node in ast.walk(parsed(path)):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = folder[: len(folder) - node.level + 1]
        base += node.module.split(".") if node.module else []
        for alias in node.names:
            whole = ".".join([*base, alias.name])
            yield whole if whole in MODULES else ".".join(base)


def import_graph():
    """Return the names of the modules that each module imports."""
    graph = {n: set(imported_by(n, path)) - {n} for n, path in MODULES.items()}
    unknown = {name for found in graph.values() for name in found} - graph.keys()
    assert not unknown, f"imported, but not there: {sorted(unknown)}"
    assert sum(len(found) for found in graph.values()) > 300
    return graph


def reached_from(names, graph):
    """Return all modules that some modules import, and that these import, and so on."""
    reached, ahead = set(), list(names)
    while ahead:
        ahead += (found := graph[ahead.pop()] - reached)
        reached |= found
    return reached


def circle_in(graph):
    """Return names that import each other in a circle, written as one; "" for none."""
    done, way = set(), []

    def visit(name):
        if name in way:
            return " -> ".join([*way[way.index(name) :], name])
        way.append(name)
        nexts = sorted(graph[name] - done)
        circle = next(filter(None, map(visit, nexts)), "")
        way.pop()
        done.add(name)
        return circle

    return next(filter(None, (visit(name) for name in sorted(graph))), "")


def test_no_modules_import_each_other_in_a_circle():
    circle = circle_in(import_graph())
    assert not circle, circle


def rooms_in(house):
    """Return the rooms that each room of a house imports.

    A room is a folder of the house, or a module beside the folders.
    """

    def rooms_of(names):
        # Not the door, the house itself: it opens rooms when first asked for them.
        inside = (name for name in names if name.startswith(f"{house}."))
        return {name.removeprefix(f"{house}.").partition(".")[0] for name in inside}

    rooms = {}
    for name, found in import_graph().items():
        for room in rooms_of([name]):
            rooms.setdefault(room, set()).update(rooms_of(found) - {room})
    assert len(rooms) > 8
    return rooms


@pytest.mark.parametrize("house", ["core", "operators.headless"])
def test_no_rooms_import_each_other_in_a_circle(house):
    circle = circle_in(rooms_in(house))
    assert not circle, circle


def test_only_these_rooms_of_the_bridge_import_each_other():
    rooms = rooms_in("operators.bridge")
    mutual = {(a, b) for a in rooms for b in rooms[a] if a < b and a in rooms[b]}
    with_parts = {("cuts", "parts"), ("hulls", "parts"), ("parts", "views")}
    assert mutual == {*with_parts, ("mesh", "stored")}


def test_no_floor_knows_one_above_it():
    height = {floor: number for number, floor in enumerate((*FLOORS, ""))}
    back = [
        f"{name} imports {other or 'the package itself'}"
        for name, found in import_graph().items()
        for other in sorted(found)
        if height[other.partition(".")[0]] > height[name.partition(".")[0]]
    ]
    assert not back, "; ".join(back)
