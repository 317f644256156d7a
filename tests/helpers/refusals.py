"""Refusals of faulty input have one line per fault, with the expected input."""

import pytest

#: Ten lines, each of ten times the line before: 1, 11, 111, ... values, in all 1.23e9.
NESTED_ALIASES = b"a0: &a0 1\n" + b"".join(
    b"a%d: &a%d [%s]\n" % (n, n, b", ".join([b"*a%d" % (n - 1)] * 10)) for n in range(1, 10)
)


def refusal(call, *arguments):
    """Return the message of a call that refuses its input; each line but a count has "expected"."""
    with pytest.raises(ValueError) as caught:
        call(*arguments)
    message = str(caught.value)
    lines = [line for line in message.splitlines() if not line.endswith("not shown")]
    assert lines and all("expected" in line for line in lines), message
    return message


def assert_line_says(lines, *parts):
    """Expect all parts in one of the lines."""
    assert any(all(text in line for text in parts) for line in lines), (parts, lines)


def assert_says(message, *parts):
    """Expect all parts in a message."""
    for text in parts:
        assert text in message, message
