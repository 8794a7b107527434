#!/usr/bin/env python3
"""Checks the pages of a source tree (every .md file): links to files and headings resolve, and files of the tree that a
page names in `backticks` exist. First shows, on pages with planted mistakes, that it notices them.
  links.py SOURCE_TREE"""
import os
import re
import subprocess
import sys
import tempfile

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)")
CODE = re.compile(r"`([^`\n]+)`")
FOLDERS = "src|stages|drivers|tests|docs|deploy|configs|lcmtypes|clients|web|cmake|tools"
NAMED_FILE = re.compile(rf"(?:{FOLDERS})/[\w./-]*\w")  # wildcards do not match as a whole
PLACEHOLDER = re.compile(r"\bNAME\b")


def without_code_blocks(text):
    """The text with fenced and indented code blocks blanked."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return "\n".join("" if line.startswith("    ") else line for line in text.split("\n"))


def anchors(text):
    """What the headings of a page are called in links, as GitHub and mkdocs make them."""
    titles = re.findall(r"^#+ +(.+)$", without_code_blocks(text), flags=re.M)
    return {re.sub(r"[^\w -]", "", re.sub(r"[`*]", "", title)).strip().lower().replace(" ", "-") for title in titles}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def mistakes_of_page(root, page):
    text = without_code_blocks(read(os.path.join(root, page)))
    folder = os.path.dirname(page)

    # Links to other pages, to files of the tree, and to headings.
    for target in LINK.findall(re.sub(CODE, "", text)):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(folder, name)) if name else page
        if not os.path.exists(os.path.join(root, path)):
            yield f"{page}: the link to {target} leads nowhere"
        elif anchor and anchor not in anchors(read(os.path.join(root, path))):
            yield f"{page}: {path} has no heading #{anchor}"

    # Files of the tree that are only named.
    for code in CODE.findall(text):
        word = code.split()[0]
        if PLACEHOLDER.search(word) or not NAMED_FILE.fullmatch(word):
            continue
        if not os.path.exists(os.path.join(root, word)):
            yield f"{page}: names {word}, which is not in the tree"


def pages_of(root):
    """The pages of a checkout; without git, all of the folder except what is built."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard", "*.md"],
                            capture_output=True, text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        return sorted(page for page in listed.stdout.split("\n") if page and os.path.exists(os.path.join(root, page)))
    found = []
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in ("build", ".git")]
        found += [os.path.relpath(os.path.join(folder, name), root) for name in files if name.endswith(".md")]
    return sorted(found)


def mistakes(root):
    return [mistake for page in pages_of(root) for mistake in mistakes_of_page(root, page)]


def prove_that_it_can_fail():
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, "docs"))
        with open(os.path.join(root, "README.md"), "w", encoding="utf-8") as file:
            file.write("# Title\n[good](docs/a.md#a-heading) [bad](docs/b.md) [bad](docs/a.md#none) [web](https://x.org/y)\n"
                       "`docs/a.md` is named, and so is `docs/none.h`; `docs/*.md` and `docs/NAME` stand for others.\n")
        with open(os.path.join(root, "docs/a.md"), "w", encoding="utf-8") as file:
            file.write("## A heading\n[good](../README.md) [bad](README.md)\n\n    [code](nowhere.md)\n")
        found = mistakes(root)
    assert len(found) == 4, f"the check itself is broken: it found {found}"


def main(root):
    prove_that_it_can_fail()
    problems = mistakes(root)
    print("\n".join(problems) or "all links resolve")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main(sys.argv[1])
