"""The README says what the code does: parameters, files, commands and examples."""

import math
import os
import re
import subprocess
import sys
import tomllib
from dataclasses import fields

import pytest
from conftest import PACKAGE, ROOT
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.parameters.parameter import info_of
from weak_convex_decomposition.core.parameters.parts import Parameters

README = (ROOT / "README.md").read_text(encoding="utf-8")
PARAMETERS = (*fields(Parameters), *fields(HullParameters))
FILES_TOLD_OF = sorted(
    file.relative_to(ROOT).as_posix()
    for folder in ("core", "ui")
    for file in (ROOT / folder).rglob("*.py")
    if file.name != "__init__.py"
)


def section(title):
    """Return the text below a heading."""
    return re.search(rf"^## {title}\n(.*?)(?=^## |\Z)", README, re.M | re.S).group(1)


def blocks(language):
    """Return the fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.M | re.S)


def rows_of_parameters():
    lines = section("Parameters").splitlines()
    rows = [line for line in lines if re.match(r"\| `\w+` \|", line)]
    assert len([line for line in lines if re.fullmatch(r"[|-]{6,}", line)]) == 2
    return rows


def number(info, value):
    """Return a value as the table has it: degrees for angles."""
    return f"{math.degrees(value):g}°" if info.subtype == "ANGLE" else f"{value:.10g}"


def row(field):
    """Return the row of a parameter."""
    info, about = info_of(field), ""
    if info.choices:
        default = f"`{field.default}`"
        bounds = " or ".join(f"`{choice.identifier}`" for choice in info.choices)
        about = "".join(
            f"; `{c.identifier}`: {c.help[0].lower()}{c.help[1:]}" for c in info.choices
        )
    elif isinstance(field.default, str):
        default, bounds = f"`{field.default}`", "text"
    else:
        default = number(info, field.default)
        bounds = f"{number(info, info.low)}…{number(info, info.high)}"
    return (
        f"| `{field.name}` | {info.label} | {default} | {bounds} | {info.help}{about} |"
    )


def test_the_table_has_every_parameter_in_order():
    names = [re.match(r"\| `(\w+)`", line).group(1) for line in rows_of_parameters()]
    assert names == [field.name for field in PARAMETERS]


@pytest.mark.parametrize("field", PARAMETERS, ids=lambda field: field.name)
def test_the_table_says_what_the_field_says(field):
    # A failure shows the row as it should be.
    assert row(field) in rows_of_parameters()


def test_every_path_in_the_layout_exists():
    paths = re.findall(
        r"`((?:\w+|\.\w+)/[\w./]*|\w+\.\w+)`", section("How the code is laid out")
    )
    assert len(paths) > 20
    assert [path for path in paths if not (ROOT / path).exists()] == []


@pytest.mark.parametrize("path", FILES_TOLD_OF)
def test_the_layout_tells_of_every_file(path):
    assert f"`{path}`" in section("How the code is laid out")


def test_the_first_commands_are_the_demo_and_the_tests():
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    assert [line.partition("#")[0].strip() for line in lines[:2]] == [
        "make demo",
        "make test",
    ]


def test_every_make_command_exists():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    commands = set(re.findall(r"[`\n]make ([\w-]+)", README))
    assert commands >= {"demo", "test", "zip", "bench"}
    assert commands <= set(re.findall(r"^([\w-]+):", makefile, re.M))


def test_every_option_is_one():
    options = {o.replace("-", "_") for o in re.findall(r"[` ]--([a-z-]+)", README)}
    own = {"help", "hulls", "hulls_format", "output", "picture", "preset", "report"}
    blenders = {"command"}
    assert options <= own | blenders | {field.name for field in PARAMETERS}


def test_install_names_the_oldest_blender_and_every_platform():
    text = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8")
    manifest = tomllib.loads(text)
    assert f"Blender {manifest['blender_version_min']} LTS" in section("Install")
    for platform in (*manifest["platforms"], "no_wheels"):
        assert f"`{platform.replace('-', '_')}`" in section("Install")


def test_pictures_are_there_and_small():
    shown = re.findall(r"!\[[^]]*\]\((.*?)\)", README)
    assert shown
    assert sum((ROOT / path).stat().st_size for path in shown) < 700_000


def test_the_complete_example_runs_from_a_checkout(tmp_path):
    (example,) = (block for block in blocks("python") if f"from {PACKAGE}" in block)
    (tmp_path / PACKAGE).symlink_to(ROOT, target_is_directory=True)
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", example],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("2 parts, ")
