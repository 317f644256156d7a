"""Pages that answer the question of a study, each self-contained, and their numbers."""

from pathlib import Path

#: The folder of texts for readers: templates, captions, chapters.
TEXTS = Path(__file__).parents[2] / "report"
