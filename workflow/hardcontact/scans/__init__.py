"""Measured scans, and the spectrum of the surface that they show.

`reading` reads a file of any microscope in a child process: `open_file`, `plain_text` and
`point_grid` open it, `formats` and `heights` read its fields. `defects` finds faults of a scan,
`reliable_band` the wavelengths of its `measured_spectrum` that show the surface. `joined_spectrum`
joins the spectra of all scans by their `mean_spectrum`, and continues it by `extrapolation`.
`both_bodies` adds the roughness of the sphere.
"""
