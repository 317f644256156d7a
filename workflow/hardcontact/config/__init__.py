"""The configuration of a study: model, limits, paths and lists of files."""
