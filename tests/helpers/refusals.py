"""Refusals of faulty input have one line per fault, with the expected input."""

import pytest


def refusal(call, *arguments, **options):
    """Return the message of a call that refuses its input."""
    with pytest.raises(ValueError) as caught:
        call(*arguments, **options)
    message = str(caught.value)
    lines = [line for line in message.splitlines() if not line.endswith("not shown")]
    assert lines and all("expected" in line for line in lines), message
    return message


def assert_says(message, *parts):
    """Expect all parts in a message."""
    for text in parts:
        assert text in message, message
