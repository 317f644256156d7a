"""The answer of the paper's study: its numbers, and its pages of claims, figures and chapters."""
