# SPDX-License-Identifier: BSD-3-Clause
"""Names that do harm where they reach a shell, a page or a yaml file as they are, and a page's parser."""

from html.parser import HTMLParser

# Of topics, frames and files. Each would create the file `pwned` if a shell or Python ran it.
NAMES = (
    "a;touch pwned && touch pwned | touch pwned #",
    "$(touch pwned) `touch pwned`",
    "it's",
    'a "quoted" \\ one',
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>&lt;b&gt;',
    "two\nlines: true",
    "{braces} %s %(x)s {{ 7 * 7 }} $E=mc^2$",
    "*",
    "~ straße 北",
)
EVENT = "on"  # how the attributes that hold a script begin
RUN = ("javascript:", "vbscript:")


class Page(HTMLParser):
    """The elements of a page, its text, and what in it would run a script."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.tags, self.text, self.active = set(), "", []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        if tag in ("script", "iframe", "object", "embed"):
            self.active.append(tag)
        self.active += [
            f"{tag} {name}={value}" for name, value in attrs
            if name.startswith(EVENT) or (value or "").strip().lower().startswith(RUN)
        ]  # fmt: skip

    def handle_data(self, data):
        self.text += data
