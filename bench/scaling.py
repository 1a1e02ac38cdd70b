"""What scripts/plot-scaling does: cost over number of grains on log axes, with fitted powers."""

import argparse
import csv
import math
import pathlib
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[1]
PHASES = {"whole": "whole pour", "collapse": "collapse", "rest": "at rest"}
# As in src/plot: distinguishable also for the colour-blind.
PALETTE = ["#0072b2", "#d55e00", "#009e73", "#b5468c", "#56a0d3", "#c78f00", "#444444", "#8c6d4f"]


def fit_power(points):
    """Factor and exponent of y = factor x^exponent through (x, y) points, by least squares of the logarithms; None
    where there are not two different x."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x > 0 and y > 0]
    n = len(logs)
    if n < 2:
        return None
    mean_x, mean_y = (sum(values) / n for values in zip(*logs))
    spread = sum((x - mean_x) ** 2 for x, _ in logs)
    if spread == 0.0:
        return None
    exponent = sum((x - mean_x) * (y - mean_y) for x, y in logs) / spread
    return math.exp(mean_y - exponent * mean_x), exponent


def curves(rows, phase):
    """(engine and threads) -> [(grains, cost)] of the rough grains, in the order of the table."""
    found = {}
    for row in rows:
        if row["scene"] == "rough" and row[phase]:
            label = row["engine"] if row["threads"] == "1" else f"{row['engine']}, {row['threads']} threads"
            found.setdefault(label, []).append((float(row["grains"]), float(row[phase])))
    return {label: sorted(points) for label, points in found.items()}


def panel(rows, phase, number):
    """Data blocks and plot command of one phase."""
    blocks, parts = [], []
    for index, (label, points) in enumerate(curves(rows, phase).items()):
        colour, name = PALETTE[index % len(PALETTE)], f"$data_{number}_{index}"
        blocks.append(f"{name} << EOD\n" + "".join(f"{x:g} {y:g}\n" for x, y in points) + "EOD")
        fit = fit_power(points)
        title = f"{label}: n^{{{fit[1]:.2f}}}" if fit else label
        parts.append(f"{name} with points pt {5 + 2 * (index % 5)} ps 1.2 lc rgb '{colour}' title '{title}'")
        if fit:
            low, high = points[0][0], points[-1][0]
            parts.append(f"[{low:g}:{high:g}] {fit[0]:g} * x**{fit[1]:g} with lines lw 2 lc rgb '{colour}' notitle")
    return blocks, f"set title '{PHASES[phase]}'\nplot " + ", \\\n  ".join(parts)


def script(rows, output, terminal):
    panels = [panel(rows, phase, number) for number, phase in enumerate(PHASES)]
    blocks = "\n".join(block for found, _ in panels for block in found)
    plots = "\n".join(plot for _, plot in panels)
    return f"""{blocks}
set terminal {terminal}
set output '{output}'
set encoding utf8
set logscale xy
set grid lc rgb '#dddddd'
set key top left reverse Left samplen 1
set xlabel 'grains'
set xrange [100:10000]
set multiplot layout 1,{len(PHASES)} title 'Rough grains poured at 1 kHz, with every engine'
set ylabel 'CPU seconds per simulated second'
{plots}
unset multiplot
"""


def exponent_lines(rows):
    for phase, name in PHASES.items():
        for label, points in curves(rows, phase).items():
            fit = fit_power(points)
            if fit:
                yield f"{name}, {label}: {fit[0]:.3g} n^{fit[1]:.2f} ({len(points)} sizes)"


def main():
    parser = argparse.ArgumentParser(prog="scripts/plot-scaling", description=(
        "Draws the cost of pours over the number of grains from the table that scripts/bench-table has written, on log "
        "axes and with fitted powers, beside the table as scaling.png and scaling.pdf; prints the exponents."))
    parser.add_argument("table", nargs="?", type=pathlib.Path, default=TOP / "out" / "bench" / "table.csv")
    table = parser.parse_args().table
    if not table.exists():
        parser.error(f"{table} is missing; scripts/bench-table writes it")
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    for extension, terminal in (("png", "pngcairo size 1500,560 font 'DejaVu Sans,10'"),
                                ("pdf", "pdfcairo size 15,5.6 font 'DejaVu Sans,10'")):
        subprocess.run(["gnuplot"], input=script(rows, table.with_name(f"scaling.{extension}"), terminal), text=True,
                       check=True)
    print("\n".join(exponent_lines(rows)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
