"""All faults of the user's input at once, a line each."""

from collections.abc import Callable, Iterable

__all__ = ["refuse_all"]


def refuse_all(checks: Iterable[Callable[[], object]]) -> None:
    """Carry out all checks, and tell every fault that they find.

    Parameters
    ----------
    checks : iterable of callable
        Each raises a ValueError of one line a fault.

    Raises
    ------
    ValueError
        With the lines of all, each once.
    """
    faults: list[str] = []
    for one in checks:
        try:
            one()
        except ValueError as error:
            faults += str(error).splitlines()
    if faults:
        raise ValueError("\n".join(dict.fromkeys(faults)))
