"""Pages that answer the question of a study, each self-contained, and their numbers.

`own_surfaces` and `paper_study` are for one kind of study; the other modules serve both.
"""

from pathlib import Path

#: The folder of texts for readers: templates, captions, chapters.
TEXTS = Path(__file__).parents[2] / "report"
