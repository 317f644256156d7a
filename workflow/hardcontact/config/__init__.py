"""The configuration of a study: its keys, tables and limits."""
