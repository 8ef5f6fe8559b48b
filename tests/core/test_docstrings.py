"""Docstrings of what is public, and the parameters that they tell of."""

import ast
import inspect

from checkout import ROOT

UNDERLINE = "----------"  # below "Parameters"
PUBLIC = [*sorted((ROOT / "core").rglob("*.py"))]
PUBLIC += [path for path in [ROOT / "operators" / "scripting.py"] if path.exists()]


def public_parts(tree, title=""):
    """Yield (title, node) for the public classes and functions of a module or class."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name[0] != "_":
            yield title + node.name, node
            if isinstance(node, ast.ClassDef):
                yield from public_parts(node, f"{title}{node.name}.")


def parameters_of(node):
    """Return the names of a function's parameters, or of those that make a class."""
    if isinstance(node, ast.ClassDef):
        makers = [each for each in node.body if getattr(each, "name", "") == "__init__"]
        if not makers:  # a dataclass
            fields = [each for each in node.body if isinstance(each, ast.AnnAssign)]
            return [field.target.id for field in fields]
        node = makers[0]
    spec = node.args
    names = [each.arg for each in (*spec.posonlyargs, *spec.args)]
    names += [f"*{spec.vararg.arg}"] if spec.vararg else []
    names += [each.arg for each in spec.kwonlyargs]
    names += [f"**{spec.kwarg.arg}"] if spec.kwarg else []
    return [name for name in names if name not in {"self", "cls"}]


def documented(docstring):
    """Return the names in a docstring's section Parameters, None if it has none."""
    lines = inspect.cleandoc(docstring).splitlines()
    if UNDERLINE not in lines or "Parameters" not in lines:
        return None
    start = lines.index("Parameters") + 1
    assert lines[start] == UNDERLINE
    names = []
    for line, below in zip(lines[start + 1 :], [*lines[start + 2 :], ""], strict=True):
        if below and set(below) == {"-"}:  # the next section's title
            break
        if line and not line.startswith(" "):
            names += line.partition(" : ")[0].split(", ")
    return [name.strip().replace("\\", "") for name in names]


def test_the_parser_reads_a_section():
    docstring = """Do it.

    Parameters
    ----------
    one, two : (N,) float
        Numbers, of which
        some : are odd.
    three
    **more : Any

    Returns
    -------
    four : int
    """
    assert documented(docstring) == ["one", "two", "three", "**more"]
    assert documented("Do it.") is None
    function = ast.parse("def f(self, one, /, two, *three, four=1, **more): ...").body[
        0
    ]
    assert parameters_of(function) == ["one", "two", "*three", "four", "**more"]


def public():
    for path in PUBLIC:
        for title, node in public_parts(ast.parse(path.read_text(encoding="utf-8"))):
            yield f"{path.relative_to(ROOT)}: {title}", node


def test_all_that_is_public_has_a_docstring():
    found = list(public())
    assert len(found) > 200
    silent = [title for title, node in found if not ast.get_docstring(node)]
    assert not silent, "; ".join(silent)


def test_sections_name_exactly_the_parameters():
    wrong, n_sections = [], 0
    for title, node in public():
        named = documented(ast.get_docstring(node) or "")
        if named is None:
            continue
        n_sections += 1
        if named != parameters_of(node):
            wrong.append(f"{title} tells of {named}, has {parameters_of(node)}")
    assert n_sections > 50
    assert not wrong, "; ".join(wrong)
