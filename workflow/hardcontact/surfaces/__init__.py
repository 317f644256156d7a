"""Height maps and spectra: levelling, metrics, filters, random surfaces, and substitutes.

Begin with `height_map` and `spectrum`. `levelling`, `metrics` and `filters` treat maps,
`synthesis` makes random surfaces and masters. A substitute (`substitutes`) has a spectrum from a
description (`substitute_spectra`), with `spectral_models`. Its scans meet Table 1 in batches, or
with bumps or pits from `features`.
"""
