"""A run of the study: checks before it, files that it makes again, and how it ends."""
