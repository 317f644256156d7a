"""Refusals of bad input: one line that says what was expected."""

import pytest


def refusal(call, *arguments):
    """Return the one line with which a call refuses its input."""
    with pytest.raises(ValueError) as caught:
        call(*arguments)
    message = str(caught.value)
    assert len(message.splitlines()) == 1, message
    return message


def assert_says(message, *parts):
    """Expect all parts in a message."""
    for part in parts:
        assert part in message, message
