"""Makes the checkout importable under its extension's name, whatever its folder."""

import importlib.util
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = "weak_convex_decomposition"


def register_package() -> None:
    """Load the root of the checkout as a package."""
    spec = importlib.util.spec_from_file_location(
        PACKAGE, ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = module
    spec.loader.exec_module(module)


register_package()
