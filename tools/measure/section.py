"""A claim with its results as a section of a page."""
import re

from claims import ClaimError
from figures import KNOWN

CELL = re.compile(r"\{([^{}:]+)(?::([^{}]+))?\}")  # matches {FIELD} and {RUN.FIGURE:FORM}
MEASURE = "tools/measure/measure.py RECORDINGS OUT"
NONE = "–"  # stands for a value that was not measured; also separates the ends of a range


def shown(value, form):
    """A figure as text. `form`: a format such as `.2f`, or `lost` for the number of lost frames, if any. A range is a
    dict with `low` and `high`."""
    if form == "lost":
        return f", {value} lost" if value else ""
    if isinstance(value, dict):
        low, high = (shown(value[end], form) for end in ("low", "high"))
        return low if low == high else f"{low}{NONE}{high}"
    if isinstance(value, list):
        return ", ".join(shown(one, form) for one in value)
    if isinstance(value, (int, float)):
        return format(value, form) if form else f"{value:,}"
    return "none" if value is None else value


class Section:
    """A claim and its results, as a part of a page."""

    def __init__(self, tree, name):
        self.name = name
        self.claim = tree.claim(name)
        self.results = tree.measured(name)
        self.rows = self.claim["rows"]
        self.runs = self.claim.get("runs")  # None: measured by hand
        if list(self.rows) != list(self.results["rows"]):
            raise ClaimError(f"{tree.results_path(name)}: its rows are not those of the claim: measure {name} again")

    def figure(self, row, path):
        """The value of RUN.FIGURE in a row; None if it was not measured. RUN.FIGURE.range is the range over the
        repetitions; RUN.FIGURE.span is that range, or the value if there was one repetition."""
        run, name, *kind = path.split(".")
        figures = self.results["rows"][row].get(run, {})
        ends = figures.get("ranges", {}).get(name)
        if not kind or kind == ["span"] and ends is None:
            return figures.get(name)
        if kind not in (["range"], ["span"]):
            raise ClaimError(f"{self.name}: {path} is no figure: RUN.FIGURE, RUN.FIGURE.range and RUN.FIGURE.span are")
        return ends and {"low": ends[0], "high": ends[1]}

    def cell(self, row, template):
        """The template with the texts and figures of a row inserted; a dash if a figure was not measured."""
        values = []
        for path, form in CELL.findall(template):
            if "." in path:
                value = self.figure(row, path)
                values.append(None if value is None else shown(value, form))
            elif path in self.rows[row] or path == "name":
                values.append(self.rows[row].get(path, f"`{row}`"))
            else:
                raise ClaimError(f"{self.name}: the row {row} does not say its {path}")
        if None in values:
            return NONE
        rest = iter(values)
        return CELL.sub(lambda _: next(rest), template).replace("$RECORDINGS", "RECORDINGS").replace("$OUT", "OUT")

    def check_names(self, template):
        """Raises ClaimError if the template names an unknown run or figure, which would otherwise look unmeasured."""
        for path, _ in CELL.findall(template):
            run, _, figure = path.partition(".")
            if figure and self.runs is not None and (run not in self.runs or figure.split(".")[0] not in KNOWN):
                raise ClaimError(f"{self.name}: there is no figure {path}: the runs are {', '.join(self.runs)}, and "
                                 "tools/measure/figures.py lists the figures")

    def heading(self, template):
        """The title of a column. A figure in it is shown as its range over all rows."""
        def over_all_rows(found):
            values = [self.figure(row, found[1]) for row in self.rows]
            values = [value for value in values if value is not None]
            return shown({"low": min(values), "high": max(values)}, found[2]) if values else NONE
        return CELL.sub(over_all_rows, template)

    def table(self):
        """The table; columns that were not measured are left out."""
        titles, columns = [], []
        for title, template in self.claim["columns"]:
            self.check_names(template)
            cells = [self.cell(row, template) for row in self.rows]
            if any(cell != NONE for cell in cells):
                titles.append(self.heading(title))
                columns.append(cells)
        lines = ["| " + " | ".join(cells) + " |" for cells in [titles, *zip(*columns)]]
        return "\n".join([lines[0], "|" + "---|" * len(titles), *lines[1:]])

    def commands(self):
        lines = self.claim.get("commands", [f"{MEASURE} {self.name}"])
        return "\n".join(f"    {line}" for line in lines)

    def text(self):
        """The section: heading, claim, table, commands, the paper's result, remarks and figure."""
        parts = [f"## {self.claim['title']}", self.claim.get("claim"), self.table(), self.commands()]
        parts += [self.claim.get("paper"), self.claim.get("remarks")]
        if "figure" in self.claim:
            figure = self.claim["figure"]
            parts += [f"![{figure['title']}](images/{figure['image']})",
                      f"*Figure {{{{number}}}}. {figure['caption'].strip()}*"]
        return "\n\n".join(part.strip("\n") for part in parts if part)
