"""Figures of the paper's study, a module `fig*` each, and the parts that all figures share."""
