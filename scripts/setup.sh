#!/usr/bin/env bash
# Usage: scripts/setup.sh [--test] [--bench] [--fuzz] [--format] [--help]
# Installs what building and running the program need and this system lacks: Debian 12 or later, Ubuntu 24.04. Also what
# the tests need with --test (other readers of results, R among them), the comparison with other solvers with --bench,
# the fuzzers with --fuzz, and the check of formatting with --format.
# RIDGELOC_SKIP_SETUP=1: trust that everything is there.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config git
  libeigen3-dev libceres-dev libtbb-dev libhdf5-dev libcli11-dev libtomlplusplus-dev libfmt-dev
  libxsimd-dev libssl-dev libxxhash-dev gnuplot-nox
)
# With the compiler cache: who tests builds often.
test_packages=(
  ccache catch2 librandom123-dev
  # Other readers of the result files.
  python3-h5py python3-xarray python3-h5netcdf python3-netcdf4
  netcdf-bin r-base-core r-bioc-rhdf5
)
bench_packages=(ccache libbenchmark-dev libgsl-dev libcminpack-dev python3-scipy valgrind)
fuzz_packages=(clang-19 libclang-rt-19-dev)
# Other versions format otherwise.
format_packages=(clang-format-14)

say() { echo "setup: $*" >&2; }
fail() { say "$*"; exit 1; }

is_installed() {
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

has_candidate() {
  local policy
  policy="$(LC_ALL=C apt-cache policy "$1")"
  [[ "$policy" == *"Candidate: "* && "$policy" != *"Candidate: (none)"* ]]
}

# Runs a command as root and shows what it printed only if it fails. The package database may be in use by someone
# else for minutes (unattended upgrades): waits for it.
as_root_quietly() {
  local output
  output="$("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "$@" </dev/null 2>&1)" || {
    printf '%s\n' "$output" >&2
    return 1
  }
}
apt=(apt-get -qq -o DPkg::Lock::Timeout=900 -o Dpkg::Use-Pty=0)

for option in "$@"; do
  case "$option" in
    --test) packages+=("${test_packages[@]}") ;;
    --bench) packages+=("${bench_packages[@]}") ;;
    --fuzz) packages+=("${fuzz_packages[@]}") ;;
    --format) packages+=("${format_packages[@]}") ;;
    -h | --help) sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) fail "unknown option '$option'; allowed: --test, --bench, --fuzz, --format, --help" ;;
  esac
done

if [[ "${RIDGELOC_SKIP_SETUP:-0}" == 1 ]]; then
  say "skipped, as RIDGELOC_SKIP_SETUP=1 asks"
  exit 0
fi
if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  fail "no apt on this system; install the equivalents of these Debian packages, then run again with" \
    "RIDGELOC_SKIP_SETUP=1: ${packages[*]}"
fi

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  say "all ${#packages[@]} packages are installed, nothing to do"
  exit 0
fi

if ((EUID == 0)); then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
else
  fail "packages are missing and this user may not install them; run:" \
    "sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}"
fi

say "updating the package lists"
as_root_quietly "${apt[@]}" -o APT::Update::Error-Mode=any update ||
  say "not every package list could be updated (above); going on with what there is"

unknown=()
for package in "${missing[@]}"; do
  has_candidate "$package" || unknown+=("$package")
done
if ((${#unknown[@]} > 0)); then
  fail "the package sources of this system do not offer: ${unknown[*]}; Debian 12 and Ubuntu 24.04 do" \
    "(on Ubuntu switch universe on: sudo add-apt-repository universe)"
fi

say "installing ${missing[*]}"
as_root_quietly "${apt[@]}" install --no-install-recommends --yes "${missing[@]}" ||
  fail "apt-get install failed; its output is above"
say "done"
