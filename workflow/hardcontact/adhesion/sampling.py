"""Samples of what is uncertain: how many, from which random numbers, for which confidence."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hardcontact.random import generator
from hardcontact.statistics import percentile_interval, with_interval

__all__ = ["Sampling"]


@dataclass(frozen=True)
class Sampling:
    """How intervals follow from random samples.

    A sample is drawn about the mean over scans or realizations, as `student_log_samples` does, or
    from the distribution of published numbers within their uncertainty.

    Attributes
    ----------
    seed : int
        The seed of the study.
    samples : int
        How many are drawn; without any, all intervals are NaN.
    confidence : float
        Of the intervals.
    stream : tuple of str
        What the random numbers are for, before the names of `generator`.
    """

    seed: int
    samples: int
    confidence: float
    stream: tuple[str, ...] = ("sampling",)

    def generator(self, *names: str) -> np.random.Generator:
        """Return the random generator for one of the quantities that are sampled."""
        return generator(self.seed, *self.stream, *names)

    def with_interval(
        self,
        name: str,
        dimensions: str | Sequence[str],
        value: ArrayLike,
        samples: ArrayLike,
        attributes: dict[str, Any],
    ) -> dict[str, Any]:
        """Return the variables `name` and `name_interval` of a value and its samples.

        Parameters
        ----------
        name : str
            Of the variable.
        dimensions : str or sequence of str
            Of the value, without `bound`.
        value : array_like
            Of all data.
        samples : array_like
            (sample, ...) values of each sample.
        attributes : dict
            Units and long name.

        Returns
        -------
        dict
            The two variables, ready for `xarray.Dataset`.
        """
        interval = percentile_interval(samples, self.confidence)
        return with_interval(name, dimensions, value, interval, attributes, self.confidence)
