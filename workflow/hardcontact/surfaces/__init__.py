"""Height maps and spectra: levelling, metrics, filters, random surfaces, and substitutes.

`height_map` and `spectrum` define both; `streaks`, `levelling`, `metrics` and `filters` treat maps,
and `topography` gathers the metrics and spectra of all surfaces. `synthesis` makes random surfaces
and masters. A substitute (`substitutes`) has a spectrum from a description (`substitute_spectra`),
and scans that meet Table 1: from `conditioning`, or with bumps or pits from `featured_scans`.
"""
