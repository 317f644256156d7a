"""All faults at once."""

import pytest

from hardcontact.config.configuration import refuse_all


def refusing(text):
    def refuse():
        raise ValueError(text)

    return refuse


def test_every_fault_is_told_once_in_its_order():
    checks = [refusing("b: expected"), lambda: None, refusing("a: expected\nb: expected")]
    with pytest.raises(ValueError) as caught:
        refuse_all(checks)
    assert str(caught.value) == "b: expected\na: expected"


def test_no_fault_is_no_error():
    refuse_all([lambda: None])


def test_other_errors_are_not_faults_of_the_input():
    with pytest.raises(ZeroDivisionError):
        refuse_all([lambda: 1 / 0])
