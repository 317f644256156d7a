"""The one page that answers what a study asked."""
