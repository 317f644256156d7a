"""Variables of datasets with intervals that are known."""

import numpy as np

from hardcontact.base.statistics import as_variables


def between_multiples(name, dimensions, value, multiples, confidence=0.95, **attributes):
    """Return a variable and an interval between two multiples of it."""
    value = np.array(value, float)
    interval = np.stack([multiple * value for multiple in multiples], axis=-1)
    return as_variables(name, dimensions, value, interval, attributes, confidence)
