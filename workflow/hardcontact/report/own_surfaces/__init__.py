"""The answer of a study of your surfaces: its numbers, cautions, figures and page."""
