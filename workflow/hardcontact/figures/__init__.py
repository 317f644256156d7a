"""The figures of the study, one module a figure, drawn from the aggregated datasets alone."""
