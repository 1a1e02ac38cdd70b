#!/usr/bin/env python3
"""Draws the shipped outlines again: shapes/outlines/*.toml, or into the folder given.

Every file is a pure function of the numbers below; running this must not change any of them.
Lengths in mm. Points run counter-clockwise.
"""

import math
import pathlib
import random
import sys

FOLDER = pathlib.Path(__file__).resolve().parent / "outlines"


def polar(radius, degrees):
    return (radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees)))


def fourier_grain(seed, mean_radius, d2, d3, d8, count):
    """Radius as a Fourier series: amplitude d2 in mode 2, from 3 on falling as n^-2 from d3, from 8 on from d8."""
    phases = random.Random(seed)
    terms = [(2, d2, phases.uniform(0.0, 2.0 * math.pi))]
    for n in range(3, count // 4 + 1):
        amplitude = d3 * (3.0 / n) ** 2 if n < 8 else d8 * (8.0 / n) ** 2
        terms.append((n, amplitude, phases.uniform(0.0, 2.0 * math.pi)))
    points = []
    for k in range(count):
        angle = 2.0 * math.pi * k / count
        series = sum(a * math.cos(n * angle + phase) for n, a, phase in terms)
        points.append(polar(mean_radius * (1.0 + series), math.degrees(angle)))
    return points


def cut_by_line(points, nx, ny, distance):
    """What of a convex outline lies at x nx + y ny <= distance."""
    kept = []
    for k, a in enumerate(points):
        b = points[(k + 1) % len(points)]
        da = a[0] * nx + a[1] * ny - distance
        db = b[0] * nx + b[1] * ny - distance
        if da <= 0.0:
            kept.append(a)
        if da * db < 0.0:
            t = da / (da - db)
            kept.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
    return kept


def crushed_grain(seed, length, aspect, facets, notch, piece):
    """Straight facets at random angles and distances about an ellipse, each in pieces; every third facet is hollowed
    by `notch` of its length. Corners stay sharp."""
    draw = random.Random(seed)
    half = 0.5 * length
    outline = [(-length, -length), (length, -length), (length, length), (-length, length)]
    for k in range(facets):
        angle = 2.0 * math.pi * (k + draw.uniform(-0.38, 0.38)) / facets
        nx, ny = math.cos(angle), math.sin(angle)
        support = half * math.hypot(nx, aspect * ny)
        outline = cut_by_line(outline, nx, ny, support * draw.uniform(0.80, 1.0))
    points = []
    for k, a in enumerate(outline):
        b = outline[(k + 1) % len(outline)]
        side = math.hypot(b[0] - a[0], b[1] - a[1])
        pieces = max(1, round(side / (piece * length)))
        hollow = notch * side if k % 3 == 0 and pieces > 1 else 0.0
        inward = (-(b[1] - a[1]) / side, (b[0] - a[0]) / side)
        for i in range(pieces):
            t = i / pieces
            depth = hollow * 4.0 * t * (1.0 - t)
            points.append((a[0] + t * (b[0] - a[0]) + depth * inward[0], a[1] + t * (b[1] - a[1]) + depth * inward[1]))
    return points


def along_sides(corners, pieces):
    points = []
    for k, a in enumerate(corners):
        b = corners[(k + 1) % len(corners)]
        n = pieces[k % len(pieces)]
        points += [(a[0] + (b[0] - a[0]) * i / n, a[1] + (b[1] - a[1]) * i / n) for i in range(n)]
    return points


def rounded_bar(length, width, per_end):
    end = 0.5 * (length - width)
    right = [(end + x, y) for x, y in (polar(0.5 * width, -90.0 + 180.0 * k / (per_end - 1)) for k in range(per_end))]
    return right + [(-x, -y) for x, y in right]


def star(radius, inner_radius, count):
    return [polar(radius if k % 2 == 0 else inner_radius, 90.0 + 180.0 * k / count) for k in range(2 * count)]


def gear(teeth, tip_radius, root_radius, tip_share, root_share):
    """Teeth with straight flanks; the tips take tip_share of a pitch and the gaps root_share, each with a middle vertex."""
    pitch = 360.0 / teeth
    points = []
    for k in range(teeth):
        middle = pitch * k
        points += [polar(tip_radius, middle + pitch * tip_share * s) for s in (-0.5, 0.0, 0.5)]
        points += [polar(root_radius, middle + pitch * (0.5 + root_share * s)) for s in (-0.5, 0.0, 0.5)]
    return points


def plus_sign(span, arm_width, pieces):
    s, w = 0.5 * span, 0.5 * arm_width
    corners = [(s, -w), (s, w), (w, w), (w, s), (-w, s), (-w, w), (-s, w), (-s, -w), (-w, -w), (-w, -s), (w, -s), (w, -w)]
    return along_sides(corners, [2, pieces, pieces])


def trilobe(lobe_radius, centre_distance, count):
    """Envelope of three equal circles whose centres lie on a circle."""
    points = []
    for k in range(count):
        degrees = 360.0 * k / count
        off = math.radians((degrees + 60.0) % 120.0 - 60.0)  # from the nearest lobe
        radius = centre_distance * math.cos(off) + math.sqrt(
            lobe_radius**2 - (centre_distance * math.sin(off)) ** 2)
        points.append(polar(radius, degrees))
    return points


def rice(length, width, count):
    """Half width w (1 - s^2)^0.45 (1 + 0.12 s) over s = x / half length: one end blunter than the other."""
    points = []
    for k in range(count):
        angle = 2.0 * math.pi * k / count
        s = math.cos(angle)
        side = 1.0 if math.sin(angle) >= 0.0 else -1.0
        half = 0.5 * width * max(0.0, 1.0 - s * s) ** 0.45 * (1.0 + 0.12 * s)
        points.append((0.5 * length * s, side * half))
    return points


def bean(spine_radius, half_width, half_angle, per_side, per_end):
    """A rounded bar bent along an arc about the origin, hollow side down."""
    def arc(centre, radius, start, end, count):
        steps = [start + (end - start) * k / (count - 1) for k in range(count)]
        return [(centre[0] + x, centre[1] + y) for x, y in (polar(radius, degrees) for degrees in steps)]

    right, left = 90.0 - half_angle, 90.0 + half_angle
    outer = arc((0.0, 0.0), spine_radius + half_width, right, left, per_side)
    left_end = arc(polar(spine_radius, left), half_width, left, left + 180.0, per_end)
    inner = arc((0.0, 0.0), spine_radius - half_width, left, right, per_side - 4)
    right_end = arc(polar(spine_radius, right), half_width, right + 180.0, right + 360.0, per_end)
    return outer + left_end[1:-1] + inner + right_end[1:-1]


SAND = ("Drawn for this project: radius as a Fourier series about mean radius {r} mm, amplitude {d2} in mode 2, "
        "{d3} (3/n)^2 in modes 3 to 7, {d8} (8/n)^2 from mode 8, random phases (seed {seed})")
CRUSHED = ("Drawn for this project: {facets} straight facets at random angles and distances about an ellipse of "
           "{length} mm and aspect {aspect}, every third one hollowed by {notch} of its length (seed {seed})")
BUILT = "Constructed for this project from its dimensions: {}"


def sand(name, title, seed, r, d2, d3, d8, count=48):
    return name, title, SAND.format(r=r, d2=d2, d3=d3, d8=d8, seed=seed), fourier_grain(seed, r, d2, d3, d8, count)


def crushed(name, title, seed, length, aspect, facets, notch, piece=0.14):
    source = CRUSHED.format(facets=facets, length=length, aspect=aspect, notch=notch, seed=seed)
    return name, title, source, crushed_grain(seed, length, aspect, facets, notch, piece)


def built(name, title, dimensions, points):
    return name, title, BUILT.format(dimensions), points


OUTLINES = [
    sand("sand-rounded", "Well-rounded sand grain, 0.5 mm", 11, 0.25, 0.06, 0.02, 0.003),
    sand("sand-subrounded", "Sub-rounded sand grain, 1 mm", 23, 0.5, 0.09, 0.04, 0.006),
    sand("sand-subangular", "Sub-angular sand grain, 1 mm", 38, 0.5, 0.10, 0.05, 0.016),
    sand("sand-elongated", "Elongated sand grain, 1.2 mm", 43, 0.5, 0.22, 0.04, 0.007),
    crushed("sand-angular", "Angular sand grain, 1 mm", 5, 1.0, 0.80, 9, 0.05),
    crushed("gravel", "Crushed stone, 20 mm", 8, 20.0, 0.85, 8, 0.04),
    crushed("gravel-flaky", "Flaky crushed stone, 22 mm", 14, 22.0, 0.48, 9, 0.05, 0.12),
    sand("pebble", "River pebble, 32 mm", 3, 14.0, 0.14, 0.03, 0.002),
    built("rice", "Grain of rice, 7 x 2.1 mm", "length 7 mm, width 2.1 mm, half width w (1 - s^2)^0.45 (1 + 0.12 s)",
          rice(7.0, 2.1, 32)),
    built("bean", "Bean, 12 mm, hollow on one side",
          "bar with rounded ends, 4.8 mm wide, bent along 70 degrees of a circle of radius 6.2 mm",
          bean(6.2, 2.4, 35.0, 13, 10)),
    built("trilobe", "Three-lobed pellet, 3 mm", "three circles of radius 0.75 mm, 0.7 mm from the middle",
          trilobe(0.75, 0.7, 48)),
    built("stick", "Stick with rounded ends, 20 x 3 mm", "length 20 mm, width 3 mm, 8 vertices to an end",
          rounded_bar(20.0, 3.0, 8)),
    built("domino", "Domino, 41.8 x 7.5 mm",
          "height 41.8 mm, width 7.5 mm (Hogue & Newland 1994, section 4.1), 24 vertices spread along the sides",
          along_sides([(-3.75, -20.9), (3.75, -20.9), (3.75, 20.9), (-3.75, 20.9)], [2, 10])),
    built("hexagon", "Regular hexagon, 10 mm across corners", "corners 5 mm from the centre",
          [polar(5.0, 60.0 * k) for k in range(6)]),
    built("star", "Five-pointed star, 20 mm", "points 10 mm and notches 4 mm from the centre", star(10.0, 4.0, 5)),
    built("cross", "Plus sign, 20 mm, arms 6 mm wide", "span 20 mm, arms 6 mm wide", plus_sign(20.0, 6.0, 3)),
    built("gear", "Gear of 10 teeth, 20 mm: deeply non-convex",
          "10 teeth, tip radius 10 mm over 0.30 of the pitch, root radius 4.6 mm over 0.40 of it",
          gear(10, 10.0, 4.6, 0.30, 0.40)),
]


def write(folder, name, title, source, points):
    decimals = 5 if max(math.hypot(x, y) for x, y in points) < 2.0 else 4

    def number(value):
        return f"{round(value, decimals) + 0.0:.{decimals}f}"  # + 0.0: no "-0"

    rows = [f"    [{number(x)}, {number(y)}]," for x, y in points]
    text = [f'title = "{title}"', f'source = "{source}"', 'unit = "mm"', "points = [", *rows, "]", ""]
    (folder / f"{name}.toml").write_text("\n".join(text), encoding="utf-8")


if __name__ == "__main__":
    for outline in OUTLINES:
        write(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER, *outline)
