#!/usr/bin/env python3
"""Checks that the pages of a source tree can be read: no sentence above 40 words, no page above 1,200 words (but for the
reference pages named below), no commit hash. First shows, on a page with planted mistakes, that it notices them.
  style.py SOURCE_TREE"""
import os
import re
import sys

from links import pages_of, read, without_code_blocks

LONGEST_SENTENCE, LONGEST_PAGE = 40, 1200  # words
LONG_PAGES = {"docs/formats.md", "docs/method.md", "CHANGELOG.md"}
HASH = re.compile(r"\b(?=[0-9a-f]*[0-9])(?=[0-9a-f]*[a-f])[0-9a-f]{7,40}\b")
START_OF_PARAGRAPH = re.compile(r"\s*(?:[-*]|\d+\.)\s|#")


def words(text):
    return [word for word in text.replace("|", " ").split() if re.search(r"\w", word)]


def paragraphs(text):
    """Paragraphs, headings, items of lists and cells of tables of a page without its code blocks."""
    current = ""
    for line in text.split("\n"):
        if line.startswith("|"):
            yield from line.strip("|").split("|")
        elif not line.strip() or START_OF_PARAGRAPH.match(line):
            yield current
            current = line
        else:
            current += " " + line
    yield current


def mistakes_of(page, text):
    count = len(words(text))
    if count > LONGEST_PAGE and page not in LONG_PAGES:
        yield f"{page}: has {count} words"
    for paragraph in paragraphs(without_code_blocks(text)):
        prose = re.sub(r"\]\([^)]*\)", "]", paragraph)
        for sentence in re.split(r"(?<=[.!?:])\s+", prose):
            if len(words(sentence)) > LONGEST_SENTENCE:
                yield f"{page}: a sentence of {len(words(sentence))} words: {sentence.strip()[:80]} ..."
    for commit in HASH.findall(text):
        yield f"{page}: names the commit {commit}"


def prove_that_it_can_fail():
    long = "word " * (LONGEST_SENTENCE + 1)
    page = f"# Title\n{long}end. Short.\n\n- {long}\n\n| cell | {long}|\n\nSince a1b2c3d.\n" + "Short. " * LONGEST_PAGE
    found = list(mistakes_of("page.md", page))
    assert len(found) == 5, f"the check itself is broken: it found {found}"
    fine = f"{'word ' * LONGEST_SENTENCE}. `1000000` is no commit.\n\n    {long}\n"
    assert not list(mistakes_of("page.md", fine)), "the check itself is broken: it rejects a page that is fine"


def main(root):
    prove_that_it_can_fail()
    problems = [problem for page in pages_of(root) for problem in mistakes_of(page, read(os.path.join(root, page)))]
    print("\n".join(problems) or "all pages are within their limits")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main(sys.argv[1])
