#!/usr/bin/env bash
# Installs the packages into a clean root and uses them there, as on a machine that has nothing else.
# Usage: check.sh FOLDER-WITH-PACKAGES. Needs root, mmdebstrap and the sources of apt.
set -euo pipefail
packages=$1
fail() { echo "$*" >&2; exit 1; }
work=$(mktemp -d)
# shellcheck source-path=SCRIPTDIR source=../../packaging/clean-root.sh
. "$(dirname -- "${BASH_SOURCE[0]}")/../../packaging/clean-root.sh"
trap 'remove_root "$work"' EXIT
# shellcheck source=/dev/null
make_root "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$work" || fail "no clean root"
cp "$packages"/evalcts_*.deb "$packages"/libglevaluator-dev_*.deb "$root/tmp"
inside apt-get -qq update
inside sh -c 'DEBIAN_FRONTEND=noninteractive apt-get -qq install --no-install-recommends /tmp/evalcts_*.deb libosmesa6' >"$work/log" 2>&1 ||
  { cat "$work/log"; fail "the package cannot be installed"; }

inside sh -c 'evalcts --version && evalcts-suite --help >/dev/null'
inside sh -c 'cd /root && evalcts run --depth quick --strict --implementation osmesa --implementation dropin' >"$work/run" 2>&1 ||
  { cat "$work/run"; fail "a run has unexpected results"; }
grep -q '^No new failures; [1-9][0-9]* known ' "$work/run" ||
  fail "the installed program does not find the installed baseline"
[[ -s $root/root/evalcts-results/latest/index.html ]] || fail "no page where an installed program writes it"
inside sh -c 'cd /tmp && evalcts vectors lint && evalcts explain EV-MAP1-ERR-STRIDE >/dev/null && { evalcts faults || test $? = 2; }' \
  >"$work/log" 2>"$work/faults" || { cat "$work/log" "$work/faults"; fail "a command fails that needs what is installed"; }
grep -q 'In a checkout' "$work/faults" || fail "faults does not say what it lacks: $(cat "$work/faults")"

inside sh -c 'DEBIAN_FRONTEND=noninteractive apt-get -qq install --no-install-recommends /tmp/libglevaluator-dev_*.deb gcc libc6-dev pkgconf' \
  >"$work/log" 2>&1 || { cat "$work/log"; fail "the package of the library cannot be installed"; }
# The first program of its README.
awk '/^```/ { if (on) exit; on = /^```c$/; next } on' "$root/usr/share/doc/glevaluator/README.md" >"$root/tmp/curve.c"
# shellcheck disable=SC2016 # the shell in the root expands it
inside sh -c 'cd /tmp && cc curve.c -o curve $(pkg-config --cflags --libs glevaluator) && ./curve' | tail -n 1 | grep -qx '4 0 0\|2 1.5 0' ||
  fail "the program of the README prints something else"
inside sh -c 'apt-get -qq remove evalcts libglevaluator-dev >/dev/null && ! ls /usr/bin/evalcts* /usr/include/gleval* 2>/dev/null' ||
  fail "something stays behind"
echo "the packages install, run and go again"
