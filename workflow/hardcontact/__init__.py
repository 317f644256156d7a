"""Adhesion of hard, rough contacts: from height maps to pull-off forces and the scales that matter.

Its rooms, each importing only from those before it: `records`, `numbers`, `surfaces`, `contact`,
`adhesion`, `scales`, `inference`, `own_surfaces`, `insight`, `claims`, `sets`, `figures`, `answer`,
`config` and `commands`.
"""
