#!/bin/sh
# Set up .venv with pinned packages, and the system libraries that SUMO needs.
#
#     scripts/setup.sh runtime    what `make chat` and `make dashboard` need
#     scripts/setup.sh develop    that, netconvert and the tools of `make test`
#     scripts/setup.sh browser    that, and the Chromium of `make test-browser`; XAVI_CHROMIUM
#                                 names another one
#     scripts/setup.sh docs       what `make docs` needs
#
# Quick when there is nothing to do. Safe to interrupt: the next run repairs what was half made.
# Standard input and output belong to the passenger, so all notes go to standard error.
set -eu
exec </dev/null 1>&2
cd "$(dirname "$0")/.."

python=${PYTHON:-python3}
venv=.venv
level=${1:-runtime}
browser=
libraries="libgl1 libx11-6 libxext6 libxrender1 libatomic1 libexpat1"

say() { echo "xavi: $*"; }
fail() { say "$*"; exit 1; }

case $level in
    runtime | develop | docs) ;;
    browser) level=develop browser=wanted ;;
    *) fail "unknown level '$level': runtime or develop or docs or browser" ;;
esac

# What a finished environment was made of: where it lies, and every file that decides its content.
recipe() { pwd; cat pyproject.toml constraints.txt scripts/setup.sh; }
finished() { [ -f "$venv/finished-$1" ] && recipe | cmp -s - "$venv/finished-$1"; }
ready() {
    finished "$level" && return
    [ "$level" = runtime ] && { finished develop || finished docs; }
}

# Install Debian packages where this is permitted, else print the command that does.
system_install() {
    command="apt-get install -y --no-install-recommends $*"
    if ! command -v apt-get >/dev/null; then
        fail "this machine has no apt-get; please install what corresponds to: $*"
    elif [ "$(id -u)" = 0 ]; then
        as_root=""
    elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
        as_root="sudo -n"
    else
        fail "system packages are missing. Please run:  sudo $command"
    fi
    say "installing system packages: $*"
    export DEBIAN_FRONTEND=noninteractive
    $as_root apt-get update -qq || say "apt-get update failed; trying with the lists at hand"
    $as_root $command || fail "that failed. Please run:  sudo $command"
}

check_python() {
    command -v "$python" >/dev/null ||
        fail "'$python' was not found. Name a Python 3.11 or newer:  make chat PYTHON=python3.11"
    "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || fail "$("$python" -V) is" \
        "too old: 3.11 or newer is needed. Name one:  make chat PYTHON=python3.11"
}

# An environment counts as sound if its Python and pip start and no installation broke off in it.
make_venv() {
    if [ ! -e "$venv/unfinished" ] && "$venv/bin/python" -m pip --version >/dev/null 2>&1; then
        return
    fi
    check_python
    if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        system_install "$("$python" -c 'import sys; print("python%d.%d-venv" % sys.version_info[:2])')"
    fi
    say "making $venv"
    rm -rf "$venv"
    "$python" -m venv "$venv"
}

pip_install() {
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -c constraints.txt "$@" ||
        fail "pip could not install the packages; its message stands above"
}

install() {
    : >"$venv/unfinished"
    say "installing pinned packages (the first time about 1 GB on disk)"
    pip_install setuptools
    case $level in
        runtime) pip_install --no-build-isolation --editable '.[dashboard]' ;;
        docs) pip_install --no-build-isolation --editable '.[dashboard,docs,tables,viewers]' ;;
        develop) pip_install --no-build-isolation --editable '.[audit,browser,cluster,dashboard,dev,maps,tables,viewers]' ;;
    esac
    rm "$venv/unfinished"
}

# Its message names one missing library at a time, so all of them are installed at once.
check_libsumo() {
    "$venv/bin/python" -c 'import libsumo' 2>/dev/null && return
    system_install "$libraries"
    "$venv/bin/python" -c 'import libsumo' || fail "SUMO does not load; its message stands above"
}

find_browser() {
    for name in ${XAVI_CHROMIUM:-chromium chromium-browser google-chrome}; do
        command -v "$name" >/dev/null && return
    done
    return 1
}

check_browser() {
    [ -n "$browser" ] || return 0
    find_browser && return
    [ -z "${XAVI_CHROMIUM:-}" ] || fail "XAVI_CHROMIUM names '$XAVI_CHROMIUM', which was not found"
    system_install chromium fonts-dejavu-core
    find_browser || fail "Chromium was installed, but there is no program 'chromium'"
}

# What the planner's compiled kernels were made of.
kernels() { cat planner/kernels/*.py; }

# Compile them, so that the first ride starts at once.
warm() {
    kernels | cmp -s - "$venv/warm" && return
    say "compiling the planner"
    # numba compiles anew what has changed, but not what calls it.
    rm -f planner/kernels/__pycache__/*.nb[ic]
    "$venv/bin/python" -m xavi_dialogue.vehicle.compile_kernels ||
        fail "the planner does not compile; its message stands above"
    kernels >"$venv/warm"
}

finish() { check_browser; warm; exit; }

ready && finish
# One set-up at a time; the lock goes with the process, however that ends.
if command -v flock >/dev/null; then
    exec 9>.setup.lock
    flock -n 9 || { say "another set-up is under way; waiting for it"; flock 9; }
    ready && finish
fi
make_venv
install
check_libsumo
recipe >"$venv/finished-$level"
check_browser
warm
say "ready"
