"""What MkDocs asks while it builds the site: pages and tables made at build time.

Pages of the checkout's root become pages of the site, so that nothing is written
twice. The tables of `parameters.md` are made from the fields of the parameters, and
those of `report.md` from the schema of reports.
"""

from __future__ import annotations

import importlib
import importlib.util
import json
import math
import re
import sys
from collections.abc import Iterable
from dataclasses import Field, fields
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
# Files of the root that are pages of the site: their addresses there.
ROOT_PAGES = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}
_PACKAGE = "weak_convex_decomposition"
_MARK = re.compile(r"<!-- table: (\w+) -->")


def on_files(files: Any, config: Any) -> Any:
    """Add the pages of the root."""
    from mkdocs.structure.files import File

    for name, address in ROOT_PAGES.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        files.append(File.generated(config, address, content=text))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Fill in the tables, and turn links of the checkout into links of the site."""
    return _MARK.sub(
        lambda mark: f'<div class="parameters" markdown>\n\n{table(mark[1])}\n\n</div>',
        site_links(markdown),
    )


def site_links(markdown: str) -> str:
    """Return a page whose links fit the site, where all pages are side by side."""
    markdown = markdown.replace("](docs/", "](")
    for name, address in ROOT_PAGES.items():
        markdown = re.sub(rf"\]\((\.\./)?{re.escape(name)}", f"]({address}", markdown)
    return markdown


def table(name: str) -> str:
    """Return a table, such as `parts`, `bodies` or `report_run`, in Markdown."""
    if name.startswith("report_"):
        return _report_table(name.removeprefix("report_"))
    parameters = _load("core.parameters.parts").Parameters
    if name == "parts":
        return parameter_table(fields(parameters))
    if name == "hulls":
        hulls = _load("core.parameters.hulls").HullParameters
        return parameter_table(fields(hulls))
    if name == "bodies":
        bodies = _load("core.parameters.bodies").BodyParameters
        return parameter_table(fields(bodies))
    if name == "presets":
        return _preset_table(parameters)
    raise ValueError(f"there is no table {name!r}")


def parameter_table(of: Iterable[Field[Any]]) -> str:
    """Return a row for each parameter."""
    head = [
        "| name | label | default | values | what it does |",
        "|---|---|---|---|---|",
    ]
    return "\n".join([*head, *map(_row, of)])


def _row(field: Field[Any]) -> str:
    """Return the row of a parameter."""
    info, default = field.metadata["info"], field.default
    text = f"{info.help}."
    if info.choices:
        values = "<br>".join(f"`{choice.identifier}`" for choice in info.choices)
        text += "".join(
            f"<br>`{choice.identifier}`: {choice.help}." for choice in info.choices
        )
    elif isinstance(default, str):
        values = "text"
    else:
        values = f"{_shown(info, info.low)} to {_shown(info, info.high)}"
    shown = _shown(info, default)
    return f"| `{field.name}` | {info.label} | {shown} | {values} | {text} |"


def _preset_table(parameters: type) -> str:
    """Return a row for each preset, with what it changes."""
    info_of = {field.name: field.metadata["info"] for field in fields(parameters)}
    lines = ["| preset | for | what it sets |", "|---|---|---|"]
    for preset in _load("core.parameters.presets").PRESETS:
        changes = [
            f"`{name}` = {_shown(info_of[name], value)}"
            for name, value in preset.changes.items()
        ]
        lines.append(
            f"| `{preset.identifier.lower()}` | {preset.label}: {preset.help}."
            f" | {'<br>'.join(changes) or 'nothing'} |"
        )
    return "\n".join(lines)


def _report_table(name: str) -> str:
    """Return a row for each field of an object of the report; `run` is the whole."""
    schema = json.loads((ROOT / "docs/report.schema.json").read_text(encoding="utf-8"))
    of = schema if name == "run" else schema["$defs"][name]
    rows = ["| field | type | what it is |", "|---|---|---|"]
    for field, told in of["properties"].items():
        found = (
            schema["$defs"][told["$ref"].rsplit("/")[-1]] if "$ref" in told else told
        )
        text = told.get("description") or found["description"]
        rows.append(f"| `{field}` | {_type_of(found)} | {text} |")
    return "\n".join(rows)


def _type_of(told: dict[str, Any]) -> str:
    """Return the type that a schema asks for, in words."""
    if "anyOf" in told:
        return "object, null"
    if "const" in told or "enum" in told:
        values = told.get("enum", [told.get("const")])
        return "<br>".join(f"`{value}`" for value in values)
    types = [told["type"]] if isinstance(told["type"], str) else told["type"]
    return ", ".join(types)


def _shown(info: Any, value: float | str) -> str:
    """Return a value as people read it: texts as code, angles in degrees."""
    if isinstance(value, str):
        return f"`{value}`"
    return f"{math.degrees(value):g}°" if info.subtype == "ANGLE" else f"{value:.10g}"


def _load(module: str) -> ModuleType:
    """Return a module of this checkout, whatever the name of its folder."""
    if _PACKAGE not in sys.modules:
        spec = importlib.util.spec_from_file_location(
            _PACKAGE, ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
        )
        if spec is None or spec.loader is None:
            raise ImportError(f"{ROOT} has no __init__.py")
        package = importlib.util.module_from_spec(spec)
        sys.modules[_PACKAGE] = package
        spec.loader.exec_module(package)
    return importlib.import_module(f"{_PACKAGE}.{module}")
