"""One study: its configuration, what its grids permit, the paths and lists of its files."""
