import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.hull_names import hull_names
from weak_convex_decomposition.core.parameters.hulls import HullParameters


def test_templates_of_endless_names_are_refused():
    for template in ("{n:99999999999d}", "{n:200000d}", "{name:.>256}", "x" * 300):
        with pytest.raises(
            DecompositionError, match=r"more than 255 char.*shorten it\.$"
        ):
            HullParameters(naming="TEMPLATE", template=template)


def test_long_names_of_objects_are_no_fault_of_the_template():
    name = "x" * 255
    for naming in ("PLAIN", "TEMPLATE"):
        first, second = hull_names(naming, "{name}_{n:03d}", name, ("HULL", "BOX"))
        assert first.startswith(name)
        assert first != second


def test_a_field_cannot_say_how_wide_another_one_is():
    for template in ("{n:{n}000000000}", "{name:>{n}}"):
        with pytest.raises(DecompositionError, match=r"cannot be filled in; write"):
            HullParameters(naming="TEMPLATE", template=template)
