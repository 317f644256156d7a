"""Figures of the paper's study, a module each, from final datasets and published tables alone."""
