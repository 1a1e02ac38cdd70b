#!/usr/bin/env python3
"""How many instructions the engines take for a stretch of a small pour, counted by valgrind: cost without a clock.

usage: instruction_counts.py PROGRAM --check    counts and compares with the record; exit code 1 where a count is more
                                                than 3 % off, 77 (skipped) where the build is not the recorded one
       instruction_counts.py PROGRAM --renew    counts and writes the record

Each engine runs twice, to the beginning and to the end of its stretch. The difference is what the stretch took: reading
the scenario and preparing the shapes drop out.
"""

import concurrent.futures
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

RECORD = pathlib.Path(__file__).with_name("instruction_counts.json")
SCENE = pathlib.Path(__file__).with_name("scene.toml")
# Beginning and end [s]: grains in flight and in contact, and about as many instructions with each engine. The soft
# engine takes many steps. The engine `contact` is left before the bed rests, as from then on it costs next to nothing and
# the moment is chance.
STRETCH = {"contact": (0.1, 0.25), "contact-1994": (0.1, 0.5), "dem": (0.08, 0.12), "box2d": (0.1, 0.3)}
# The same program repeats its counts to one part in ten thousand. A change of the last bits, which sends single grains
# other ways, moves them by up to 1.5 %.
PER_CENT = 3
SKIPPED = 77
RENEW = "scripts/renew-instruction-counts"


class CountingFailed(Exception):
    pass


def build_of(program):
    """Compiler and flags: instructions of different ones are not to be compared."""
    lines = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()
    words = [line.split(None, 1) for line in lines[1:]]
    return {name: text for name, text in words if name in ("compiler", "flags")}


def count(program, engine, duration):
    with tempfile.TemporaryDirectory() as folder:
        words = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, "run", str(SCENE),
                 "-o", f"{folder}/run", "--engine", engine, "--quiet", "--no-frames", "--threads", "1",
                 "--set", f"run.duration={duration:g}"]
        done = subprocess.run(words, capture_output=True, text=True)
        found = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode != 0 or not found:
            raise CountingFailed(f"{' '.join(words)}: exit code {done.returncode}\n{done.stderr}")
        return int(found.group(1))


def count_all(program):
    runs = [(engine, time) for engine, stretch in STRETCH.items() for time in stretch]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        counts = dict(zip(runs, pool.map(lambda run: count(program, *run), runs)))
    return {engine: counts[engine, end] - counts[engine, begin] for engine, (begin, end) in STRETCH.items()}


def report(recorded, found):
    """A line for each engine: record, count and difference, and whether that is too much."""
    lines, good = [], recorded.keys() == found.keys()
    for engine in sorted(recorded.keys() | found.keys()):
        was, now = recorded.get(engine), found.get(engine)
        if not was or not now:
            lines.append(f"{engine}: recorded {was}, counted {now}")
            continue
        near = 100 * abs(now - was) <= PER_CENT * was
        good = good and near
        verdict = "ok" if near else f"more than {PER_CENT} % off"
        lines.append(f"{engine}: recorded {was}, counted {now}, {now / was - 1.0:+.2%}: {verdict}")
    return lines, good


def main():
    if len(sys.argv) != 3 or sys.argv[2] not in ("--check", "--renew"):
        print(__doc__.split("\n\n", 1)[1], file=sys.stderr)
        return 2
    program, renew = sys.argv[1], sys.argv[2] == "--renew"
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {"build": {}, "instructions": {}}
    build = build_of(program)
    if not renew and build != record["build"]:
        print(f"skipped: the record is of {record['build']},\nthis build is {build}: not to be compared")
        return SKIPPED
    if not shutil.which("valgrind"):
        print("valgrind is missing: scripts/install-packages.sh installs it", file=sys.stderr)
        return 1
    try:
        found = count_all(program)
    except CountingFailed as failure:
        print(failure, file=sys.stderr)
        return 1
    lines, good = report(record["instructions"], found)
    print("\n".join(lines))
    if renew:
        RECORD.write_text(json.dumps({"build": build, "instructions": found}, indent=2) + "\n")
        return 0
    if not good:
        print(f"If the change is meant, whichever its sign, {RENEW} renews the record.")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
