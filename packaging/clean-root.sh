#!/usr/bin/env bash
# Makes a clean root of a Debian release, which is the smallest system that has apt, and runs a command in it. Needs
# mmdebstrap and root; the packages come from the sources of this machine's apt.
#
#   clean-root.sh SUITE [-- COMMAND [ARGUMENT]...]
#     Copies this checkout into a clean root of SUITE (bookworm, trixie, sid) and runs COMMAND there, in the checkout.
#     Without a command it runs what a new user types: `./evalcts run` and `./evalcts test`. Both have to end with exit
#     code 0, and the run may have no new failures. The exit code is that of the command, or 77 if the root could not
#     be made (no network, no such suite, not root).
#
# Scripts that source this file get the functions bootstrap, make_root, inside and remove_root; nothing is run.

# Writes this machine's Debian sources with the name of the given suite into the folder, one file for each of apt's two
# formats. Unstable has neither updates nor a security archive. Archives of other distributions are omitted; if no source
# is left, mmdebstrap takes Debian's default mirror.
write_sources() { # suite, folder
  local names='(bullseye|bookworm|trixie|forky|sid|stable|testing|unstable)'
  sed -nE "/^deb /{s/ $names/ $1/;/ sid-/d;/ $1/p}" /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null >"$2/sources.list"
  sed -sE "/^Suites:/{s/ $names/ $1/g;s/ sid-[a-z]+//g};\$G" /etc/apt/sources.list.d/*.sources 2>/dev/null |
    awk -v RS= -v ORS='\n\n' -v suite="$1" 'index($0, "Suites: " suite)' >"$2/sources.sources"
}

# Unpacks a root of the suite in FOLDER/root.
bootstrap() { # suite, folder, option of mmdebstrap...
  local file options=() sources=()
  # The root's apt gets the options with which this machine's apt reaches its sources.
  for file in /etc/apt/apt.conf.d/*; do grep -q '^ *Acquire::' "$file" && options+=("--aptopt=$file"); done
  write_sources "$1" "$2"
  for file in "$2"/sources.{list,sources}; do [[ -s $file ]] && sources+=("$file"); done
  mmdebstrap --quiet "${@:3}" "${options[@]}" "$1" "$2/root" "${sources[@]}"
}

# Makes a clean root of the suite in FOLDER/root, with /proc, /dev, /dev/pts and /dev/shm, and sets $root to it.
make_root() { # suite, folder
  root=$2/root
  bootstrap "$1" "$2" --variant=apt &&
    mount -t proc proc "$root/proc" &&
    mount --bind /dev "$root/dev" &&
    mount --make-private "$root/dev" && # mounts below it must not appear in this machine's /dev
    mount -t devpts devpts "$root/dev/pts" &&
    mount -t tmpfs tmpfs "$root/dev/shm"
}

# Runs a command in $root. Of this machine's environment it gets only the settings of a proxy.
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"
}

# Undoes the mounts of make_root and removes its folder.
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

# Copies the files that git tracks, as they are now, and new files that git does not ignore.
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
grep -q '^No new failures' "$work/run" || { echo "the output of ./evalcts run has no line 'No new failures'" >&2; exit 1; }
in_checkout ./evalcts test
