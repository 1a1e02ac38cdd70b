#!/usr/bin/env python3
"""The golden table: the state hash of each shipped scenario under each engine after a short run.

usage: state_hashes.py PROGRAM --check          runs everything and compares it with the table; exit code 1 if anything
                                                differs, is missing or is one too many
       state_hashes.py PROGRAM --renew          runs everything and writes the table
       state_hashes.py PROGRAM --like OTHER     runs everything with both programs and compares them
options: --engine NAME     this engine only (may be repeated)
         --threads N       for PROGRAM; the table and OTHER use one thread
         --shorter FACTOR  of the duration, for slow builds (with --like only)
         --jobs N          runs at a time, default 2
"""

import argparse
import concurrent.futures
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

TABLE = pathlib.Path(__file__).with_name("state_hashes.csv")
COLUMNS = ["scenario", "engine", "duration", "steps", "state_hash"]
# Long enough for grains to have met, short enough for every test run [s]. The soft engine takes many steps.
DURATION = {"dem": 0.05}
USUAL_DURATION = 0.2
SETTLING = 0.1


def listed(program, what):
    lines = subprocess.run([program, "list", what], capture_output=True, text=True, check=True).stdout.splitlines()
    return [line.split()[0] for line in lines[1:]]


def has_settling(scenario):
    file = pathlib.Path(__file__).parents[2] / "scenarios" / f"{scenario}.toml"
    return any(line.strip() == "[settle]" for line in file.read_text().splitlines())


def measure(program, scenario, engine, options):
    duration = DURATION.get(engine, USUAL_DURATION) * options.shorter
    with tempfile.TemporaryDirectory() as folder:
        words = [program, "run", scenario, "-o", f"{folder}/run", "--engine", engine, "--quiet", "--no-frames",
                 "--threads", str(options.threads), "--set", f"run.duration={duration:g}",
                 "--set", "output.trajectory.every=0", "--set", "output.checkpoint.every_wall=0"]
        if has_settling(scenario):
            settling = min(SETTLING, duration) * options.shorter
            words += ["--set", f"settle.at_most={settling:g}"]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            return [scenario, engine, f"{duration:g}", "", f"failed: {done.stderr.strip()}"]
        summary = json.loads(pathlib.Path(folder, "run", "summary.json").read_text())
    return [scenario, engine, f"{duration:g}", str(summary["steps"]), summary["state_hash"]]


def measure_all(program, options):
    engines = options.engine or listed(program, "engines")
    cases = [(scenario, engine) for scenario in listed(program, "scenarios") for engine in engines]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return list(pool.map(lambda case: measure(program, *case, options), cases))


def read_table(options):
    with open(TABLE, newline="") as file:
        rows = list(csv.reader(file))[1:]
    return [row for row in rows if not options.engine or row[1] in options.engine]


def write_table(rows):
    with open(TABLE, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])


def differences(expected, found):
    expected, found = ({tuple(row[:2]): row for row in rows} for rows in (expected, found))
    for case in sorted(expected.keys() | found.keys()):
        was, now = expected.get(case), found.get(case)
        if was != now:
            yield f"{case[0]} with {case[1]}: expected {was[2:] if was else 'no row'}, found {now[2:] if now else 'no row'}"


def failures(rows):
    return [f"{row[0]} with {row[1]}: {row[4]}" for row in rows if row[4].startswith("failed")]


def arguments():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n", 1)[1])
    parser.add_argument("program")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true")
    what.add_argument("--renew", action="store_true")
    what.add_argument("--like")
    parser.add_argument("--engine", action="append")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--shorter", type=float, default=1.0)
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def main():
    options = arguments()
    found = measure_all(options.program, options)
    problems = failures(found)
    if options.renew and not problems:
        kept = [row for row in read_table(argparse.Namespace(engine=None)) if row[1] not in options.engine] \
            if options.engine else []
        write_table(sorted(kept + found))
    elif options.check:
        problems = list(differences(read_table(options), found))
    elif options.like:
        options.threads = 1
        problems += differences(measure_all(options.like, options), found)
    as_it_is = "written" if options.renew else "as they should be"
    print("\n".join(problems) if problems else f"{len(found)} state hashes: {as_it_is}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
