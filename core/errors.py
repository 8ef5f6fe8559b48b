"""The one error that is meant for the user's eyes."""


class DecompositionError(Exception):
    """One sentence to the artist: what is wrong, and what to do about it."""
