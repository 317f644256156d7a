"""A page as a browser sees it: tags, texts, pictures, links and rows of tables."""

import posixpath
import re
from html.parser import HTMLParser

#: Elements that have no end.
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}


class Page(HTMLParser):
    """A parsed page; every element must have its end.

    `attributes` and `texts` have the attributes and the text of every element, by tag; `rows` has
    the texts of the cells of every row; `open_elements` are tags and indices in `texts`.
    """

    def __init__(self, html):
        super().__init__()
        self.attributes, self.texts, self.rows, self.open_elements = {}, {}, [], []
        self.feed(html)
        self.close()
        assert self.open_elements == [], self.open_elements

    def handle_starttag(self, tag, attributes):
        self.attributes.setdefault(tag, []).append(dict(attributes))
        self.texts.setdefault(tag, []).append("")
        if tag not in VOID:
            self.open_elements.append((tag, len(self.texts[tag]) - 1))
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert tag not in VOID and self.open_elements.pop()[0] == tag, (tag, self.getpos())

    def handle_data(self, data):
        data = re.sub(" *\n *", " ", data)  # as browsers show it
        for tag, index in self.open_elements:
            self.texts[tag][index] += data
        if {"td", "th"} & {tag for tag, _ in self.open_elements}:
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
    """Return the pages, and their links, that lead to no anchor of a page and to none of the files.

    `pages` has the HTML of each page by its path in a study; `files` are paths of other files.
    """
    anchors = {path: set(Page(html).values("id")) for path, html in pages.items()}
    dead = []
    for path, html in pages.items():
        for link in Page(html).values("href"):
            name, _, anchor = link.partition("#")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
            target = target if name else path
            leads_to_file = link.startswith("https:") or target in files
            leads_to_anchor = target in anchors and anchor in anchors[target] | {""}
            if not leads_to_file and not leads_to_anchor:
                dead.append((path, link))
    return dead
