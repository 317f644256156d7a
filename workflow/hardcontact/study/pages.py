"""The pages of the report that are no figures."""

__all__ = ["CHAPTERS", "PAGES"]

#: Chapters that are written beforehand, one Markdown file each in workflow/report.
CHAPTERS = ("departures", "methods", "performance", "cluster", "faults")

#: Category and title of each page in the report.
PAGES = {
    "claims": ("9. Verdicts", "verdicts on the paper's statements"),
    "departures": ("A. Departures, parameters", "where the study departs from the paper"),
    "parameters": ("A. Departures, parameters", "parameters and versions"),
    "methods": ("B. The study itself", "methods"),
    "performance": ("B. The study itself", "performance"),
    "cluster": ("B. The study itself", "on a cluster"),
    "faults": ("B. The study itself", "faults and what becomes of them"),
}
