"""Files on the disk: whether they are whole, who owns them, and how they change."""
