#!/usr/bin/env python3
"""Tests tools/measure/measure.py on small claims: what it runs, what it writes, and what it says if a command fails.
  measuring.py SOURCE_TREE BAREHAND"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

SOURCE_TREE, BAREHAND = sys.argv.pop(1), os.path.abspath(sys.argv.pop(1))

PREPARED = "'short_(\\w+)' = 'barehand sim \\1 --frames 3 --out $OUT/\\g<0>'\n"
CLAIM = """
title = "Short sequences"
columns = [["dataset", "{name}"], ["mean", "{tracked.mean:.2f}"]]
[all]
recording = "$OUT/{row}"
track = "--init $RECORDING/start_pose.json"
[runs.tracked]
seeds = [4, 5]
[runs.part]
track = "--step 2"
eval = "--step 2"
[rows.short_fist]
[rows.again]
recording = "$OUT/short_fist"
only = ["tracked"]
"""
OTHER_RUNS = """
title = "Runs of other kinds"
columns = [["a", "{name}"]]
[all]
track = "--init $OUT/short_fist/start_pose.json"
[runs.measured]
[rows.states]
states = true
recording = ["$OUT/short_fist", "$OUT/short_fist"]
hands = ["$OUT/short_fist/hand.json", "right"]
[rows.bench]
command = "barehand bench --source folder:$OUT/short_fist --store {frames} --warm-up 0 --frames 6 --overwrite --json $JSON"
frames = "3"
repeat = 2
"""
BY_HAND = 'title = "By hand"\ncolumns = [["a", "{name}"]]\n[rows.a]\n'


class MeasuringTest(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.root)
        tools = os.path.join(self.root, "tools/measure")
        shutil.copytree(os.path.join(SOURCE_TREE, "tools/measure"), tools, ignore=shutil.ignore_patterns("claims"))
        os.makedirs(os.path.join(tools, "claims"))
        self.write("tools/measure/prepared.toml", PREPARED)
        self.write("tools/measure/claims/short.toml", CLAIM)
        self.write("tools/measure/claims/hand.toml", BY_HAND)

    def write(self, path, text):
        with open(os.path.join(self.root, path), "w", encoding="utf-8") as file:
            file.write(text)

    def measure(self, *arguments):
        script = os.path.join(self.root, "tools/measure/measure.py")
        return subprocess.run([sys.executable, "-B", script, self.root, os.path.join(self.root, "out"), "--program", BAREHAND,
                               *arguments], capture_output=True, text=True, check=False)

    def results(self, name="short"):
        with open(os.path.join(self.root, f"docs/measured/{name}.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_writes_figures_of_each_run_and_their_range_over_the_seeds(self):
        done = self.measure("short")
        self.assertEqual(done.returncode, 0, done.stderr)
        results = self.results()
        self.assertRegex(results["measured"]["version"], r"^\d+\.\d+\.\d+$")
        self.assertEqual(list(results["rows"]), ["short_fist", "again"])

        # Two seeds have a range, and the first of them is the value.
        tracked = results["rows"]["short_fist"]["tracked"]
        self.assertEqual((tracked["frames"], tracked["lost"], tracked["runs"]), (3, 0, 2))
        low, high = tracked["ranges"]["mean"]
        self.assertIn(tracked["mean"], (low, high))
        self.assertLess(high, 20)

        # One run has none, and a row may leave runs out.
        part = results["rows"]["short_fist"]["part"]
        self.assertEqual(part["frames"], 2)
        self.assertNotIn("ranges", part)
        self.assertEqual(results["rows"]["again"], {"tracked": tracked})

        # What was made once is used again, and the same figures are found.
        again = self.measure("short")
        self.assertIn("barehand sim fist", done.stdout)
        self.assertNotIn("barehand sim", again.stdout)
        self.assertEqual(self.results(), results)

        # Another folder for the results leaves those of the documentation as they are.
        self.write("docs/measured/short.json", "{}")
        other = os.path.join(self.root, "mine")
        self.assertEqual(self.measure("short", "--results", other).returncode, 0)
        self.assertEqual(self.results(), {})
        with open(os.path.join(other, "short.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file), results)

    def test_compares_stated_with_actual_errors_and_reads_what_commands_write(self):
        self.write("tools/measure/claims/other.toml", OTHER_RUNS)
        done = self.measure("other")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.results("other")["rows"]

        # One comparison of two recordings, each tracked with a hand of its own.
        self.assertGreater(rows["states"]["measured"]["all_stated"], 0)
        logs = [line.split("--states-log ")[1] for line in done.stdout.splitlines() if "--states-log" in line]
        self.assertEqual(len(set(logs)), 2)
        self.assertIn("--hand $OUT/short_fist/hand.json", done.stdout)
        self.assertIn("--hand right", done.stdout)

        # A command that is repeated, with a text of its row in it.
        bench = rows["bench"]["measured"]
        self.assertEqual(bench["runs"], 2)
        self.assertGreater(bench["fps"], 0)
        self.assertIn("--store 3", done.stdout)

    def test_printing_runs_nothing(self):
        done = self.measure("--print")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[0], "barehand sim fist --frames 3 --out $OUT/short_fist")
        self.assertIn("--init $OUT/short_fist/start_pose.json --seed 4 ", lines[1])
        self.assertEqual(os.listdir(self.root), ["tools"])

    def test_the_example_of_how_to_add_a_claim_is_one(self):
        with open(os.path.join(SOURCE_TREE, "CONTRIBUTING.md"), encoding="utf-8") as file:
            section = file.read().split("### Add a claim")[1]
        block = section[section.index("    title"):].split("\n\n")[0]
        self.write("tools/measure/claims/example.toml", textwrap.dedent(block))
        shutil.copy(os.path.join(SOURCE_TREE, "tools/measure/prepared.toml"), os.path.join(self.root, "tools/measure"))
        done = self.measure("--print", "example")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("barehand track --source folder:$OUT/grasp_"), 6)
        self.assertIn("barehand sim grasp_ball", done.stdout)

    def test_a_command_that_fails_is_named_with_its_log_and_nothing_is_written(self):
        self.write("tools/measure/claims/short.toml", CLAIM.replace("--init", "--unknown"))
        done = self.measure("short")
        self.assertEqual(done.returncode, 1)
        log = os.path.join(self.root, "out/runs/short.short_fist.tracked.0.log")
        self.assertIn(f"{log}: the command ended with", done.stderr)
        self.assertIn("--unknown", done.stderr)
        self.assertTrue(os.path.getsize(log))
        self.assertFalse(os.path.exists(os.path.join(self.root, "docs")))

    def test_what_cannot_be_measured_is_said(self):
        for claim, said in (("hand", "measured by hand"), ("none", "there is no claim none: the claims are hand, short")):
            done = self.measure(claim)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)


unittest.main()
