#!/usr/bin/env python3
"""Measures claims of the documentation and writes the results to docs/measured, from which pages.py makes the pages, or
to another folder (--results).
  tools/measure/measure.py RECORDINGS OUT CLAIM...             measures tools/measure/claims/CLAIM.toml
  tools/measure/measure.py RECORDINGS OUT --print [CLAIM...]   only prints the commands"""
import argparse
import datetime
import json
import os
import re
import signal
import subprocess
import sys

from claims import ROOT, ClaimError, Tree, read
from runner import Runner

JOINED = ("track", "eval")  # keys whose values from the claim, the row and the run are concatenated


def machine():
    """A description of this machine: number of cores, processor, vector instructions."""
    about = read("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.+)", about)
    flags = re.search(r"flags\s*: (.+)", about)
    vectors = "AVX-512" if flags and "avx512f" in flags[1] else "AVX2" if flags and "avx2" in flags[1] else "no AVX2"
    cores = len(os.sched_getaffinity(0))
    return f"{cores} core{'s' if cores > 1 else ''} of {model[1].strip() if model else 'a processor'} with {vectors}"


def merged(claim, row, run):
    """The settings for a run of a row: those of the claim, the row and the run together, with {row} and the other texts
    of the row inserted for their placeholders."""
    how = {}
    for part in (claim.get("all", {}), claim["rows"][row], claim["runs"][run]):
        for key, value in part.items():
            how[key] = f"{how[key]} {value}" if key in JOINED and key in how else value
    texts = {"row": row, **{key: value for key, value in claim["rows"][row].items() if isinstance(value, str)}}
    text = json.dumps(how)
    for key, value in texts.items():
        text = text.replace(f"{{{key}}}", json.dumps(value)[1:-1])
    return json.loads(text)


def measure(tree, runner, name):
    """Measures all runs of a claim, and stores its results."""
    claim = tree.claim(name)
    if "runs" not in claim:
        raise ClaimError(f"{name} is measured by hand: its commands are on its page, its figures in "
                         f"{tree.results_path(name)}")

    # Run all runs of all rows.
    figure = claim.get("figure", {})
    rows = {}
    for row in claim["rows"]:
        rows[row] = {}
        for run in claim["rows"][row].get("only", claim["runs"]):
            plots = f"--plots $OUT/runs/{name}.plots" if figure.get("run") == f"{row}.{run}" else ""
            rows[row][run] = runner.measure_run(f"{name}.{row}.{run}", merged(claim, row, run), plots)

    # Store the results, with the version and the machine, before anything else can fail.
    if not runner.printing:
        version = subprocess.run([runner.program, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
        measured = {"version": version, "date": datetime.date.today().isoformat(), "machine": machine()}
        tree.store(name, {"measured": measured, "rows": rows})


def draw(runner, name, figure):
    """Copies the plots of a claim to the images of the pages."""
    for image, plot in figure.get("plots", {}).items():
        runner.prepare_for(plot)
        runner.run(f"cp {plot.replace('$PLOTS', f'$OUT/runs/{name}.plots')} docs/images/{image}", f"$OUT/runs/{name}.cp.log")


def arguments_of(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", metavar="RECORDINGS", help="folder of recordings")
    parser.add_argument("out", metavar="OUT", help="folder for what is made on the way; what can be used again is made once")
    parser.add_argument("claims", metavar="CLAIM", nargs="*", help="of tools/measure/claims")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/src/app/barehand"), help="path of barehand")
    parser.add_argument("--results", metavar="DIR", help="folder for the results; docs stays as it is")
    parser.add_argument("--print", action="store_true", help="only print the commands, of all claims if none is given")
    arguments = parser.parse_intermixed_args(words)
    if not arguments.claims and not arguments.print:
        parser.error("give the claims to be measured")
    return arguments


def main(words):
    arguments = arguments_of(words)
    tree = Tree(ROOT)
    if arguments.results:
        tree.results = os.path.abspath(arguments.results)
    if arguments.print:
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # end quietly if the reader of the output, such as head, ends
    try:
        if os.path.basename(arguments.program) != "barehand" or not os.access(arguments.program, os.X_OK):
            raise ClaimError(f"{arguments.program} is not the program: build it, or give the path of barehand with --program")
        runner = Runner(tree, arguments.program, arguments.recordings, arguments.out, arguments.print)
        for name in arguments.claims or [name for name in tree.claim_names() if "runs" in tree.claim(name)]:
            measure(tree, runner, name)
            if not arguments.results:
                draw(runner, name, tree.claim(name).get("figure", {}))
    except ClaimError as error:
        sys.exit(f"measure.py: {error}")


if __name__ == "__main__":
    main(sys.argv[1:])
