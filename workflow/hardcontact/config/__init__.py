"""The configuration of a study: schema, limits, paths and lists of files."""
