"""The answer of a study of the user's surfaces: its numbers, cautions, figures and page.

`edges`, `forces` and `fits` make numbers of `datasets`, `cautions` finds reasons to doubt numbers,
and `answer` joins numbers and cautions.
"""
