#!/usr/bin/env python3
"""Runs every sample command of the documents: lines that begin with "polargrain " in fenced blocks marked sh.

usage: run_doc_commands.py TOP PROGRAM

The commands of one document run in order in one empty folder, in which `scenarios` and `shapes` stand for those of the
tree. Runs are cut to a few steps; a document may show any run, however long it takes.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SHORT = ["--set", "run.duration=0.005", "--set", "settle.at_most=0.005", "--force"]


def commands(text):
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.M | re.S):
        for line in block.splitlines():
            if line.startswith("polargrain "):
                yield line


def words_to_run(line):
    words = shlex.split(line, comments=True)[1:]
    return words + SHORT if words[0] in ("run", "compare") and "--help" not in words else words


def failures(document, top, program):
    with tempfile.TemporaryDirectory() as folder:
        for name in ("scenarios", "shapes"):
            (pathlib.Path(folder) / name).symlink_to(top / name)
        for line in commands(document.read_text()):
            done = subprocess.run([program, *words_to_run(line)], cwd=folder, capture_output=True, text=True)
            print(f"{document.relative_to(top)}: {line}: exit code {done.returncode}")
            if done.returncode != 0:
                yield f"{document.relative_to(top)}: {line}\n{done.stderr}"


def main():
    top, program = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    documents = [*sorted(top.glob("*.md")), *sorted(top.glob("docs/*.md"))]
    if not any(list(commands(d.read_text())) for d in documents):
        print("no sample command found: the search itself is broken")
        return 1
    found = [failure for document in documents for failure in failures(document, top, program)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
