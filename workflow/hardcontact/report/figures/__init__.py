"""Figures, a module each, drawn from the final datasets and the published tables alone."""
