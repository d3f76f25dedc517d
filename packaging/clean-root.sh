#!/usr/bin/env bash
# A clean root of a Debian release: the smallest system that has apt, made with mmdebstrap from the sources of this
# machine. Needs root.
#
#   clean-root.sh SUITE [-- COMMAND [ARGUMENT]...]
#     Copies this checkout into a clean root of SUITE (bookworm, trixie, sid) and runs COMMAND there, in the checkout.
#     Without a command: what a new user types, `./evalcts run` and `./evalcts test`. Both have to end with exit code 0,
#     and nothing in the run may be unexpected. Exit code 77: the root could not be made (no network, no such suite).
#
# Sourced by other scripts it defines make_root, inside and remove_root and runs nothing.

# Makes a clean root of the suite in $root, with /proc, /dev and /dev/pts.
make_root() { # suite, folder
  local suite=$1 here file options=()
  root=$2/root
  sources=$2/sources
  for file in /etc/apt/apt.conf.d/*; do grep -q '^ *Acquire::' "$file" && options+=("--aptopt=$file"); done
  # The sources of this machine; those of another release have its name, and unstable has neither updates nor a
  # security archive.
  # shellcheck source=/dev/null
  here=$(. /etc/os-release && echo "$VERSION_CODENAME")
  cat /etc/apt/sources.list /etc/apt/sources.list.d/*.sources 2>/dev/null >"$sources" || true
  if [[ $suite != "$here" ]]; then
    sed -i "s/\b$here\b/$suite/g" "$sources"
    [[ $suite == sid ]] && sed -i -E 's/ sid-updates//; s/^Suites: sid-security$/Enabled: no\n&/' "$sources"
  fi
  mmdebstrap --quiet --variant=apt "${options[@]}" "$suite" "$root" - <"$sources" || return 77
  # apt inside needs what the machine's apt needs to reach its sources.
  for file in "${options[@]}"; do cp "${file#--aptopt=}" "$root/etc/apt/apt.conf.d/"; done
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  mount --make-private "$root/dev" # what is mounted below must not appear in this machine's /dev
  mount -t devpts devpts "$root/dev/pts"
  mount -t tmpfs tmpfs "$root/dev/shm"
}

# Runs a command in the root, with nothing of this machine's environment.
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"; }

remove_root() { # folder
  local mounted
  for mounted in dev/shm dev/pts dev proc; do umount --lazy "$1/root/$mounted" 2>/dev/null; done
  rm -rf --one-file-system "$1"
}

[[ ${BASH_SOURCE[0]} == "$0" ]] || return 0

set -euo pipefail
suite=${1:?usage: clean-root.sh SUITE [-- COMMAND [ARGUMENT]...]}
shift
[[ ${1:-} == -- ]] && shift
[[ $EUID == 0 ]] || { echo "only root can make a clean root" >&2; exit 77; }
checkout=$(cd "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'remove_root "$work"' EXIT
trap 'exit 130' INT TERM HUP
make_root "$suite" "$work" || { echo "no clean root of $suite (no network?)" >&2; exit 77; }

# What a fresh clone has, and files that are not committed yet.
mkdir "$root/root/evalcts"
(
  cd "$checkout"
  git -c safe.directory='*' ls-files -z --cached --others --exclude-standard |
    while IFS= read -r -d '' file; do [[ ! -e $file ]] || printf '%s\0' "$file"; done |
    tar --create --no-recursion --null --files-from=-
) | tar --extract --no-same-owner -C "$root/root/evalcts"

in_checkout() { inside sh -c 'cd /root/evalcts && exec "$@"' sh "$@"; }
if (($#)); then
  in_checkout "$@"
  exit
fi
in_checkout ./evalcts run | tee "$work/run"
grep -q '^nothing unexpected' "$work/run" || { echo "the run says nothing of what was expected" >&2; exit 1; }
in_checkout ./evalcts test
