"""What is kept of every file: whole-file writing, provenance, logs, locks, code that made it."""
