"""The answer of a study of own surfaces: its numbers, cautions, figures and page."""
