"""Height maps and spectra: levelling, metrics, filters, random surfaces, and substitutes.

Begin with `height_map` and `spectrum`. `levelling`, `metrics` and `filters` treat maps,
`synthesis` makes random surfaces and masters. A substitute (`substitutes`) has a spectrum from a
description (`substitute_spectra`), with `spectral_models` and `table1_calibration`. Its scans meet
Table 1: by `conditioning`, or with bumps or pits from `features`.
"""
