"""Range and work of adhesion, inferred from published forces; how robust they are."""
