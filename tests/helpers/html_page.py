"""A page as a browser sees it: tags, texts, pictures, links and rows of tables."""

import posixpath
from html.parser import HTMLParser

#: Elements that have no end.
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}


class Page(HTMLParser):
    """A parsed page; every element must have its end.

    `attributes` and `texts` have the attributes and the text of every element, by tag.
    """

    def __init__(self, html):
        super().__init__()
        self.attributes, self.texts, self.rows, self.inside = {}, {}, [], []
        self.feed(html)
        self.close()
        assert self.inside == [], self.inside

    def handle_starttag(self, tag, attributes):
        self.attributes.setdefault(tag, []).append(dict(attributes))
        self.texts.setdefault(tag, []).append("")
        if tag not in VOID:
            self.inside.append((tag, len(self.texts[tag]) - 1))
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert tag not in VOID and self.inside.pop()[0] == tag, (tag, self.getpos())

    def handle_data(self, data):
        for tag, index in self.inside:
            self.texts[tag][index] += data
        if {"td", "th"} & {tag for tag, _ in self.inside}:
            self.rows[-1][-1] += data + " "

    def values(self, name):
        """Return all values of an attribute, of any element."""
        return [
            attributes[name]
            for elements in self.attributes.values()
            for attributes in elements
            if name in attributes
        ]


def dead_links(pages, files):
    """Return the links of pages that lead to no anchor of a page and to none of the other files.

    Pages are given by HTML, and other files alone, by their paths within a study.
    """
    anchors = {path: set(Page(html).values("id")) for path, html in pages.items()}
    dead = []
    for path, html in pages.items():
        for link in Page(html).values("href"):
            name, _, anchor = link.partition("#")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
            target = target if name else path
            alive = link.startswith("https:") or target in files
            if not alive and not (target in anchors and {anchor} <= anchors[target] | {""}):
                dead.append((path, link))
    return dead
