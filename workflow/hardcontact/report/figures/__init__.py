"""Figures of the paper's study, a module each, from final datasets and published tables alone.

`drawing`, `listing`, `style` and `panels` also serve the figures of the user's surfaces.
"""
