"""What comes back: types of all results, and what their numbers say."""
