#!/usr/bin/env bash
# A clean root of a Debian release: the smallest system that has apt, made with mmdebstrap from the sources of this
# machine. Needs root.
#
#   clean-root.sh SUITE [-- COMMAND [ARGUMENT]...]
#     Copies this checkout into a clean root of SUITE (bookworm, trixie, sid) and runs COMMAND there, in the checkout.
#     Without a command: what a new user types, `./evalcts run` and `./evalcts test`. Both have to end with exit code 0,
#     and nothing in the run may be unexpected. Exit code 77: the root could not be made (no
#     network, no such suite, not root).
#
# Sourced by other scripts it defines make_root, inside and remove_root and runs nothing.

# Writes the Debian sources of this machine, under the name of another suite, into one file for each format of apt.
# Unstable has neither updates nor a security archive. Other archives and an Ubuntu's own are left out; if nothing is
# left, mmdebstrap takes Debian's default mirror.
write_sources() { # suite, folder
  local names='(bullseye|bookworm|trixie|forky|sid|stable|testing|unstable)'
  sed -nE "/^deb /{s/ $names/ $1/;/ sid-/d;/ $1/p}" /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null >"$2/sources.list"
  sed -sE "/^Suites:/{s/ $names/ $1/g;s/ sid-[a-z]+//g};\$G" /etc/apt/sources.list.d/*.sources 2>/dev/null |
    awk -v RS= -v ORS='\n\n' -v suite="$1" 'index($0, "Suites: " suite)' >"$2/sources.sources"
}

# Makes a clean root of the suite in $root, with /proc, /dev, /dev/pts and /dev/shm.
make_root() { # suite, folder
  local file options=() sources=()
  root=$2/root
  # The options with which this machine's apt reaches its sources. mmdebstrap keeps them in the root's configuration of apt.
  for file in /etc/apt/apt.conf.d/*; do grep -q '^ *Acquire::' "$file" && options+=("--aptopt=$file"); done
  write_sources "$1" "$2"
  for file in "$2"/sources.{list,sources}; do [[ -s $file ]] && sources+=("$file"); done
  mmdebstrap --quiet --variant=apt "${options[@]}" "$1" "$root" "${sources[@]}" &&
    mount -t proc proc "$root/proc" &&
    mount --bind /dev "$root/dev" &&
    mount --make-private "$root/dev" && # what is mounted below must not appear in this machine's /dev
    mount -t devpts devpts "$root/dev/pts" &&
    mount -t tmpfs tmpfs "$root/dev/shm"
}

# Runs a command in the root. Only a proxy is taken over from this machine's environment.
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"
}

# Undoes the mounts and removes the folder.
remove_root() { # folder
  local mounted
  for mounted in dev/shm dev/pts dev proc; do umount --lazy "$1/root/$mounted" 2>/dev/null || true; done
  rm -rf --one-file-system "$1"
}

[[ ${BASH_SOURCE[0]} == "$0" ]] || return 0

set -euo pipefail
suite=${1:?usage: clean-root.sh SUITE [-- COMMAND [ARGUMENT]...]}
shift
[[ ${1:-} == -- ]] && shift
[[ $EUID == 0 ]] || { echo "only root can make a clean root of $suite" >&2; exit 77; }
checkout=$(cd "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'remove_root "$work"' EXIT
trap 'exit 130' INT TERM HUP
make_root "$suite" "$work" || { echo "no clean root of $suite could be made: does apt-get update work on this machine?" >&2; exit 77; }

# Copies the files of a fresh clone, and files that are not committed yet.
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
grep -q '^nothing unexpected' "$work/run" || { echo "the output of ./evalcts run has no line 'nothing unexpected'" >&2; exit 1; }
in_checkout ./evalcts test
