# What scripts/demo and scripts/test share; to be sourced. Sets `top` and `build`.
top=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
build=$top/build/release

# prepare SCRIPT ARGUMENTS...: reads --no-install and --help, installs what is missing, configures. From any folder.
prepare() {
    local script=$1 install=yes
    shift
    for argument in "$@"; do
        case $argument in
            --no-install) install=no ;;
            -h | --help) usage && exit 0 ;;
            *) echo "$script: unknown argument $argument; see $script --help" >&2 && exit 2 ;;
        esac
    done
    if [[ $install == yes ]]; then "$top/scripts/install-packages.sh"; fi

    local generator="Unix Makefiles"
    if command -v ninja >/dev/null; then generator=Ninja; fi
    # A folder that is configured already keeps its generator: CMake refuses to change it.
    if [[ -f $build/CMakeCache.txt ]]; then
        generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
    fi
    (cd "$top" && cmake --preset release -G "$generator")
}
