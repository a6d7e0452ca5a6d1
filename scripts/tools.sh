# Sourced by ./demo and ./check: puts everything the build needs on PATH, or says what to install.
#
# The Manifold kernel is C++ and is built by cmake and ninja. Where they are missing they come from
# the package manager (as root) or as Python wheels into .venv-tools beside this folder.

tools_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
tools_venv="$tools_root/.venv-tools"

have() { command -v "$1" >/dev/null 2>&1; }
say() { printf 'centrode: %s\n' "$*" >&2; }

[ -d "$HOME/.cargo/bin" ] && PATH="$PATH:$HOME/.cargo/bin"
[ -d "$tools_venv/bin" ] && PATH="$PATH:$tools_venv/bin"
export PATH

have cargo || { say "Rust is missing; install it from https://rustup.rs and open a new shell"; exit 1; }
if ! have "${CXX:-c++}" && ! have g++ && ! have clang++; then
    say "a C++ compiler is missing; install one (Debian: apt-get install g++)"
    exit 1
fi

have_build_tools() { have cmake && have ninja; }

tools_from_apt() {
    [ "$(id -u)" = 0 ] && have apt-get || return 1
    say "installing cmake and ninja with apt-get"
    apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq cmake ninja-build
} >&2

tools_from_wheels() {
    have python3 || return 1
    say "fetching cmake and ninja as Python wheels into .venv-tools"
    if ! python3 -m venv "$tools_venv" 2>/dev/null; then
        # Debian ships venv apart from Python; pip alone can fill a folder too.
        rm -rf "$tools_venv"
        python3 -m pip install --quiet --target "$tools_venv" cmake ninja || return 1
        export PYTHONPATH="$tools_venv${PYTHONPATH:+:$PYTHONPATH}"
    else
        "$tools_venv/bin/pip" install --quiet --disable-pip-version-check cmake ninja || return 1
    fi
    PATH="$PATH:$tools_venv/bin"
} >&2

have_build_tools || tools_from_apt || true
have_build_tools || tools_from_wheels || true
have_build_tools || {
    say "cmake and ninja are missing and could not be fetched; install both"
    say "(Debian: apt-get install cmake ninja-build; elsewhere: pip install cmake ninja)"
    exit 1
}
