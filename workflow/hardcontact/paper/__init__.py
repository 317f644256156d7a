"""Statements of the paper: the numbers that they are about, sets of substitutes, verdicts."""
