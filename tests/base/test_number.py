"""Numbers are written as JSON, unknown numbers as None."""

import json
import math

from hardcontact.base.number import Number, json_value


def test_unknown_numbers_are_none_in_json():
    numbers = {
        "edges": [Number("short", 37.0, "nm", 30.0, math.inf), Number("long", math.nan, "nm")]
    }
    short, long = json.loads(json.dumps(json_value(numbers), allow_nan=False))["edges"]
    assert list(short) == ["name", "value", "unit", "low", "high", "status", "source"]
    assert (short["value"], short["low"], short["high"]) == (37.0, 30.0, None)
    assert (short["status"], long["status"], long["value"]) == ("known", "not_known", None)
    assert json_value(Number("force", math.nan, status="open_above"))["status"] == "open_above"
