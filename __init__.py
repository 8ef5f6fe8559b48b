"""Split meshes into weakly convex parts by lines of sight.

Nothing of the package is imported here at module level: enabling the add-on stays
quick, and the core works without Blender.
"""


def register() -> None:
    """Register the operators, the settings and the command, then the panels."""
    from . import operators, ui

    operators.register()
    ui.register()


def unregister() -> None:
    """Undo `register`, last thing first."""
    from . import operators, ui

    ui.unregister()
    operators.unregister()
