# shellcheck shell=bash disable=SC2154
# Installs the packages of packages.txt that are missing. The launcher sources this file and defines root, build, no_install,
# say, die, is_in, logged, show_log and configure.

packages=()
declare -A least fedora arch purposes lane # the columns by package; only optional packages have a lane
while read -r name a b c d e; do
  [[ $name && $name != \#* ]] || continue
  packages+=("$name")
  least[$name]=$a fedora[$name]=$b arch[$name]=$c purposes[$name]=$d lane[$name]=$e
done <"$root/packaging/packages.txt"
as_root=()   # the words before a command that has to run as root: sudo or nothing
updated=     # empty before `apt-get update` in this call, then "well" or, after problems, "yes"
lanes_off=() # optional packages that are not installed

packages_for() { # purpose...
  local name purpose
  for name in "${packages[@]}"; do
    for purpose; do [[ ,${purposes[$name]}, == *,$purpose,* ]] && echo "$name" && break; done
  done
}

# Prints the given packages that are not installed. A file in the build folder lists the packages of the table that are
# installed: if it changes, `configure` runs CMake again.
not_installed() { # package...
  local installed note=$build/packages-installed
  installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null |
    sed -n 's/^installed //p')
  [[ $installed == "$(cat "$note" 2>/dev/null)" ]] || echo "$installed" >"$note"
  printf '%s\n' "$@" | grep -vxF -e "$installed"
}

# Prints "NAME VERSION" for each of the given packages that the distribution offers. (apt takes a name that it does not know
# as a regular expression, in which `g++` matches every package with a g.)
offered_packages() { # package...
  LC_ALL=C apt-cache policy "$@" 2>/dev/null | awk -v names=" $* " '
    /^[^ ]/ { name = substr($1, 1, length($1) - 1) }
    /^  Candidate:/ && $2 != "(none)" && index(names, " " name " ") { print name, $2 }'
}

# Prints "N packages, X MB to download, Y MB on disk". It uses apt's records, for which it needs no root and which do not
# depend on the wording of apt's messages.
install_size() { # package...
  local plan
  mapfile -t plan < <(LC_ALL=C apt-get install --simulate --no-install-recommends "$@" 2>/dev/null |
    sed -n 's/^Inst \([^ ]*\) \(\[[^]]*\] \)\{0,1\}(\([^ ]*\) .*/\1=\3/p')
  apt-cache show "${plan[@]}" 2>/dev/null | awk -v count="${#plan[@]}" '
    /^Package:/ { again = $2 in seen; seen[$2] }  # a version that two sources offer is listed twice
    /^Size:/ && !again { download += $2 }
    /^Installed-Size:/ && !again { disk += $2 * 1024 }
    function mb(bytes) { return sprintf(bytes < 1e7 ? "%.1f MB" : "%.0f MB", bytes / 1e6) }
    END { print count, count == 1 ? "package," : "packages,", mb(download), "to download,", mb(disk), "on disk" }'
}

apt_get() { # log, argument...; the lock is closed, because services that a package starts would keep it
  logged "$1" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=120 "${@:2}" 9>&-
}

update_lists() {
  [[ $updated ]] && return 1
  updated=yes
  say "updating the package lists (apt-get update)"
  apt_get "$build/apt-update.log" -o APT::Update::Error-Mode=any update && updated=well && return
  say "apt-get update reports problems: see $build/apt-update.log"
}

stop_missing() { # "update" if apt's lists are incomplete or "", message, package...
  local apt="${as_root[*]}${as_root:+ }apt-get"
  say "$2"
  printf '  %s%s install --no-install-recommends %s\n' "${1:+$apt update && }" "$apt" "${*:3}" >&2
  exit 2
}

go_without() { # message, package...
  local name
  for name in "${@:2}"; do say "the package $name $1: without ${lane[$name]}"; done
  lanes_off+=("${@:2}")
}

# Installs the packages that the purposes need, or ends the launcher with exit code 2.
need() { # purpose...
  local name version state may_install='' old='' wanted missing=() known_absent=() to_install=() insist=() absent=() lists_lack=()
  local note=$build/packages-lacking why="packages are missing; this installs them:"
  local -A offered=()
  [[ ${EVALCTS_ASSUME_DEPENDENCIES:-} == 1 ]] && return
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then need_without_apt "$@"; return; fi
  # Packages that the distribution does not have are not searched again until its release, its sources or the table change.
  state=$(cat /etc/os-release /etc/apt/sources.list /etc/apt/sources.list.d/* "$root/packaging/packages.txt" 2>/dev/null | cksum)
  [[ -f $note && $(head -n 1 "$note") == "$state" ]] && mapfile -t known_absent < <(tail -n +2 "$note")
  mapfile -t wanted < <(packages_for "$@")
  for name in $(not_installed "${wanted[@]}"); do
    if is_in "$name" "${known_absent[@]}"; then lanes_off+=("$name"); else missing+=("$name"); fi
  done
  ((${#missing[@]})) || return 0

  if [[ $EUID != 0 ]] && command -v sudo >/dev/null; then as_root=(sudo); fi
  if [[ ! $no_install ]] && [[ $EUID == 0 || ${as_root[*]} ]]; then may_install=yes; fi
  look() { while read -r name version; do offered[$name]=$version; done < <(offered_packages "${missing[@]}"); }
  look
  if ((${#offered[@]} < ${#missing[@]})) && [[ $may_install ]]; then update_lists; look; fi
  for name in "${missing[@]}"; do
    if [[ ${offered[$name]:-} ]]; then
      to_install+=("$name")
      dpkg --compare-versions "${offered[$name]}" lt "$([[ $name == g++ ]] && echo 4:)${least[$name]/#-/0}" 2>/dev/null &&
        old+=", $name ${offered[$name]#*:} (${least[$name]} is needed)"
      # `run` and `bench` are useful without an optional package; a stage of `test` is not.
      [[ ${lane[$name]} && ,${purposes[$name]}, =~ ,(run|bench), ]] || insist+=("$name")
    elif [[ ${lane[$name]} ]]; then
      absent+=("$name")
    else
      lists_lack+=("$name")
    fi
  done
  [[ ! $old ]] || die 2 "this distribution is too old: it offers ${old#, };" \
    "Debian 12, Ubuntu 24.04 and newer have what is needed"
  if [[ ! $may_install ]]; then
    [[ $no_install ]] || why="packages are missing, and only root can install them (there is no sudo):"
    ((${#lists_lack[@]})) && stop_missing update "$why" "${missing[@]}"
    ((${#insist[@]})) && stop_missing '' "$why" "${to_install[@]}"
    go_without "is not installed" "${to_install[@]}"
    go_without "is not in this distribution" "${absent[@]}"
    return
  fi
  ((${#lists_lack[@]})) && die 2 "apt has no package ${lists_lack[*]} (no network, or a distribution without it);" \
    "see $build/apt-update.log"
  go_without "is not in this distribution" "${absent[@]}"
  # Old lists do not prove that the distribution does not have a package.
  [[ $updated == well ]] && printf '%s\n' "$state" "${lanes_off[@]}" >"$note"
  ((${#to_install[@]})) || return 0

  say "installing ${to_install[*]}"
  say "with all that they need: $(install_size "${to_install[@]}")"
  install() { apt_get "$build/apt-install.log" install --no-install-recommends "${to_install[@]}"; }
  # Lists that are days old name files which the mirrors have replaced since.
  if install || { update_lists && install; }; then not_installed >/dev/null; return; fi
  show_log "$build/apt-install.log"
  stop_missing '' "apt-get could not install what is missing (no network? no rights?); the line was:" "${to_install[@]}"
}

# For distributions without apt: returns if CMake finds everything, otherwise lists the packages and ends with exit code 2.
need_without_apt() { # purpose...
  local name other distribution='' install='' names=() rest=()
  command -v cmake >/dev/null && command -v ninja >/dev/null && configure release quietly && return
  if command -v dnf >/dev/null; then
    distribution=Fedora install='sudo dnf install'
  elif command -v pacman >/dev/null; then
    distribution=Arch install='sudo pacman -S --needed'
  fi
  for name in $(packages_for "$@"); do
    case $distribution in Fedora) other=${fedora[$name]} ;; Arch) other=${arch[$name]} ;; *) other=- ;; esac
    if [[ $other != - ]]; then names+=("$other"); else rest+=("$name${lane[$name]:+ (optional: ${lane[$name]})}"); fi
  done
  say "this is not Debian or Ubuntu (no apt-get), and CMake does not find everything that the build needs."
  if [[ $distribution ]]; then
    say "$distribution's packages, as far as their names are known (untested):"
    printf '  %s %s\n' "$install" "${names[*]}" >&2
  fi
  say "Install what these packages of Debian contain:"
  printf '  %s\n' "${rest[@]}" >&2
  [[ -f $build/release/evalcts-configure.log ]] && say "What CMake says: $build/release/evalcts-configure.log"
  exit 2
}
