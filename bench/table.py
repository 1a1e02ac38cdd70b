"""What scripts/bench-table does: whole pours with every engine, kernels and stages, as tables.

Every case runs in a process of its own, so that its peak memory is its own. Costs are processor time of all threads;
of several repeats the least counts, as other programs on the machine can only add to it.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[1]
SIZES = [125, 500, 2000, 8000]
DISK_SIZES = [500]
# Engine and number of threads.
SOLVERS = [("contact", 1), ("contact", 2), ("contact-1994", 1), ("dem", 1), ("box2d", 1)]
# The soft engine's steps get shorter as the fall gets longer: 2000 grains take ten minutes, 8000 hours.
LARGEST = {"dem": 500}
COLUMNS = ["scene", "engine", "threads", "grains", "step", "fall", "collapse", "rest", "whole", "wall", "rejected",
           "overlap", "deepest", "bytes", "error"]
MEASURED = COLUMNS[4:-1]
KERNELS = "^(overlap_test|gap_points|neighbour_search/[0-9]+$|impact)"
STAGES = "^stage/"


def bench(program, pattern):
    done = subprocess.run([program, f"--benchmark_filter={pattern}", "--benchmark_format=json",
                           "--benchmark_min_time=0.1"], capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout.strip():
        raise RuntimeError(f"{program} --benchmark_filter='{pattern}': exit code {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def measured(found):
    """The numbers of one whole pour, or why there are none. Wall-clock time, too, is per simulated second."""
    if found.get("error_occurred"):
        return {"error": found["error_message"]}
    return {"wall": found["real_time"] / found["simulated"], "error": "",
            **{name: found[name] for name in MEASURED if name != "wall"}}


def pour(program, scene, engine, threads, grains, repeats):
    pattern = f"^pour/{engine.replace('-', '_')}_{scene}/grains:{grains}/workers:{threads}/"
    runs = []
    for _ in range(repeats):
        found = bench(program, pattern)["benchmarks"]
        if len(found) != 1:
            raise RuntimeError(f"{program} has no single benchmark {pattern}")
        runs.append(measured(found[0]))
    best = min(runs, key=lambda run: run.get("whole", 0.0))
    return {"scene": scene, "engine": engine, "threads": threads, "grains": grains, **best}


def cases(sizes, disk_sizes, engines, everything):
    for scene, grains in [*(("rough", n) for n in sizes), *(("disks", n) for n in disk_sizes)]:
        for engine, threads in SOLVERS:
            if engine in engines and (everything or grains <= LARGEST.get(engine, grains)):
                yield scene, engine, threads, grains


def heading(context):
    commit = subprocess.run(["git", "-C", str(TOP), "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    changed = subprocess.run(["git", "-C", str(TOP), "status", "--porcelain", "--untracked-files=no", "--", "src",
                              "shapes", "bench", "CMakeLists.txt"], capture_output=True, text=True)
    models = [line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return [f"- commit: {commit.stdout.strip()}{', with changes' if changed.stdout.strip() else ''}",
            f"- compiler: {context['compiler']}, {context['flags']}",
            f"- processor: {models[0] if models else 'unknown'}, {context['mhz_per_cpu']} MHz, {context['num_cpus']} "
            f"of them; load at the beginning {context['load_avg'][0]:.1f}"]


def number(value):
    return f"{value:.3g}" if value else "0"


def share(value):
    return f"{100.0 * value:.2g}" if value else "0"


def pour_rows(rows):
    yield ["scene", "grains", "engine", "threads", "step, ms", "fall", "collapse", "rest", "whole", "wall clock",
           "moves rejected, %", "overlap, % d: mean", "deepest", "kB a grain"]
    for r in rows:
        start = [r["scene"], str(r["grains"]), f"`{r['engine']}`", str(r["threads"])]
        if r["error"]:
            yield [*start, r["error"], *[""] * 9]
            continue
        costs = [number(r[phase]) for phase in ("fall", "collapse", "rest", "whole", "wall")]
        yield [*start, number(1e3 * r["step"]), *costs, share(r["rejected"]), share(r["overlap"]), share(r["deepest"]),
               number(r["bytes"] / 1024.0)]


NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}


def kernel_rows(found):
    yield ["kernel", "ns a call"]
    for b in found:
        if b["run_type"] == "iteration":
            yield [b["name"], number(b["cpu_time"] * NANOSECONDS[b["time_unit"]])]


STAGE_STATES = {"0": "falling", "250": "collapsing", "800": "at rest"}
# The least that each stage must do in a step at rest, counted from the code: floating-point operations and bytes, for
# each contact and for each grain. docs/performance.md says what is counted.
SUB_STEPS = 8
LEAST = {"detection": {"contact": (30, 100), "grain": (70, 240)},
         "sub_steps": {"contact": (SUB_STEPS * (63 + 32), SUB_STEPS * (280 + 216)),
                       "grain": (SUB_STEPS * 30, SUB_STEPS * 150)}}
# What a core does in a cycle without effort: two operations on four numbers each, a load and a store of 16 bytes.
OPERATIONS_PER_CYCLE = 8
BYTES_PER_CYCLE = 32


def floor(stage, contacts_per_grain, megahertz):
    """Operations, bytes and nanoseconds a grain below which a step at rest cannot be; the slower of the two counts."""
    per_contact, per_grain = LEAST[stage]["contact"], LEAST[stage]["grain"]
    operations, transfers = (contacts_per_grain * c + g for c, g in zip(per_contact, per_grain))
    cycles = max(operations / OPERATIONS_PER_CYCLE, transfers / BYTES_PER_CYCLE)
    return operations, transfers, 1e3 * cycles / megahertz


def stage_rows(found, megahertz):
    """A row per stage, a column per state of the pour, ns per grain; then the floor at rest and how far above it is."""
    table = {}
    for b in found:
        _, stage, _, state = b["name"].split("/")[:4]
        table.setdefault(stage, {})[state.split(":")[1]] = 1e9 * b["s_per_grain"]
        contacts = b["contacts_per_grain"]  # the last is at rest
    yield ["stage of a step of `contact`, ns a grain", *STAGE_STATES.values(), "floor at rest", "over the floor",
           "operations", "bytes"]
    for stage, by_state in table.items():
        row = [stage.replace("_", " "), *(number(by_state[state]) for state in STAGE_STATES)]
        if stage not in LEAST:
            yield [*row, *[""] * 4]
            continue
        operations, transfers, least = floor(stage, contacts, megahertz)
        yield [*row, number(least), number(by_state["800"] / least), f"{operations:.0f}", f"{transfers:.0f}"]


def markdown(rows):
    header, *body = rows
    lines = [header, ["---"] * len(header), *body]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", restval="", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


def arguments(words):
    def list_of(kind):
        return lambda text: [kind(word) for word in text.split(",") if word]

    known = sorted({engine for engine, _ in SOLVERS})
    parser = argparse.ArgumentParser(prog="scripts/bench-table", description=(
        "Measures whole pours of rough 24-gons and of disks of 20 mm at 1 kHz with every engine, and the kernels and "
        "stages of the refined one; prints the tables and writes them to DIR/table.md and DIR/table.csv, which "
        "scripts/plot-scaling draws. Costs are CPU seconds of all threads per simulated second. Builds "
        "build/release/polargrain_bench first. Takes a quarter of an hour; with --grains 125,500 a minute."))
    parser.add_argument("--grains", type=list_of(int), default=SIZES, metavar="N,N...",
                        help=f"pours of rough grains, of {SIZES}")
    parser.add_argument("--disks", type=list_of(int), default=DISK_SIZES, metavar="N,N...", help="pours of disks")
    parser.add_argument("--engines", type=list_of(str), default=known, metavar="NAME,NAME...")
    parser.add_argument("--everything", action="store_true",
                        help=f"also beyond {LARGEST}, where a single run may take an hour")
    parser.add_argument("--repeats", type=int, default=1, help="of each pour, of which the cheapest counts (default 1)")
    parser.add_argument("-o", dest="folder", type=pathlib.Path, default=TOP / "out" / "bench", metavar="DIR")
    parser.add_argument("--program", default=str(TOP / "build" / "release" / "polargrain_bench"),
                        help="another build of polargrain_bench, which is then taken as it is")
    options = parser.parse_args(words)
    for n in options.grains + options.disks:
        if n not in SIZES:
            parser.error(f"there is no pour of {n}, but of {SIZES}")
    for engine in options.engines:
        if engine not in known:
            parser.error(f"there is no engine {engine}, but {known}")
    return options


def main():
    options = arguments(sys.argv[1:])
    options.folder.mkdir(parents=True, exist_ok=True)
    rows = []
    kernels = bench(options.program, KERNELS)
    stages = bench(options.program, STAGES)["benchmarks"]
    for case in cases(options.grains, options.disks, options.engines, options.everything):
        rows.append(pour(options.program, *case, options.repeats))
        print(f"{' '.join(map(str, case))}: {number(rows[-1].get('whole'))}", file=sys.stderr, flush=True)
        write_csv(options.folder / "table.csv", rows)
    text = "\n".join([*heading(kernels["context"]), "",
                      "CPU seconds per simulated second, by phase of the pour and over the whole of it:", "",
                      markdown(pour_rows(rows)), markdown(stage_rows(stages, kernels["context"]["mhz_per_cpu"])),
                      markdown(kernel_rows(kernels["benchmarks"]))])
    (options.folder / "table.md").write_text(text)
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
