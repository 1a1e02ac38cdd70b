#!/usr/bin/env python3
"""Rules on the tree as a whole that no compiler checks; docs/architecture.md explains them.

usage: check_tree.py TOP      prints one line per violation, exit code 1 if there are any
"""

import pathlib
import re
import sys

SOURCE_FOLDERS = ("src", "shapes", "scenarios", "render", "tests", "bench")
LONGEST_FILE = 500

# Layer -> the layers it may include beside itself. Tests and benchmarks may include everything.
BELOW = {
    "src/core": set(),
    "src/geometry": {"src/core"},
    "src/model": {"src/core", "src/geometry"},
    "src/detect": {"src/core", "src/geometry", "src/model"},
    "src/observe": {"src/core", "src/geometry", "src/model", "src/detect"},
    "src/run": {"src/core", "src/geometry", "src/model", "src/observe"},
    "src/record": {"src/core", "src/geometry", "src/model", "src/observe", "src/run"},
    "src/theory": {"src/core"},
    "src/plot": {"src/core", "src/record"},
    "shapes": {"src/core", "src/geometry"},
    "scenarios": {"src/core", "src/geometry", "src/model", "src/detect", "src/observe", "shapes"},
    "render": {"src/core", "src/geometry", "src/model", "src/observe", "src/run", "src/record"},
    "src/export": {"src/core", "src/geometry", "src/model", "src/run", "src/record", "shapes", "render"},
    "src/compare": {"src/core", "src/geometry", "src/model", "src/observe", "src/run", "src/record", "src/plot"},
    "src/reproduce": {"src/core", "src/geometry", "src/model", "src/detect", "src/engines", "src/run", "src/observe",
                      "src/record", "src/plot", "src/theory", "shapes", "scenarios", "render"},
    "src/cli": {"src/reproduce", "src/core", "src/geometry", "src/model", "src/detect", "src/engines", "src/observe", "src/run", "src/record",
                "shapes", "scenarios", "render", "src/plot", "src/export", "src/compare"},
}
ENGINE_BELOW = {"src/core", "src/geometry", "src/model", "src/detect"}
BELOW["src/engines/box2d"] = ENGINE_BELOW | {"shapes"}
CGAL_FILES = ("shapes/outline.cpp", "shapes/convex_pieces.cpp")

# Third-party headers -> the layers that may include them; None: all.
THIRD_PARTY = {
    r"Eigen/": None,
    r"fmt/": None,
    r"Random123/|xxhash\.h": {"src/core"},
    r"CGAL/|boost/|gmp": {"shapes"},
    r"toml\+\+/|toml\.hpp": {"shapes", "scenarios"},
    r"hdf5": {"src/record", "tests"},
    r"nlohmann/": {"src/record", "src/reproduce", "src/cli", "tests"},
    r"cairo|png\.h|zlib\.h": {"render", "tests"},
    r"CLI/": {"src/cli"},
    r"box2d/": {"src/engines/box2d", "tests"},
    r"oneapi/tbb/": {"src/core"},
    r"gtest/|gmock/": {"tests"},
    r"benchmark/": {"bench"},
}
SYSTEM = re.compile(r"^([a-z_0-9]+|(unistd|fcntl|spawn|stdlib|poll)\.h|sys/[a-z]+\.h)$")

INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)', re.M)
# A type of a namespace: those of another type are indented.
DEFINED_TYPE = re.compile(r"^(?:struct|class|enum class|union) (?:alignas\(\d+\) )?(\w+)[^;{\n]*\{", re.M)
CITATION = re.compile(r"\[([A-Z][A-Za-z]*\d{2}[a-z]?)(?:[,;:\]])")
# Spelled in two halves, so that this file passes its own check.
UNFINISHED = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X)\b")


def sources(top):
    for folder in SOURCE_FOLDERS:
        for path in sorted((top / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path


def layer_of(name):
    """"src/engines/contact" for engines, "src/x" under src, else the top folder."""
    parts = name.split("/")
    if parts[:2] == ["src", "engines"]:
        return "/".join(parts[:3])
    return "/".join(parts[:2]) if parts[0] == "src" else parts[0]


def may_include(layer, other):
    if layer == other or layer in ("tests", "bench"):
        return True
    if layer.startswith("src/engines/"):
        return other in BELOW.get(layer, ENGINE_BELOW)
    if other.startswith("src/engines/"):
        other = "src/engines"
    return other in BELOW.get(layer, set())


def third_party_rule(header):
    """(is third party, layers that may include it or None for all)"""
    for pattern, layers in THIRD_PARTY.items():
        if re.match(pattern, header):
            return True, layers
    return not SYSTEM.match(header), set()


def includes(text):
    return INCLUDE.findall(text)


def private_headers(texts):
    """Our headers that show types of a third-party library other than Eigen and fmt, directly or through others."""
    private = {name for name, text in texts.items() if name.endswith(".h") and any(
        theirs and third_party_rule(theirs)[0] and third_party_rule(theirs)[1] is not None
        for _, theirs in includes(text))}
    while True:
        more = {name for name, text in texts.items() if name.endswith(".h") and name not in private and any(
            ours in private for ours, _ in includes(text))}
        if not more:
            return private
        private |= more


def check_layers(texts):
    private = private_headers(texts)
    for name, text in texts.items():
        layer = layer_of(name)
        for ours, theirs in includes(text):
            if ours and ours not in texts:
                yield f'{name}: includes "{ours}", which is not a path from the top of the tree'
            elif ours and not may_include(layer, layer_of(ours)):
                yield f'{name}: {layer} must not include "{ours}" of {layer_of(ours)}'
            elif ours in private and layer_of(ours) != layer and layer != "tests":
                yield f'{name}: includes "{ours}", which shows a third-party type of its own layer'
            if theirs:
                third_party, layers = third_party_rule(theirs)
                if third_party and layers is not None and layer not in layers:
                    yield f"{name}: {layer} must not include <{theirs}>"
    cgal = [name for name, text in texts.items() if any(theirs.startswith("CGAL/") for _, theirs in includes(text))]
    if strange := [name for name in cgal if name not in CGAL_FILES]:
        yield f"CGAL belongs in {' and '.join(CGAL_FILES)}, because it dominates the build time; found in " + ", ".join(
            strange)


def check_files(texts):
    for name, text in texts.items():
        lines = text.count("\n")
        if lines >= LONGEST_FILE:
            yield f"{name}: {lines} lines; split it (below {LONGEST_FILE})"
        for match in UNFINISHED.finditer(text):
            yield f"{name}: unfinished: {match.group()}"


def check_types(texts):
    """Two types of one name in one program share the code that the compiler makes for each, such as vectors of them,
    without a word from the linker: memory is overwritten."""
    where = {}
    for name, text in texts.items():
        if name.endswith(".h"):
            for match in DEFINED_TYPE.finditer(text):
                where.setdefault(match.group(1), []).append(name)
    for type_name, names in sorted(where.items()):
        if len(names) > 1:
            yield f"{names[0]}: {type_name} is also the name of a type in {', '.join(names[1:])}; rename one"


def citations(text, code):
    if code:
        text = "\n".join(re.findall(r"//.*", text))
    return set(CITATION.findall(text))


def check_citations(top, texts):
    listed = top / "docs/sources.md"
    known = set(re.findall(r"^\*\*\[(\w+)\]\*\*", listed.read_text(), re.M)) if listed.exists() else set()
    prose = [p for pattern in ("*.md", "docs/*.md", "scenarios/*.toml", "shapes/**/*.toml") for p in top.glob(pattern)]
    used = {name: citations(text, True) for name, text in texts.items()}
    used |= {str(p.relative_to(top)): citations(p.read_text(), False) for p in prose}
    for name, keys in sorted(used.items()):
        for key in sorted(keys - known):
            yield f"{name}: [{key}] is not in docs/sources.md"


def violations(top):
    texts = {str(path.relative_to(top)): path.read_text() for path in sources(top)}
    return [*check_layers(texts), *check_files(texts), *check_types(texts), *check_citations(top, texts)]


def main():
    found = violations(pathlib.Path(sys.argv[1]))
    print("\n".join(found) if found else "tree: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
