"""Runs the commands of claims: tracks, compares with the truth, and prepares files that several runs need."""
import json
import os
import re
import shutil
import subprocess

import figures
from claims import ClaimError, read, read_toml

MADE = re.compile(r"\$OUT/([\w.-]+)")


class Runner:
    """Runs the commands of claims with one build of the program, or only prints them."""

    def __init__(self, tree, program, recordings, out, printing):
        self.tree, self.printing = tree, printing
        self.program, self.out = os.path.abspath(program), os.path.abspath(out)
        self.rules = read_toml(tree.prepared)
        self.ready = set()  # names of the files that were prepared
        self.tracked = {}  # (command without its output, kind of output): path of the output without its ending
        folder = os.path.dirname(self.program)
        self.environment = {**os.environ, "OUT": self.out, "RECORDINGS": os.path.abspath(recordings),
                            "PATH": f"{folder}:{os.environ['PATH']}"}
        if not printing:
            os.makedirs(os.path.join(self.out, "runs"), exist_ok=True)

    def place(self, path):
        return path.replace("$OUT", self.out).replace("$RECORDINGS", self.environment["RECORDINGS"])

    def run(self, line, log):
        """Runs a bash command after preparing the files that it needs (prepared.toml)."""
        self.prepare_for(line)
        print(line, flush=True)
        if self.printing:
            return
        with open(self.place(log), "w", encoding="utf-8") as file:
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", line], cwd=self.tree.root, env=self.environment,
                                  stdin=subprocess.DEVNULL, stdout=file, stderr=file, check=False)
        if done.returncode:
            raise ClaimError(f"{self.place(log)}: the command ended with {done.returncode}: {line}")

    def prepare_for(self, text):
        """Prepares all files $OUT/NAME that occur in the text."""
        for name in MADE.findall(text):
            self.prepare(name)

    def prepare(self, name):
        """Makes $OUT/NAME by the first matching rule, unless it is newer than the program."""
        rule = next((rule for rule in self.rules if re.fullmatch(rule, name)), None)
        if rule is None or name in self.ready:
            return
        self.ready.add(name)
        mark = os.path.join(self.out, "runs", f"{name}.made")
        if not self.printing:
            if os.path.exists(mark) and os.path.getmtime(mark) > os.path.getmtime(self.program):
                return
            shutil.rmtree(os.path.join(self.out, name), ignore_errors=True)
        self.run(re.fullmatch(rule, name).expand(self.rules[rule]), f"$OUT/runs/{name}.log")
        if not self.printing:
            os.close(os.open(mark, os.O_CREAT | os.O_TRUNC | os.O_WRONLY))

    def track(self, base, recording, how, output):
        """Tracks a recording, or reuses the result of the same command; returns the result's path without its
        ending."""
        hand = f"--hand {how['hand']}" if "hand" in how else ""
        line = " ".join(f"barehand track --source folder:{recording} --no-publish {hand} {how.get('track', '')}".split())
        line = line.replace("$RECORDING/", recording + "/")
        key = (line, output)
        if key not in self.tracked:
            self.run(f"{line} --overwrite {output[0]} {base}{output[1]}", base + ".log")
            self.tracked[key] = base
        return self.tracked[key]

    def compare(self, base, how, plots):
        """Tracks, and compares the poses or the stated uncertainty with the truth, or the poses with labelled
        fingertips."""
        if "recording" not in how:
            raise ClaimError(f"{base.removeprefix('$OUT/runs/')}: says no recording, command or json")
        recordings = how["recording"] if isinstance(how["recording"], list) else [how["recording"]]

        # Track each recording, and collect the arguments for its comparison.
        pairs = []
        for number, recording in enumerate(recordings):
            if "hands" in how:  # one hand profile for each recording
                how = {**how, "hand": how["hands"][number]}
            if how.get("states"):
                result = self.track(f"{base}.{number}", recording, how, ("--states-log", ".lcmlog"))
                pairs.append(f"--truth {recording}/truth.csv --states {result}.lcmlog")
                continue
            result = self.track(base, recording, how, ("--result", ".csv"))
            labels = f"--fingertips {recording}/fingertips_2d.csv --recording {recording} --hand {how.get('hand')}"
            pairs.append(f"{labels if how.get('fingertips') else f'--truth {recording}/truth.csv'} --result {result}.csv")

        # Compare all recordings together.
        line = f"barehand eval {' '.join(pairs)} --overwrite --json {base}.json {plots} {how.get('eval', '')}"
        self.run(" ".join(line.split()).replace("$RECORDING/", recordings[0] + "/"), base + ".eval.log")
        return result

    def repetition(self, base, how, plots):
        """The figures of one repetition of a run."""
        # Run the command of the repetition.
        report, result = how.get("json", base + ".json"), None
        if "command" in how:
            self.run(how["command"].replace("$JSON", report), base + ".log")
        elif "json" in how:
            self.prepare_for(report)
        else:
            result = self.compare(base, how, plots)
        if self.printing:
            return {}

        # Read the figures from its report.
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
