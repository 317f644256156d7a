"""All faults at once."""

import pytest

from hardcontact.config.faults import refuse_all, refuse_lines


def refusing(text):
    def refuse():
        raise ValueError(text)

    return refuse


def test_every_fault_is_told_once_in_its_order():
    checks = [refusing("b: expected"), lambda: None, refusing("a: expected\nb: expected")]
    with pytest.raises(ValueError) as caught:
        refuse_all(checks)
    assert str(caught.value) == "b: expected\na: expected"


def test_of_very_many_faults_the_first_are_told():
    with pytest.raises(ValueError) as caught:
        refuse_lines(f"line {number}: expected" for number in range(100_000))
    first, *_, last = str(caught.value).splitlines()
    assert first == "line 0: expected" and "99901 more" in last
    assert len(str(caught.value)) < 5000
    with pytest.raises(ValueError) as again:
        refuse_all([refusing(str(caught.value))])
    assert str(again.value) == str(caught.value)


def test_other_errors_are_not_faults_of_the_input():
    with pytest.raises(ZeroDivisionError):
        refuse_all([lambda: 1 / 0])
