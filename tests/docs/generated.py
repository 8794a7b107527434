#!/usr/bin/env python3
"""Checks that the pages of results are what tools/measure/pages.py makes of their templates, claims and results. First shows,
on a small tree with planted mistakes, that it notices them.
  generated.py SOURCE_TREE"""
import os
import sys
import tempfile

from links import read

sys.path.insert(0, os.path.join(sys.argv[1], "tools/measure"))
from claims import ClaimError, Tree, write  # noqa: E402
from pages import rendered  # noqa: E402

CLAIM = """
title = "Errors"
columns = [["dataset", "{name}"], ["mean", "{tracked.mean:.1f}"], ["spread, {tracked.runs} seeds", "{tracked.mean.range:.1f}"],
           ["max", "{tracked.max:.1f}"], ["lost", "{tracked.lost.span}"], ["hidden", "{tracked.hidden}"]]
[runs.tracked]
[rows.a]
[rows.b]
name = "another"
"""
TEMPLATE = "# Page\n\n{{claim errors}}\n\nThe error is {{value errors.a.tracked.mean:.2f}} mm.\n\n{{measured}}\n"
FIGURES = {"a": {"tracked": {"mean": 1.26, "max": 2.0, "lost": 3, "runs": 2, "ranges": {"mean": [1.21, 1.38], "lost": [0, 4]}}},
           "b": {"tracked": {"mean": 7.0, "lost": 5}}}
MEASURED = {"version": "1.2.3", "date": "2026-02-01", "machine": "a machine"}
PAGE = """# Page

<!-- Made by tools/measure/pages.py from tools/measure/pages/page.md.in: do not edit. -->

## Errors

| dataset | mean | spread, 2 seeds | max | lost |
|---|---|---|---|---|
| `a` | 1.3 | 1.2–1.4 | 2.0 | 0–4 |
| another | 7.0 | – | – | 5 |

    tools/measure/measure.py RECORDINGS OUT errors

The error is 1.26 mm.

All tables: version 1.2.3, 1 February 2026, a machine.
"""


def small_tree(root):
    """A tree with one page, one claim and its results."""
    tree = Tree(root)
    for folder in (tree.claims, tree.templates, tree.results):
        os.makedirs(folder)
    write(os.path.join(tree.claims, "errors.toml"), CLAIM)
    write(os.path.join(tree.templates, "page.md.in"), TEMPLATE)
    tree.store("errors", {"measured": MEASURED, "rows": FIGURES})
    write(os.path.join(tree.pages, "page.md"), PAGE)
    return tree


def differences(tree):
    """Which pages are not what their template and the results give."""
    for name, text in rendered(tree).items():
        path = os.path.join(tree.pages, name + ".md")
        if not os.path.exists(path) or read(path) != text:
            yield f"docs/{name}.md is not what tools/measure/pages.py makes: edit its template or claims, and run it"


def found_in(tree):
    try:
        return "\n".join(differences(tree))
    except ClaimError as error:
        return str(error)


def prove_that_it_can_fail():
    """Each planted mistake: a file, what is replaced in it, and what is said about it."""
    planted = [
        ("docs/page.md", "1.3", "1.2", "docs/page.md is not what"),
        ("docs/measured/errors.json", "1.26", "1.46", "docs/page.md is not what"),
        ("docs/measured/errors.json", '"b"', '"c"', "its rows are not those of the claim"),
        ("tools/measure/claims/errors.toml", "tracked.max", "tracked.maximum", "there is no figure tracked.maximum"),
        ("tools/measure/claims/errors.toml", "{tracked.max", "{run.max", "there is no figure run.max"),
        ("tools/measure/claims/errors.toml", "{name}", "{hand}", "the row a does not say its hand"),
        ("tools/measure/claims/errors.toml", 'title = "Errors"', "", "has no title"),
        ("tools/measure/pages/page.md.in", "{{claim errors}}", "", "stands on 0 pages"),
        ("tools/measure/pages/page.md.in", "{{claim errors}}", "{{claim errors}}\n{{claim errors}}", "twice"),
        ("tools/measure/pages/page.md.in", "{{claim errors}}", "{{claim error}}", "there is no claim error"),
        ("tools/measure/pages/page.md.in", "{{measured}}", "{{measure}}", "means nothing"),
        ("tools/measure/pages/page.md.in", "errors.a.tracked.mean", "errors.b.tracked.max", "was not measured"),
    ]
    with tempfile.TemporaryDirectory() as root:
        found = found_in(small_tree(root))
        assert not found, f"the check itself is broken: it rejects a page that is fine: {found}"
    for path, before, after, said in planted:
        with tempfile.TemporaryDirectory() as root:
            tree = small_tree(root)
            path = os.path.join(root, path)
            text = read(path)
            assert before in text, f"the check itself is broken: {path} has no {before}"
            write(path, text.replace(before, after, 1))
            found = found_in(tree)
            assert said in found, f"the check itself is broken: of {path} with {after} it says '{found}'"


def main(root):
    prove_that_it_can_fail()
    found = found_in(Tree(root))
    print(found or "all pages are what their templates, claims and results give")
    sys.exit(1 if found else 0)


main(sys.argv[1])
