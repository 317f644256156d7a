"""Figures of the paper's study, a module each, from final datasets and published tables alone.

`drawing`, `style`, `panels` and `values` also serve the figures of the user's surfaces.
"""
