#!/usr/bin/env python3
"""Runs `barehand bench` or the benchmarks briefly and checks that their figures are plausible, whatever their size.
First changes good figures to bad ones and checks that each change is found.
  smoke.py bench BAREHAND
  smoke.py functions BENCHMARKS"""
import copy
import json
import math
import os
import subprocess
import sys
import tempfile

FRAMES = 15
STAGES = {"preprocess", "track", "publish"}


def positive(value):
    return isinstance(value, (int, float)) and math.isfinite(value) and value > 0


def faults_of_bench(report):
    if len(report["cases"]) != 1:
        return [f"{len(report['cases'])} cases instead of one"]
    case = report["cases"][0]
    faults = [f"{name} is {case[name]}"
              for name in ("frames_per_second", "cpu_ms_per_frame", "seconds", "peak_mb", "stored_frames_mb", "tracked_share")
              if not positive(case[name])]
    if case["tracked_share"] > 1:
        faults.append(f"tracked_share is {case['tracked_share']}")

    # Every stage saw the frames, and its percentiles are in order.
    faults += [f"stage {name} is missing" for name in STAGES - case["stages_ms"].keys()]
    for name, times in [*case["stages_ms"].items(), ("capture to publish", case["capture_to_publish_ms"])]:
        if times["count"] < FRAMES - 2:  # one may be in each queue when counting starts and ends
            faults.append(f"{name}: {times['count']} frames of {FRAMES}")
        elif not 0 <= times["p50"] <= times["p95"] <= times["p99"] <= times["max"]:
            faults.append(f"{name}: percentiles out of order: {times}")
    return faults


def faults_of_functions(report):
    rows = report["benchmarks"]
    return ([] if rows else ["no benchmark ran"]) + [
        f"{row['name']}: {row.get('error_message', row)}" for row in rows
        if row.get("error_occurred") or not (positive(row["real_time"]) and row["iterations"] > 0)]


def run(command, path):
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode:
        sys.exit(f"{' '.join(command)}: exit status {ran.returncode}\n{ran.stdout}{ran.stderr}")
    with open(path) as file:
        return json.load(file)


def must_notice(faults_of, report, plant):
    planted = copy.deepcopy(report)
    plant(planted)
    if not faults_of(planted):
        sys.exit("the check itself is broken: it accepts planted nonsense")


def main():
    kind, program = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "figures.json")
        if kind == "bench":
            report = run([program, "bench", "--source", "sim:grasp_ball,width=320,height=240", "--store", "20", "--warm-up", "5",
                          "--frames", str(FRAMES), "--json", path], path)
            faults_of = faults_of_bench
            must_notice(faults_of, report, lambda r: r["cases"][0].update(cpu_ms_per_frame=0))
            must_notice(faults_of, report, lambda r: r["cases"][0]["stages_ms"].pop("track"))
            must_notice(faults_of, report, lambda r: r["cases"][0]["stages_ms"]["track"].update(p50=1e9))
        else:
            report = run([program, "--benchmark_min_time=0", f"--benchmark_out={path}", "--benchmark_out_format=json"], path)
            faults_of = faults_of_functions
            must_notice(faults_of, report, lambda r: r["benchmarks"].clear())
            must_notice(faults_of, report, lambda r: r["benchmarks"][0].update(real_time=0))
    faults = faults_of(report)
    print("\n".join(faults) or "every figure makes sense")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
