"""Reads and writes the claims behind the pages of results: their declarations in tools/measure/claims and their results
in docs/measured. CONTRIBUTING.md ("Add a claim") describes both formats."""
import json
import os
import tomllib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))  # top folder of the source tree


class ClaimError(Exception):
    """The error for a wrong claim or page. Its message states what is wrong, where, and what to do."""


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    """Writes a file under a temporary name and then renames it, so that nobody reads an incomplete file."""
    with open(path + ".unfinished", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".unfinished", path)


def read_toml(path):
    try:
        return tomllib.loads(read(path))
    except tomllib.TOMLDecodeError as error:
        raise ClaimError(f"{path}: {error}") from error


class Tree:
    """The paths of claims, results and pages in a source tree."""

    def __init__(self, root):
        self.root = root
        self.claims = os.path.join(root, "tools/measure/claims")
        self.prepared = os.path.join(root, "tools/measure/prepared.toml")
        self.templates = os.path.join(root, "tools/measure/pages")
        self.results = os.path.join(root, "docs/measured")
        self.pages = os.path.join(root, "docs")

    def claim_names(self):
        return sorted(name.removesuffix(".toml") for name in os.listdir(self.claims) if name.endswith(".toml"))

    def claim(self, name):
        path = os.path.join(self.claims, name + ".toml")
        if not os.path.exists(path):
            raise ClaimError(f"there is no claim {name}: the claims are {', '.join(self.claim_names())}")
        claim = read_toml(path)
        for key in ("title", "columns", "rows"):
            if key not in claim:
                raise ClaimError(f"{path}: has no {key}")
        return claim

    def results_path(self, name):
        return os.path.join(self.results, name + ".json")

    def measured(self, name):
        """The results of a claim. Raises ClaimError if it was not measured yet."""
        path = self.results_path(name)
        if not os.path.exists(path):
            raise ClaimError(f"{path}: is missing: run tools/measure/measure.py with {name}")
        return json.loads(read(path))

    def store(self, name, results):
        """Writes the results of a claim, one line per run, so that a diff shows the runs whose figures have changed."""
        rows = []
        for row, runs in results["rows"].items():
            lines = [f"      {json.dumps(run)}: {json.dumps(figures)}" for run, figures in runs.items()]
            rows.append(f"    {json.dumps(row)}: {{\n" + ",\n".join(lines) + "\n    }")
        text = f'{{\n  "measured": {json.dumps(results["measured"])},\n  "rows": {{\n' + ",\n".join(rows) + "\n  }\n}\n"
        assert json.loads(text) == results
        os.makedirs(self.results, exist_ok=True)
        write(self.results_path(name), text)
