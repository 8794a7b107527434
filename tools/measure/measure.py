#!/usr/bin/env python3
"""Measures claims of the documentation, and writes what was found to docs/measured. Then tools/measure/pages.py makes the pages.
  tools/measure/measure.py RECORDINGS OUT CLAIM...             measures tools/measure/claims/CLAIM.toml
  tools/measure/measure.py RECORDINGS OUT --print [CLAIM...]   only prints the commands"""
import argparse
import datetime
import json
import os
import re
import shutil
import signal
import subprocess
import sys

import figures
from claims import ROOT, ClaimError, Tree, read, read_toml

MADE = re.compile(r"\$OUT/([\w.]+)")
JOINED = ("track", "eval")  # options of the claim, of a row and of a run come one after the other


def machine():
    """How many cores of which processor, with which vector instructions."""
    about = read("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.+)", about)
    flags = re.search(r"flags\s*: (.+)", about)
    vectors = "AVX-512" if flags and "avx512f" in flags[1] else "AVX2" if flags and "avx2" in flags[1] else "no AVX2"
    cores = len(os.sched_getaffinity(0))
    return f"{cores} core{'s' if cores > 1 else ''} of {model[1].strip() if model else 'a processor'} with {vectors}"


class Runner:
    """Runs the lines of claims with one program."""

    def __init__(self, tree, program, recordings, out, printing):
        self.tree, self.printing = tree, printing
        self.program, self.out = os.path.abspath(program), os.path.abspath(out)
        self.rules = read_toml(tree.prepared)
        self.ready = set()   # names that a rule makes
        self.tracked = {}    # line of track without its result: the result
        folder = os.path.dirname(self.program)
        self.environment = {**os.environ, "OUT": self.out, "RECORDINGS": os.path.abspath(recordings),
                            "PATH": f"{folder}:{os.environ['PATH']}"}
        if not printing:
            os.makedirs(os.path.join(self.out, "runs"), exist_ok=True)

    def place(self, path):
        return path.replace("$OUT", self.out).replace("$RECORDINGS", self.environment["RECORDINGS"])

    def run(self, line, log):
        """Runs a line of bash, after what it needs of prepared.toml."""
        for name in MADE.findall(line):
            self.prepare(name)
        print(line, flush=True)
        if self.printing:
            return
        with open(self.place(log), "w", encoding="utf-8") as file:
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", line], cwd=self.tree.root, env=self.environment,
                                  stdin=subprocess.DEVNULL, stdout=file, stderr=file, check=False)
        if done.returncode:
            raise ClaimError(f"{self.place(log)}: the command ended with {done.returncode}: {line}")

    def prepare(self, name):
        """Makes $OUT/NAME by the first rule that matches, unless this program has made it before."""
        rule = next((rule for rule in self.rules if re.fullmatch(rule, name)), None)
        if rule is None or name in self.ready:
            return
        self.ready.add(name)
        mark = os.path.join(self.out, "runs", f"{name}.made")
        if not self.printing:
            if os.path.exists(mark) and os.path.getmtime(mark) > os.path.getmtime(self.program):
                return
            shutil.rmtree(os.path.join(self.out, name), ignore_errors=True)
        line = re.fullmatch(rule, name).expand(self.rules[rule])
        for needed in MADE.findall(line):
            if needed != name:
                self.prepare(needed)
        self.run(line, f"$OUT/runs/{name}.log")
        if not self.printing:
            os.close(os.open(mark, os.O_CREAT | os.O_TRUNC | os.O_WRONLY))

    def track(self, base, recording, how, output):
        """Tracks a recording, or takes what the same command gave before; returns the path without its ending."""
        hand = f"--hand {how['hand']}" if "hand" in how else ""
        line = " ".join(f"barehand track --source folder:{recording} --no-publish {hand} {how.get('track', '')}".split())
        line = line.replace("$RECORDING/", recording + "/")
        key = (line, output)
        if key not in self.tracked:
            self.run(f"{line} --overwrite {output[0]} {base}{output[1]}", base + ".log")
            self.tracked[key] = base
        return self.tracked[key]

    def compare(self, base, how, plots):
        """Tracks, and compares with the truth, with labels of fingertips, or what is stated with the truth."""
        recordings = how["recording"] if isinstance(how["recording"], list) else [how["recording"]]
        pairs = []
        for number, recording in enumerate(recordings):
            if isinstance(how.get("hands"), list):  # one for each recording
                how = {**how, "hand": how["hands"][number]}
            if how.get("fingertips"):
                result = self.track(base, recording, how, ("--result", ".csv"))
                pairs += [f"--fingertips {recording}/fingertips_2d.csv --recording {recording} --hand {how['hand']} "
                          f"--result {result}.csv"]
            elif how.get("states"):
                result = self.track(f"{base}.{os.path.basename(recording)}", recording, how, ("--states-log", ".lcmlog"))
                pairs += [f"--truth {recording}/truth.csv --states {result}.lcmlog"]
            else:
                result = self.track(base, recording, how, ("--result", ".csv"))
                pairs += [f"--truth {recording}/truth.csv --result {result}.csv"]
        line = f"barehand eval {' '.join(pairs)} --overwrite --json {base}.json {plots} {how.get('eval', '')}"
        self.run(" ".join(line.split()).replace("$RECORDING/", recordings[0] + "/"), base + ".eval.log")
        return result

    def repetition(self, base, how, plots):
        """The figures of one repetition of a run."""
        report, result = how.get("json", base + ".json"), None
        if "command" in how:
            self.run(how["command"].replace("$JSON", report), base + ".log")
        elif "json" in how:
            for name in MADE.findall(report):
                self.prepare(name)
        else:
            result = self.compare(base, how, plots)
        if self.printing:
            return {}
        try:
            found = figures.of_report(json.loads(read(self.place(report))), how.get("label"))
        except (OSError, KeyError, ValueError) as error:
            raise ClaimError(f"{self.place(report)}: {error}") from error
        if how.get("fingertips"):
            found["tracked"] = figures.frames_with_rows(self.place(result) + ".csv")
        return found

    def measure_run(self, name, how, plots):
        """The figures of a run, over its seeds or repetitions."""
        if "command" in how or "json" in how:
            repetitions = [how] * how.get("repeat", 1)
        else:
            seeds = how.get("seeds", 1)
            seeds = seeds if isinstance(seeds, list) else list(range(1, seeds + 1))
            repetitions = [{**how, "track": f"{how.get('track', '')} --seed {seed}"} for seed in seeds]
        return figures.together([self.repetition(f"$OUT/runs/{name}.{number}", one, plots if number == 0 else "")
                                 for number, one in enumerate(repetitions)])

    def measure(self, name):
        """Measures all runs of a claim, and stores its results."""
        claim = self.tree.claim(name)
        if "runs" not in claim:
            raise ClaimError(f"{name} is measured by hand: its commands are on its page, its figures in "
                             f"{self.tree.results_path(name)}")
        figure = claim.get("figure", {})
        rows = {}
        for row in claim["rows"]:
            rows[row] = {}
            for run in claim["rows"][row].get("only", claim["runs"]):
                plots = f"--plots $OUT/runs/{name}.plots" if figure.get("run") == f"{row}.{run}" else ""
                rows[row][run] = self.measure_run(f"{name}.{row}.{run}", merged(claim, row, run), plots)
        self.draw(name, figure)
        if not self.printing:
            version = subprocess.run([self.program, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
            self.tree.store(name, {"measured": {"version": version, "date": datetime.date.today().isoformat(),
                                                "machine": machine()}, "rows": rows})

    def draw(self, name, figure):
        """Copies the figures of a claim to the images of the pages."""
        for image, plot in figure.get("plots", {}).items():
            for needed in MADE.findall(plot):
                self.prepare(needed)
            self.run(f"cp {plot.replace('$PLOTS', f'$OUT/runs/{name}.plots')} docs/images/{image}", f"$OUT/runs/{name}.cp.log")


def merged(claim, row, run):
    """What is to be done for a run of a row: what the claim, the row and the run say, with {row} and the row's other texts
    in their places."""
    how = {}
    for part in (claim.get("all", {}), claim["rows"][row], claim["runs"][run]):
        for key, value in part.items():
            how[key] = f"{how[key]} {value}" if key in JOINED and key in how else value
    texts = {"row": row, **{key: value for key, value in claim["rows"][row].items() if isinstance(value, str)}}
    text = json.dumps(how)
    for key, value in texts.items():
        text = text.replace(f"{{{key}}}", json.dumps(value)[1:-1])
    return json.loads(text)


def arguments_of(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", metavar="RECORDINGS", help="folder of recordings")
    parser.add_argument("out", metavar="OUT", help="folder for what is made on the way; what can be used again is made once")
    parser.add_argument("claims", metavar="CLAIM", nargs="*", help="of tools/measure/claims")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/src/app/barehand"), help="path of barehand")
    parser.add_argument("--print", action="store_true", help="only print the commands, of all claims if none is given")
    arguments = parser.parse_intermixed_args(words)
    if not arguments.claims and not arguments.print:
        parser.error("give the claims to be measured")
    return arguments


def main(words):
    arguments = arguments_of(words)
    tree = Tree(ROOT)
    if arguments.print:
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # the output may be read in part, by head
    try:
        if os.path.basename(arguments.program) != "barehand" or not os.access(arguments.program, os.X_OK):
            raise ClaimError(f"{arguments.program} is not the program: build it, or give the path of barehand with --program")
        runner = Runner(tree, arguments.program, arguments.recordings, arguments.out, arguments.print)
        for name in arguments.claims or [name for name in tree.claim_names() if "runs" in tree.claim(name)]:
            runner.measure(name)
    except ClaimError as error:
        sys.exit(f"measure.py: {error}")


if __name__ == "__main__":
    main(sys.argv[1:])
