#!/usr/bin/env python3
"""Renders the pages of results: writes docs/NAME.md for every tools/measure/pages/NAME.md.in, with the claims and their results.
  tools/measure/pages.py"""
import os
import re
import sys
import textwrap

from claims import ROOT, ClaimError, Tree, read, write
from section import Section, shown

PLACEHOLDER = re.compile(r"\{\{(\w+)(?: ([^}]*))?\}\}")
WIDTH = 120
MONTHS = "January February March April May June July August September October November December".split()


def days(dates):
    """A date, or a range of dates separated by a slash, in words."""
    words = []
    for date in dates.split("/"):
        year, month, day = date.split("-")
        words.append(f"{int(day)} {MONTHS[int(month) - 1]} {year}")
    return " to ".join(words)


def listed(words):
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


class Page:
    """A page and the claims that it shows."""

    def __init__(self, tree, name):
        self.tree, self.name = tree, name
        self.sections = {}
        self.figures = 0

    def section(self, name):
        if name not in self.sections:
            self.sections[name] = Section(self.tree, name)
        return self.sections[name]

    def text(self):
        template = read(os.path.join(self.tree.templates, self.name + ".md.in"))
        with_claims = PLACEHOLDER.sub(self.insert_claim, template)
        shown_claims = list(self.sections)
        paragraphs = re.split(r"(\n\n|\n(?=- ))", with_claims)
        text = "".join(self.filled(paragraph, shown_claims) for paragraph in paragraphs)
        title, rest = text.split("\n", 1)
        mark = f"<!-- Made by tools/measure/pages.py from tools/measure/pages/{self.name}.md.in: do not edit. -->"
        return f"{title}\n\n{mark}\n{rest}"

    def filled(self, paragraph, shown_claims):
        """The paragraph with values inserted for its placeholders, wrapped to WIDTH."""
        text = PLACEHOLDER.sub(lambda found: self.insert_value(found, shown_claims), paragraph)
        if "{{value" not in paragraph:
            return text
        return textwrap.fill(" ".join(text.split()), WIDTH, subsequent_indent="  " if text.startswith("- ") else "",
                             break_long_words=False, break_on_hyphens=False)

    def insert_claim(self, found):
        kind, argument = found.groups()
        if kind != "claim":
            return found[0]
        if argument in self.sections:
            raise ClaimError(f"{self.name}.md.in: shows the claim {argument} twice")
        return self.section(argument).text()

    def insert_value(self, found, shown_claims):
        kind, argument = found.groups()
        if kind == "number":
            self.figures += 1
            return str(self.figures)
        if kind == "measured":
            return self.measured([self.section(name) for name in shown_claims])
        if kind == "value":
            return self.value(argument)
        raise ClaimError(f"{self.name}.md.in: {found[0]} means nothing: there are claim, value and measured")

    def value(self, argument):
        """The text for a placeholder {{value CLAIM.ROW.RUN.FIGURE:FORM}}."""
        path, _, form = argument.partition(":")
        claim, row, rest = path.split(".", 2)
        section = self.section(claim)
        value = section.figure(row, rest) if row in section.rows else None
        if value is None:
            raise ClaimError(f"{self.name}.md.in: {path} was not measured")
        return shown(value, form)

    @staticmethod
    def measured(sections):
        """The version, date and machine with which the tables of a page were measured, grouped by measurement."""
        groups, exceptions = {}, []
        for section in sections:
            measured, title = section.results["measured"], f"*{section.claim['title']}*"
            groups.setdefault((measured["version"], measured["date"], measured["machine"]), []).append(title)
            if "except" in measured:
                exceptions.append(f"{title}: {measured['except']}.")
        sentences = [f"{listed(titles) if len(groups) > 1 else 'All tables'}: version {version}, {days(date)}, {machine}."
                     for (version, date, machine), titles in groups.items()] + exceptions
        mark, indent = ("- ", "  ") if len(sentences) > 1 else ("", "")
        return "\n".join(textwrap.fill(mark + sentence, WIDTH, subsequent_indent=indent) for sentence in sentences)


def page_names(tree):
    return sorted(name.removesuffix(".md.in") for name in os.listdir(tree.templates) if name.endswith(".md.in"))


def rendered(tree):
    """The text of every page by its name. Raises ClaimError if a claim is not on exactly one page."""
    texts, shown_on = {}, {}
    for name in page_names(tree):
        page = Page(tree, name)
        texts[name] = page.text()
        for claim in re.findall(r"\{\{claim (\w+)\}\}", read(os.path.join(tree.templates, name + ".md.in"))):
            shown_on.setdefault(claim, []).append(name)
    for claim in tree.claim_names():
        pages = shown_on.get(claim, [])
        if len(pages) != 1:
            raise ClaimError(f"the claim {claim} stands on {len(pages)} pages: put {{{{claim {claim}}}}} into one of "
                             "tools/measure/pages")
    return texts


def main():
    tree = Tree(ROOT)
    try:
        for name, text in rendered(tree).items():
            write(os.path.join(tree.pages, name + ".md"), text)
    except ClaimError as error:
        sys.exit(f"pages.py: {error}")


if __name__ == "__main__":
    main()
