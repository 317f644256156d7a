"""The pages of the report that are no figures."""

__all__ = ["CHAPTERS", "PAGES"]

#: Chapters that are written beforehand, one Markdown file each in workflow/report.
CHAPTERS = ("departures", "methods", "performance", "cluster", "faults")

#: Category and title of each page in the report.
PAGES = {
    "claims": ("8. Verdicts", "verdicts on the paper's statements"),
    "departures": ("9. Departures, parameters", "where the study departs from the paper"),
    "parameters": ("9. Departures, parameters", "parameters and versions"),
    "methods": ("10. The study itself", "methods"),
    "performance": ("10. The study itself", "performance"),
    "cluster": ("10. The study itself", "on a cluster"),
    "faults": ("10. The study itself", "faults and what becomes of them"),
}
