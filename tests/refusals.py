"""Refusals of bad input: one line a fault that says what was expected."""

import pytest


def refusal(call, *arguments):
    """Return the lines with which a call refuses its input: each says what was expected."""
    with pytest.raises(ValueError) as caught:
        call(*arguments)
    message = str(caught.value)
    assert message and all("expected" in line for line in message.splitlines()), message
    return message


def assert_says(message, *parts):
    """Expect all parts in a message."""
    for part in parts:
        assert part in message, message
