"""The error of a file that cannot be used, which every reader of scans raises."""


class RefusedFile(Exception):
    """A file that cannot be used; the text names what was expected and what was found."""
