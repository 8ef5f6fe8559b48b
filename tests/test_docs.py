"""The pages of docs/ and the site: links, paths, commands and tables are so."""

import ast
import importlib.util
import json
import re
from dataclasses import fields

import pytest
from conftest import HAS_BLENDER, PACKAGE, ROOT
from test_readme import OWN_OPTIONS, blocks, make_targets, options_in
from weak_convex_decomposition import core  # noqa: F401  # the package, for the hooks
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parameters.presets import PRESETS
from weak_convex_decomposition.core.results.hulls import HullDecomposition
from weak_convex_decomposition.core.results.parts import Decomposition

DOCS = ROOT / "docs"
PAGES = {path: path.read_text(encoding="utf-8") for path in sorted(DOCS.glob("*.md"))}
ROOT_PAGES = {
    ROOT / name: (ROOT / name).read_text(encoding="utf-8")
    for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
}
ALL_PAGES = PAGES | ROOT_PAGES
LAYOUT = PAGES[DOCS / "how_the_code_is_laid_out.md"]
CONTRIBUTING = ROOT_PAGES[ROOT / "CONTRIBUTING.md"]
PATHS = r"`((?:\w+|\.\w+)/[\w./]*|\w+\.\w+)`"
# The parameters of each table.
TABLES = {"parts": Parameters, "hulls": HullParameters, "bodies": BodyParameters}
# Paths that a command makes.
MADE = ("build/", ".venv/")


@pytest.fixture(scope="module")
def hooks():
    """Return the module that MkDocs runs."""
    spec = importlib.util.spec_from_file_location("hooks", DOCS / "site" / "hooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def anchors(page):
    """Return the anchors of a page's headings, as MkDocs makes them."""
    headings = re.findall(r"^#+ (.*)", re.sub(r"```.*?```", "", page, flags=re.S), re.M)
    words = (re.sub(r"[^\w\s-]", "", heading).strip().lower() for heading in headings)
    return {re.sub(r"[-\s]+", "-", each) for each in words}


def cells(table):
    """Return the cells of each row of a Markdown table, without its head."""
    rows = [line.strip("|").split(" | ") for line in table.splitlines()[2:]]
    return [[cell.strip() for cell in row] for row in rows]


def test_every_link_between_pages_leads_somewhere():
    n_links = 0
    for path, page in ALL_PAGES.items():
        for target in re.findall(r"(?<!!)\[[^]]*\]\(([^)]+)\)", page):
            if target.startswith("https://"):
                continue
            name, _, anchor = target.partition("#")
            linked = (path.parent / name).resolve() if name else path
            assert linked in ALL_PAGES, f"{path.name} links to {target}"
            found = anchors(ALL_PAGES[linked])
            assert not anchor or anchor in found, f"{path.name} links to {target}"
            n_links += 1
    assert n_links > 40


def test_every_picture_is_there_and_shown_and_all_are_small():
    shown = {
        (path.parent / target).resolve()
        for path, page in ALL_PAGES.items()
        for target in re.findall(r"!\[[^]]*\]\(([^)]+)\)", page)
    }
    kept = set((DOCS / "pictures").iterdir())
    assert shown == kept
    assert sum(path.stat().st_size for path in kept) < 1_500_000


def test_nothing_on_a_page_is_taken_for_a_tag():
    for path, page in ALL_PAGES.items():
        text = re.sub(r"```.*?```|`[^`]*`|<!-- table: \w+ -->", "", page, flags=re.S)
        assert "<" not in text, path.name


def test_every_page_is_in_the_navigation(hooks):
    settings = (DOCS / "site" / "mkdocs.yml").read_text(encoding="utf-8")
    named = re.findall(r": (\w+\.md)$", settings, re.M)
    assert len(named) == len(set(named))
    assert set(named) == {p.name for p in PAGES} | set(hooks.ROOT_PAGES.values())


def test_links_of_the_checkout_become_links_of_the_site(hooks):
    for page in ALL_PAGES.values():
        for target in re.findall(r"\]\(([^)#]+)", hooks.site_links(page)):
            assert "/" not in target or target.startswith(("pictures/", "https://"))


def test_the_tables_have_every_parameter_and_preset(hooks):
    for name, kind in TABLES.items():
        rows = cells(hooks.table(name))
        assert [row[0] for row in rows] == [f"`{f.name}`" for f in fields(kind)]
        for row, field in zip(rows, fields(kind), strict=True):
            info = field.metadata["info"]
            assert len(row) == 5, row
            assert row[1] == info.label
            assert info.help in row[4]
            for choice in info.choices:
                assert f"`{choice.identifier}`" in row[3], row
                assert choice.help in row[4], row
    rows = cells(hooks.table("presets"))
    assert [row[0] for row in rows] == [f"`{p.identifier.lower()}`" for p in PRESETS]
    for row, preset in zip(rows, PRESETS, strict=True):
        assert all(f"`{name}`" in row[2] for name in preset.changes), row


def test_the_tables_show_angles_in_degrees_and_bounds(hooks):
    rows = {row[0]: row for row in cells(hooks.table("parts"))}
    assert rows["`cone_angle`"][2:4] == ["120°", "1° to 180°"]
    assert rows["`parts`"][2:4] == ["0", "0 to 256"]
    assert rows["`sight`"][2] == "`BLOCKS`"


def test_the_page_of_parameters_asks_for_every_table(hooks):
    page = PAGES[DOCS / "parameters.md"]
    assert re.findall(r"<!-- table: (\w+) -->", page) == [*TABLES, "presets"]
    filled = hooks.on_page_markdown(page)
    assert "<!--" not in filled
    assert "| `smallest_part` |" in filled


def test_the_page_of_the_report_has_every_field_of_its_schema(hooks):
    schema = json.loads((DOCS / "report.schema.json").read_text(encoding="utf-8"))
    filled = hooks.on_page_markdown(PAGES[DOCS / "report.md"])
    assert "<!--" not in filled
    told = [schema, *schema["$defs"].values()]
    names = {name for each in told for name in each["properties"]}
    assert len(names) > 40
    assert [name for name in sorted(names) if f"`{name}`" not in filled] == []


def test_the_layout_tells_of_every_file_or_of_its_folder():
    files = [
        file.relative_to(ROOT)
        for folder in ("core", "operators", "ui")
        for file in sorted((ROOT / folder).rglob("*.py"))
        if file.name != "__init__.py"
    ]
    assert len(files) > 200
    unsaid = [file for file in files if f"`{file.as_posix()}`" not in LAYOUT]
    folders = {file.parent for file in unsaid}
    assert [each for each in folders if f"| `{each.as_posix()}/` |" not in LAYOUT] == []


def test_every_path_that_a_page_names_exists():
    for page in (LAYOUT, CONTRIBUTING, *PAGES.values()):
        paths = [
            path
            for path in re.findall(PATHS, page)
            if path.split("/")[0] in {p.name for p in ROOT.iterdir()}
        ]
        paths = [path for path in paths if not path.startswith(MADE)]
        assert [path for path in paths if not (ROOT / path).exists()] == []
    assert len(re.findall(PATHS, LAYOUT)) > 90


def test_every_make_command_of_a_page_exists():
    for path, page in ALL_PAGES.items():
        commands = set(re.findall(r"[`\n]make ([\w-]+)", page))
        assert commands <= make_targets(), path.name


def test_every_option_of_a_page_is_one():
    parameters = {f.name for kind in TABLES.values() for f in fields(kind)}
    for path, page in PAGES.items():
        assert options_in(page) <= OWN_OPTIONS | parameters, path.name


def test_the_pages_of_python_name_every_field_of_the_results():
    for page, kind in (("scripts", Decomposition), ("hulls", HullDecomposition)):
        text = PAGES[DOCS / f"{page}.md"]
        for field in fields(kind):
            assert f"| `{field.name}` |" in text, f"{page}.md: {field.name}"


def python_on_the_pages():
    return [script for page in ALL_PAGES.values() for script in blocks("python", page)]


def test_python_on_the_pages_parses():
    scripts = python_on_the_pages()
    assert len(scripts) > 5
    for script in scripts:
        ast.parse(script)


@pytest.mark.skipif(not HAS_BLENDER, reason="there may be no ray caster")
def test_python_that_needs_no_file_and_no_object_runs_as_it_stands():
    scripts = [
        script
        for script in python_on_the_pages()
        if PACKAGE in script and "model.obj" not in script and "register" not in script
    ]
    assert len(scripts) == 3
    for script in scripts:
        exec(compile(script, "page", "exec"), {})


def test_every_figure_of_the_paper_has_the_command_that_draws_it():
    page = PAGES[DOCS / "paper.md"]
    drawn = re.findall(r"^make figures FIGURES=(\w+)", page, re.M)
    pictures = re.findall(r"\]\(pictures/(\w+)\.png\)", page)
    assert drawn == pictures
    sources = "".join(
        (DOCS / "figures" / f"{kind}_drawings.py").read_text(encoding="utf-8")
        for kind in ("flat", "solid")
    )
    assert [name for name in drawn if f"def {name}()" not in sources] == []


def test_versions_of_the_site_are_pinned():
    lines = (ROOT / ".tools/requirements/docs.txt").read_text(encoding="utf-8").split()
    assert lines
    assert all(re.fullmatch(r"[\w-]+==[\d.]+", line) for line in lines)


def test_hooks_of_commits_need_no_network():
    text = (ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8")
    assert set(re.findall(r"- repo: (\S+)", text)) == {"local"}
    assert set(re.findall(r"language: (\S+)", text)) == {"system"}
    assert set(re.findall(r"entry: make ([\w-]+)", text)) <= make_targets()


def test_the_site_is_built_strictly():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    (call,) = re.findall(r"mkdocs build (.*)", makefile)
    assert "--strict" in call
    assert "--quiet" not in call, "it hides warnings, which --strict then misses"
