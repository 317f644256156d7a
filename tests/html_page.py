"""What a browser makes of a page: its tags, texts, pictures, links and rows of tables."""

from html.parser import HTMLParser

#: Elements that have no end.
VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}


class Page(HTMLParser):
    """A page as it is read, whose every element ends where it has to.

    `attributes` are those of every element by its tag, `texts` what stands in them.
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
        for tag, place in self.inside:
            self.texts[tag][place] += data
        if {"td", "th"} & {tag for tag, _ in self.inside}:
            self.rows[-1][-1] += data + " "

    def values(self, name):
        """All values of an attribute, of whatever elements."""
        return [of[name] for every in self.attributes.values() for of in every if name in of]
