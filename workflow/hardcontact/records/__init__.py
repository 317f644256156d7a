"""What is kept of every file: whole-file writing, provenance, logs, code that made it."""
