"""The numbers, figures and self-contained pages that answer the question of a study."""

from pathlib import Path

#: The folder of texts for readers: templates, captions, chapters.
TEXTS = Path(__file__).parents[2] / "report"
