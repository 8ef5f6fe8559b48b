"""The one error whose text is shown to the user."""


class DecompositionError(Exception):
    """An error with one sentence for the user: what is wrong, and what to do."""
