"""Variables of datasets with known intervals."""

import numpy as np

from hardcontact.base.statistics import as_variables


def between_multiples(name, dimensions, value, multiples, confidence=0.95, **attributes):
    """Return a variable, and its interval between two multiples of its value."""
    value = np.array(value, float)
    interval = np.stack([multiple * value for multiple in multiples], axis=-1)
    return as_variables(name, dimensions, value, interval, attributes, confidence)
