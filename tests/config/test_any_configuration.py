"""Any configuration is valid, or refused within seconds with a line for each fault."""

import re
import time

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from paper_numbers import SUBSTRATES
from repository import PAPER, ROOT, TINY, dotted_keys

from hardcontact.config.configuration import get_key, merge_overlay, numeric_configuration, set_keys
from hardcontact.config.selected_surfaces import selected_scans, surface_table
from hardcontact.run import checks

pytestmark = pytest.mark.usefixtures("project_folder")
KEYS = sorted(dotted_keys(PAPER))
SECTIONS = sorted({key.rpartition(".")[0] for key in KEYS})
#: A line of a message on a key or a file.
MESSAGE_LINE = re.compile(r"config key [^:]+: expected .+ found .+|\S+: .*expected .+ found.+")

#: The same examples in every run.
SETTINGS = settings(
    max_examples=30,
    deadline=None,
    derandomize=True,
    suppress_health_check=[
        HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.function_scoped_fixture
    ],
)  # fmt: skip

#: Values on which parsers fail: control characters, extreme numbers, unusual digits and units.
ODD_VALUES = [
    "", " ", "~", "null", "..", "/", "/dev/zero", "a\nb", "a\0b", "{scan}", "$x", "%s", "*", "\\",
    "'", "\t", "\x1b[31m", "\u2028", "é" * 300, "x" * 10**5, "1nm", "1 µm", "1e300 nm", "1e-300 nm",
    "-1 nm", "0 nm", "nan nm", "inf nm", "1" * 400 + " nm", "1 lb", "1 degC", "1 dBm", "1 nm nm",
    "5 uN m", "9**9**9 nm", "0x10 nm", "1_0 nm", "١ nm", "1 Å", "1e13 Pa", "all", "refuse", "uncd",
    -1, 0, 1, 2, 17, 64, 201, 4095, 8192, 16385, 32768, 10**9, 2**63, 10**400, 1.0, 0.5, 1e-300,
    1e300, -0.0, float("nan"), float("inf"), float("-inf"), True, False, None,
]  # fmt: skip
#: Text of few characters: Hypothesis needs seconds to prepare those of all Unicode.
LETTERS = "aZ09 .,:-_/#&*!|>%@`'\"{}[]\\\t\n\0\x1bµé\u2028١😀"
UNITS = ["nm", "um", "µm", "mm", "m", "pm", "Å", "N", "uN", "nN", "mN", "GPa", "MPa", "Pa", "s", ""]

odd_values = st.sampled_from(ODD_VALUES)
scalars = st.one_of(
    odd_values,
    st.integers(),
    st.floats(),
    st.text(LETTERS, max_size=30),
    st.dates(),
    st.binary(max_size=5),
    st.builds("{:.4g} {}".format, st.floats(1e-12, 1e12), st.sampled_from(UNITS)),
)
keys = st.one_of(st.text(LETTERS, max_size=5), st.integers(), st.booleans(), st.none(), odd_values)
values = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(keys, inner, max_size=4),
    max_leaves=12,
)


def nearby_values(value):
    """Return a strategy of values close to the paper's: scaled, repeated or in another order."""
    if isinstance(value, list):
        items = [nearby_values(item) for item in value] or [st.just(0)]
        return st.lists(st.one_of(items), max_size=5) | st.permutations(value)
    if isinstance(value, dict):
        return st.just(value)
    if isinstance(value, bool):
        return st.booleans()
    if isinstance(value, int | float):
        scaled = st.sampled_from([0.1, 0.25, 0.5, 0.99, 1, 1.01, 2, 4, 10]).map(lambda f: f * value)
        return scaled.map(round) if isinstance(value, int) else scaled
    if match := re.fullmatch(r"([\d.]+) (\w+)", value):
        return st.builds("{:.4g} {}".format, nearby_values(float(match[1])), st.just(match[2]))
    return st.sampled_from([value, *SUBSTRATES, "ruby", "laplacian", "profile", "harmonic"])


def check_in_time(config):
    """Return the message that refuses a study, or None if it is valid, in less than 5 s."""
    start = time.process_time()
    try:
        numbers = numeric_configuration(config)
        rows = surface_table(numbers["surfaces"])
        checks.check_study(numbers, selected_scans(rows, numbers["scans"]))
        message = None
    except ValueError as error:
        message = str(error)
        for line in message.splitlines():
            assert line.isprintable() and len(line) < 1500, message
            assert MESSAGE_LINE.fullmatch(line), message
    assert time.process_time() - start < 5
    return message


@pytest.mark.parametrize("file", ["config/config.yaml", "config/quick.yaml", TINY])
def test_the_study_of_the_paper_and_smaller_ones_are_valid(file):
    assert check_in_time(merge_overlay(PAPER, yaml.safe_load((ROOT / file).read_text()))) is None


@SETTINGS
@given(st.sampled_from(KEYS + SECTIONS), values)
def test_any_value_at_any_key_is_accepted_or_refused_with_the_key(key, value):
    message = check_in_time(set_keys(PAPER, {key: value}))
    assert message is None or message.startswith("config key")


@SETTINGS
@given(st.data())
def test_values_near_the_paper_s_become_numbers_or_are_refused(data):
    """Several keys have other values at once."""
    config = PAPER
    several_keys = st.lists(st.sampled_from(KEYS), min_size=1, max_size=6, unique=True)
    for key in data.draw(several_keys):
        config = set_keys(config, {key: data.draw(nearby_values(get_key(PAPER, key)))})
    if check_in_time(config) is None:
        numbers = numeric_configuration(config)
        for key in KEYS:
            value = get_key(numbers, key)
            for item in value if isinstance(value, list) else [value]:
                # The largest bound of a key is 1e13 Pa.
                assert isinstance(item, str | dict) or abs(item) <= 1e13
