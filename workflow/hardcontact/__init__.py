"""From AFM scans to pull-off forces, the work and range of adhesion, and the critical band.

The rooms, each of which imports only from those above it: `random` and `statistics`, `records`,
`surfaces`, `contact`, `adhesion`, `claims`, `figures`, `study`.
"""
