"""The README is short, and what it says is so: commands, options, files, example."""

import os
import re
import subprocess
import sys
import tomllib
from dataclasses import fields

import pytest
from conftest import HAS_BLENDER, PACKAGE, ROOT
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.parameters.parts import Parameters

README = (ROOT / "README.md").read_text(encoding="utf-8")
# Options of the command line that are no parameters; `--command` is Blender's.
OWN_OPTIONS = {
    *("apply_modifiers", "command", "help", "hulls", "hulls_format", "output"),
    *("picture", "preset", "processes", "quiet", "report", "up", "version"),
    "with_hulls",
}
# What the README says of the example's result, asked of it.
_LABELS = "print(decompose(vertices, faces).labels)"


def section(title):
    """Return the text below a heading."""
    return re.search(rf"^## {title}\n(.*?)(?=^## |\Z)", README, re.M | re.S).group(1)


def blocks(language, text=README):
    """Return the fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.M | re.S)


def make_targets():
    """Return the names of all targets of the Makefile."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([\w-]+):", makefile, re.M))


def options_in(text):
    """Return the options of the command line that a text names, with underscores."""
    return {o.replace("-", "_") for o in re.findall(r"[` ]--([a-z][a-z-]+)", text)}


def test_it_is_at_most_8000_bytes():
    assert len(README.encode("utf-8")) <= 8000


def test_the_first_commands_are_the_demo_and_the_tests():
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    assert [line.partition("#")[0].strip() for line in lines[:2]] == [
        "make demo",
        "make test",
    ]


def test_every_make_command_exists():
    commands = set(re.findall(r"[`\n]make ([\w-]+)", README))
    assert commands >= {"demo", "test", "zip", "docs"}
    assert commands <= make_targets()


@pytest.mark.skipif(not HAS_BLENDER, reason="the command line imports bpy")
def test_own_options_are_those_of_the_command_line():
    from weak_convex_decomposition.operators.headless.request import options

    known = {action.dest for action in options._parser("wcd")._actions}
    settings = {field.name for kind in options.SETTINGS for field in fields(kind)}
    assert (known - settings - {"inputs"}) | {"command"} == OWN_OPTIONS


def test_every_option_is_one():
    parameters = {f.name for kind in (Parameters, HullParameters) for f in fields(kind)}
    assert options_in(README) <= OWN_OPTIONS | parameters


def test_install_comes_first_and_names_the_oldest_blender_and_every_platform():
    text = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8")
    manifest = tomllib.loads(text)
    assert re.findall("^## (.*)", README, re.M)[0] == "Install"
    install = section("Install")
    assert f"Blender {manifest['blender_version_min']} LTS" in install
    for platform in (*manifest["platforms"], "no_wheels"):
        assert f"`{platform.replace('-', '_')}`" in install


def test_pictures_are_there_and_small():
    shown = re.findall(r"!\[[^]]*\]\((.*?)\)", README)
    assert shown
    assert sum((ROOT / path).stat().st_size for path in shown) < 300_000


def test_every_extra_that_pip_is_told_of_exists():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    named = set(re.findall(r"'\.\[(\w+)\]'", README))
    assert named
    assert named <= project["project"]["optional-dependencies"].keys()


@pytest.mark.skipif(not HAS_BLENDER, reason="there may be no ray caster")
def test_the_script_runs_from_a_checkout_and_finds_the_parts_it_promises(tmp_path):
    (script,) = (block for block in blocks("python") if f"from {PACKAGE}" in block)
    (tmp_path / PACKAGE).symlink_to(ROOT, target_is_directory=True)
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", script + _LABELS],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    )
    assert (done.returncode, done.stderr) == (0, "")
    result, labels = done.stdout.splitlines()[-2:]
    assert result.startswith("Decomposition(2 parts, ")
    assert f"`labels`, here `{labels}`" in README
