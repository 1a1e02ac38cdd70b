#!/usr/bin/env bash
# Installs the Debian 12 packages that polargrain needs and that are missing. Says what it installs.
# Uses apt-get directly as root, and sudo otherwise. Changes nothing where everything is there.
set -euo pipefail

packages=(
    build-essential cmake ninja-build pkg-config git python3
    libeigen3-dev libcgal-dev libcairo2-dev libpng-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libhdf5-dev
    libfmt-dev librandom123-dev libxxhash-dev libbox2d-dev libtbb-dev
    libgtest-dev libgmock-dev libbenchmark-dev
    fonts-dejavu-core gnuplot-nox clang-format clang-tidy valgrind
)
# Save time (ccache) or make movies (ffmpeg) where they are there; their absence stops nothing.
optional=(ccache ffmpeg)

installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q '^install ok installed$'; }

missing=()
for package in "${packages[@]}" "${optional[@]}"; do
    installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    echo "packages: all there"
    exit 0
fi

if ! command -v apt-get >/dev/null; then
    echo "These packages are missing, and there is no apt-get to install them with: ${missing[*]}" >&2
    echo "Install their equivalents by hand, then use --no-install." >&2
    exit 1
fi
as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "These packages are missing: ${missing[*]}" >&2
        echo "Run  apt-get install ${missing[*]}  as root, then use --no-install." >&2
        exit 1
    fi
    as_root=(sudo)
fi

echo "packages: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
