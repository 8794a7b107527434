#!/usr/bin/env python3
"""Checks the commands that the pages of a source tree show, and those that measure their figures: every `barehand
SUBCOMMAND --option` is known to --help, every simulated sequence to `barehand sim --list`, every preset to
CMakePresets.json, and every script is in the tree. First shows, on a page with planted mistakes, that it notices them.
  commands.py SOURCE_TREE BAREHAND"""
import json
import os
import re
import subprocess
import sys

from links import pages_of, read

SPAN = re.compile(r"`([^`\n]+)`")
PRESET = re.compile(r"--preset[ =](\w+)")
SCRIPT = re.compile(r"(?:\./)?((?:tools|deploy|tests)/[\w/.-]+\.(?:sh|py))\b")
SEQUENCE = re.compile(r"\bsim:(\w+)")
OPTION = re.compile(r"--[a-z][\w-]*")
END_OF_COMMAND = re.compile(r"&&|\|\||[|;#&]|\s--\s")


class Program:
    """What --help says of the program."""

    def __init__(self, path):
        self.path = path
        self.options = {}
        top = self.run("--help")
        commands = top[top.index("Subcommands:"):]
        self.subcommands = set(re.findall(r"^  (\w[\w-]*)", commands, flags=re.M))
        self.sequences = set(re.findall(r"^\s*(\w+)", self.run("sim", "--list"), flags=re.M))

    def run(self, *arguments):
        return subprocess.run([self.path, *arguments], check=True, capture_output=True, text=True).stdout

    def knows(self, subcommand, option):
        if subcommand not in self.options:
            self.options[subcommand] = set(OPTION.findall(self.run(subcommand, "--help")))
        return option in self.options[subcommand]


def code_lines(text):
    """Lines of code blocks, fenced or indented, and spans of `code`."""
    fenced, block = False, ""
    for line in text.split("\n"):
        if line.startswith("```"):
            fenced = not fenced
        elif fenced or line.startswith("    "):
            block += line.rstrip()
            if block.endswith("\\"):  # the command goes on in the next line
                block = block[:-1]
                continue
            yield block
            block = ""
        else:
            yield from SPAN.findall(line)


def commands_of(code, subcommands):
    """(subcommand, arguments) of every call of the program; `track --hand` counts as one."""
    for call in re.finditer(r"(?:^|[\s/(])barehand (\w[\w-]*)(.*)", code):
        yield call[1], END_OF_COMMAND.split(call[2])[0]
    start = re.match(r"(\w+) (.*)", code)
    if start and start[1] in subcommands:
        yield start[1], END_OF_COMMAND.split(start[2])[0]


def mistakes_in(code, root, program, presets):
    for subcommand, arguments in commands_of(code, program.subcommands):
        if subcommand.isupper():  # a placeholder
            continue
        if subcommand not in program.subcommands:
            yield f"barehand has no subcommand {subcommand}"
            continue
        for option in OPTION.findall(arguments):
            if not program.knows(subcommand, option):
                yield f"barehand {subcommand} has no option {option}"
        shown = re.match(r" ([a-z]\w*)", arguments)
        if subcommand == "sim" and shown and shown[1] not in program.sequences:
            yield f"barehand sim has no sequence {shown[1]}"
    for sequence in SEQUENCE.findall(code):
        if not sequence.isupper() and sequence not in program.sequences:
            yield f"the simulator has no sequence {sequence}"
    for preset in PRESET.findall(code):
        if preset not in presets:
            yield f"there is no preset {preset}"
    for script in SCRIPT.findall(code):
        if not os.access(os.path.join(root, script), os.X_OK):
            yield f"{script} is no script of the tree"


def mistakes_of(text, root, program, presets):
    return [f"{mistake}: {code.strip()}" for code in code_lines(text)
            for mistake in mistakes_in(code, root, program, presets)]


def measuring_commands(root, path):
    """What tools/measure/measure.py would run, as a block of code."""
    script = os.path.join(root, "tools/measure/measure.py")
    lines = subprocess.run([sys.executable, "-B", script, "RECORDINGS", "OUT", "--print", "--program", path], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    assert len(lines) > 100, f"the check itself is broken: measure.py runs {lines}"
    return "\n".join(f"    {line}" for line in lines)


def prove_that_it_can_fail(root, program, presets):
    page = """`barehand track --no-publish --none`, `track --nothing`, `barehand fly`
    build/release/src/app/barehand eval --truth a --result b --wings | grep --colour x
    barehand track --source sim:fist --result a.csv \\
      --unknown
    cmake --preset none && tools/measure/none.sh
`barehand sim none` and `--source sim:none`, but `barehand SUBCOMMAND --help` and `sim:NAME` stand for others
"""
    found = mistakes_of(page, root, program, presets)
    assert len(found) == 9, f"the check itself is broken: it found {found}"


def main(root, path):
    program = Program(path)
    presets = {preset["name"] for kind, list_ in json.loads(read(os.path.join(root, "CMakePresets.json"))).items()
               if kind.endswith("Presets") for preset in list_}
    prove_that_it_can_fail(root, program, presets)
    problems = [f"{page}: {mistake}" for page in pages_of(root)
                for mistake in mistakes_of(read(os.path.join(root, page)), root, program, presets)]
    problems += [f"tools/measure: {mistake}"
                 for mistake in mistakes_of(measuring_commands(root, path), root, program, presets)]
    print("\n".join(problems) or "all commands are known")
    sys.exit(1 if problems else 0)


main(*sys.argv[1:])
