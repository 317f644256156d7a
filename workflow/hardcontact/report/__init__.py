"""Pages that answer the question of a study, each self-contained, and their numbers.

`own_surfaces` and `paper_study` are for one kind of study; the other modules serve both.
"""
