"""The answer of a study of the user's surfaces: its numbers, cautions, figures and page."""
