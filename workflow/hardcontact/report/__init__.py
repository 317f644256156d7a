"""Pages that answer the question of a study, each self-contained, and their numbers."""
