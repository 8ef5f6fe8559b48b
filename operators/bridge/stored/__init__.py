"""What a file keeps of ours: notes in custom properties."""
