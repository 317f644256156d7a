"""From AFM scans to pull-off forces, the work and range of adhesion, and the critical band.

The rooms, each of which imports only from those before it: `random` and `statistics`; `published`,
what the paper printed; `records`, how files are written; `surfaces`; `contact`; `adhesion`, forces;
`scales`, the critical band; `inference`, range and work of adhesion; `classical` models;
`own_surfaces`; `insight`, what decides the band; `claims`; `sets` of substitutes; `figures`;
`answer`, the pages; `study`, all that the rules import.
"""
