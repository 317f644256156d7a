"""Statements of the paper: the numbers they are about, the verdicts, the pages that show them."""
