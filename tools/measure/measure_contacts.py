#!/usr/bin/env python3
"""Measures the contacts of docs/contacts.md: simulates grasps, tracks each with its own hand profile, and compares what
is stated with the truth.
  tools/measure/measure_contacts.py BAREHAND OUT [SEQUENCE ...]
SEQUENCE is what `barehand track --source sim:` takes. By default these are the sequences of the page. What is in OUT
already is not simulated or tracked again; to track with another program, remove the files named "tracked". Prints one
row a sequence, then the figures of each group together."""
import json
import os
import shutil
import subprocess
import sys

OLDER = ["grasp_mug,noise=kinect,seed=11", "grasp_ball,noise=kinect,seed=11",
         "grasp_mug,noise=kinect,seed=77,scale=1.1", "grasp_ball,noise=tof,seed=78,scale=0.92"]
FIRST, OTHERS = ([f"grasp,noise={'tof' if seed % 2 else 'kinect'},seed={seed}" for seed in seeds]
                 for seeds in (range(1000001, 1000031), range(1000031, 1000103)))
RATE = 15  # frames per second
TIPS = ["visible_fingertips", "partly_visible_fingertips", "hidden_fingertips"]


def run(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def prepare(barehand, out, sequence):
    """Simulates and tracks a sequence, and returns its folder."""
    folder = os.path.join(out, sequence.replace(",", "_").replace("=", "_"))
    log, simulated, tracked = (os.path.join(folder, name) for name in ("states.lcmlog", "simulated", "tracked"))
    if not os.path.exists(simulated):
        shutil.rmtree(folder, ignore_errors=True)  # it may hold a part of a recording
        name, *keys = sequence.split(",")
        run(barehand, "sim", name, *(argument for key in keys for argument in ("--set", key)), "--fps", str(RATE),
            "--out", folder)
        open(simulated, "w").close()
    if not os.path.exists(tracked):
        run(barehand, "track", "--source", "folder:" + folder, "--no-publish", "--threads", "1", "--states-log", log,
            "--overwrite")
        open(tracked, "w").close()
    return folder


def evaluate(barehand, folders):
    """The figures about touches of several sequences together."""
    path = os.path.join(os.path.dirname(folders[0]), "figures.json")
    files = [argument for option, name in (("--truth", "truth.csv"), ("--states", "states.lcmlog"),
                                           ("--contacts", "contacts.csv"))
             for argument in (option, *(os.path.join(folder, name) for folder in folders))]
    run(barehand, "eval", *files, "--json", path, "--overwrite")
    return json.load(open(path))["contacts"]


def row(name, figures):
    cells = [f"{t['f1']:.2f} ({t['right']} right, {t['wrong']} wrong, {t['missed']} missed)"
             for t in (figures[tips] for tips in TIPS)]
    print("| " + " | ".join([name, *cells]) + " |", flush=True)


def main(barehand, out, *sequences):
    os.makedirs(out, exist_ok=True)
    print("| sequence | visible fingertips | in part | hidden |\n|---|---|---|---|")
    for title, group in ((("given", sequences),) if sequences else (("first grasps", FIRST), ("other grasps", OTHERS),
                                                                 ("older ones", OLDER))):
        folders = []
        for sequence in group:
            folder = prepare(barehand, out, sequence)
            try:
                row(sequence, evaluate(barehand, [folder]))
                folders.append(folder)
            except subprocess.CalledProcessError as error:  # such as a hand that was never tracked
                print("| " + sequence + " | left out: " + error.stderr.decode().strip() + " | | |", flush=True)
        together = evaluate(barehand, folders)
        row(title, together)
        for bin in together["touching"]:
            print(f"stated {bin['stated']:.2f}: {bin['actual']:.2f} touch, of {bin['count']}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
