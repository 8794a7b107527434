"""Reads the figures (measured numbers) of a run from the JSON files of the program: those of `eval --json`, with
`--fingertips` or `--states`, too, of `experiment`, of `bench --json`, and of measure_python_client.py. KNOWN lists the names of the figures."""
import csv

KNOWN = {
    # From a result table: numbers of frames; errors in mm (of fingertips: in pixels); frames until a returning hand is
    # tracked.
    "frames", "tracked", "untracked", "lost", "off", "without_hand", "mean", "median", "p90", "max", "seen", "hidden",
    "percent", "delays", "labels", "missing",
    # On the stated uncertainty: coverage in per cent, stated and actual error in mm.
    *(f"{kind}_{what}" for kind in ("all", "seen", "inferred") for what in ("covered", "stated", "actual")),
    # On the stated confidence, for each tenth of its range: stated and actual probability in per cent.
    *(f"{what}_{tenth}" for what in ("stated", "found") for tenth in range(10)),
    # From bench: frames per second, times in ms, memory in MB; for a sweep, its values and the CPU times.
    "fps", "cpu", "dropped", "first_pose", "peak", "stored", "latency_p50", "latency_p95", "latency_p99", "values",
    # From measure_python_client.py: numbers of frames, and of hands in those that were heard.
    "sent", "heard", "hands",
    # From measure_viewers.py: 99 % and median of capture to publication [ms], and the ratio of the former; frames per
    # second that a quick client receives (those that were tracked: "tracked" above); fraction of a core that the server
    # takes without clients [%]. From measure_page.py: pictures per second that a browser draws, and its CPU time for each
    # [ms].
    "alone", "watched", "median_alone", "median_watched", "ratio", "received", "server", "drawn", "browser",
    # The number of repetitions over which a range is taken.
    "runs",
}


def named(distribution, prefix=""):
    """The statistics of a distribution that pages show, with a prefix to their names."""
    return {prefix + name: distribution[name] for name in ("mean", "median", "p90", "max") if name in distribution}


def of_run(run):
    """The figures of one result table compared with the truth; errors in mm."""
    tracked = run["frames"] - run["untracked"]
    figures = {"frames": run["frames"], "tracked": tracked, "untracked": run["untracked"], "lost": run["lost"],
               "off": run["lost"] - run["untracked"], "without_hand": len(run["phantom_frames"]),
               **named(run["frame_error_mm"])}
    for kind in ("seen", "hidden"):
        if "mean" in run[f"{kind}_segment_error_mm"]:
            figures[kind] = run[f"{kind}_segment_error_mm"]["mean"]
    if "mean_frame_error_over_hand_length" in run:
        figures["percent"] = 100 * run["mean_frame_error_over_hand_length"]
    if run["returns"]:
        figures["delays"] = [one["frames_until_tracked"] for one in run["returns"]]
    return figures


def of_reliability(reliability):
    """The figures on stated uncertainty; coverage in per cent, errors in mm."""
    figures = {}
    for kind, coverage in reliability["intervals_90"].items():
        if coverage["intervals"]:
            figures.update({f"{kind}_covered": 100 * coverage["covered"], f"{kind}_stated": coverage["stated_mm"],
                            f"{kind}_actual": coverage["actual_mm"]})
    for bin_ in reliability["within_10_mm"]:
        decile = min(int(10 * bin_["stated"]), 9)
        figures.update({f"stated_{decile}": 100 * bin_["stated"], f"found_{decile}": 100 * bin_["actual"]})
    return figures


def of_case(case):
    """The figures of one case of bench; times in ms, memory in MB."""
    latency = case["capture_to_publish_ms"]
    return {"fps": case["frames_per_second"], "cpu": case["cpu_ms_per_frame"], "dropped": case["dropped"],
            **({"first_pose": case["first_pose_ms"]} if case["first_pose_ms"] is not None else {}),
            "peak": case["peak_mb"], "stored": case["stored_frames_mb"],
            **{f"latency_{name}": latency[name] for name in ("p50", "p95", "p99") if name in latency}}


def of_report(report, label=None):
    """All figures in a report: those of the run or the sweep with this label, or of the first run without a label."""
    figures = {}
    runs = [run for run in report.get("runs", []) if label in (None, run["label"])]
    if runs:
        figures.update(of_run(runs[0]))
    if "fingertips" in report:
        tips = report["fingertips"]
        figures.update({"labels": tips["labels"], "missing": tips["missing"], **named(tips["distance_px"])})
    if "reliability" in report:
        figures.update(of_reliability(report["reliability"]))
    cases = report.get("cases", [])
    swept = [case for case in cases if case["sweep"] and case["sweep"] == label]
    if swept:
        figures.update({"values": [case["value"] for case in swept], "cpu": [case["cpu_ms_per_frame"] for case in swept]})
    elif cases:
        figures.update(of_case(cases[0]))
    if client := report.get("client"):
        figures.update({"sent": client["sent"], "heard": client["heard"], "hands": client["hands"],
                        "cpu": client["cpu_ms_per_frame"]})
    figures.update(report.get("viewers", {}))
    if not figures:
        raise KeyError(f"nothing is called {label}" if label else "the report has no figures")
    return figures


def frames_with_rows(result):
    """The number of frames in a result table that have a hand."""
    with open(result, encoding="utf-8", newline="") as file:
        return len({row["frame"] for row in csv.DictReader(file)})


def rounded(value):
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return round(value, 4) if isinstance(value, float) else value


def together(repetitions):
    """Combines the repetitions of a run: the figures of the first one, and their ranges over all."""
    figures = {name: rounded(value) for name, value in repetitions[0].items()}
    if len(repetitions) > 1:
        figures["runs"] = len(repetitions)
        figures["ranges"] = {}
        for name, value in repetitions[0].items():
            values = [one[name] for one in repetitions if isinstance(one.get(name), (int, float))]
            if isinstance(value, (int, float)) and len(values) == len(repetitions):
                figures["ranges"][name] = [rounded(min(values)), rounded(max(values))]
    return figures
