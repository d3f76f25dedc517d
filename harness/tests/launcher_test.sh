#!/usr/bin/env bash
# Tests the launcher `evalcts` on a simulated machine: a PATH that contains only basic tools, and scripts that simulate
# apt, dpkg, sudo, CMake and ctest. Needs no network and changes nothing outside a temporary folder. If it runs as root, it
# switches to an ordinary user, so that the result is the same everywhere.
# usage: launcher_test.sh [LAUNCHER]
set -u
unset EVALCTS_ASSUME_DEPENDENCIES # the user may have set it
launcher=$(readlink -f -- "${1:-$(dirname -- "${BASH_SOURCE[0]}")/../../evalcts}")
parts=(evalcts CMakeLists.txt CMakePresets.json docs/help packaging) # parts of the checkout that the launcher reads
if [[ $EUID == 0 && ! ${LAUNCHER_TEST_DROPPED:-} ]]; then
  copy=$(mktemp -d)
  chmod 755 "$copy"
  (cd -- "$(dirname -- "$launcher")" && cp --parents -r -- "${parts[@]}" "$copy") && cp -- "${BASH_SOURCE[0]}" "$copy/launcher_test.sh"
  chmod -R a+rX "$copy"
  LAUNCHER_TEST_DROPPED=yes TMPDIR=/tmp setpriv --reuid=65534 --regid=65534 --clear-groups \
    bash "$copy/launcher_test.sh" "$copy/evalcts"
  status=$?
  rm -rf "$copy"
  exit $status
fi

top=$(mktemp -d) || exit 1
trap 'rm -rf "$top"' EXIT
tree="$top/a tree"          # the checkout; the space is on purpose
bin=$top/bin                # all that is on the PATH
machine=$top/machine        # state of the scripts below
required='g++ cmake ninja-build libboost-dev libgtest-dev libcli11-dev nlohmann-json3-dev libfmt-dev libvalijson-dev
  libhwy-dev libkainjow-mustache-dev libsnappy-dev libgl-dev libegl-dev'
required=${required//$'\n '/}
benchmarks='libbenchmark-dev libmpfr-dev libeigen3-dev libosd-dev'
everything="$required libosmesa6 xvfb python3 git bsdutils libmpfi-dev libosmesa6-dev apitrace gfortran nodejs libgles2 pkg-config libpng-dev clang clang-tidy-14
  clang-format-14 gcovr chromium chromium-driver python3-selenium help2man codespell doxygen parallel dpkg-dev file mmdebstrap
  libglu1-mesa-dev $benchmarks"
everything=${everything//$'\n '/}

# --- the machine -------------------------------------------------------------------------------------------

script() { # name; the text follows on standard input
  { echo '#!/usr/bin/env bash'; echo "machine='$machine'"; cat; } >"$bin/$1"
  chmod +x "$bin/$1"
}

# Sets up a machine with sudo, with up-to-date package lists, and without any installed packages: the first time piece by
# piece, and then as a copy.
fresh() {
  rm -rf "$tree" "$bin" "$machine" "$top/elsewhere"
  [[ -d $top/first ]] || set_up
  cp -a "$top/first/." "$top"
}
set_up() {
  mkdir -p "$tree" "$bin" "$machine" "$top/elsewhere"
  (cd -- "$(dirname -- "$launcher")" && cp --parents -r -- "${parts[@]}" "$tree")
  touch -d '1 minute ago' "$tree/CMakePresets.json"
  local tool
  for tool in bash env cat chmod cksum dirname find flock grep head mkdir mv nproc readlink rm rmdir sed sleep sort \
    tail tee touch tr true xargs wc; do
    ln -s "$(type -P $tool)" "$bin/$tool" || exit 1
  done
  ln -s "$(readlink -f "$(type -P awk)")" "$bin/awk"
  : >"$machine/installed"
  : >"$machine/calls"
  echo "$everything" | tr ' ' '\n' | tee "$machine/mirror" >"$machine/lists"
  script dpkg-query <<'X'
shift 3
printf '%s\n' "$@" | awk '
  FILENAME != "-" { there[$0]; next }
  $0 in there { print "installed " $0 }' "$machine/installed" -
X
  # Behaves like the real apt-cache: it knows installed packages without any lists, and reads an unknown name as a
  # regular expression.
  printf '%s\n' grep-{1..30} >"$machine/base"
  script apt-cache <<'X'
verb=$1
shift
printf '%s\n' "${@%=*}" | awk -v verb="$verb" '
  function tell(name) {
    if (verb == "policy") printf "%s:\n  Installed: (none)\n  Candidate: %s\n", name, name in versions ? versions[name] : "99"
    else printf "Package: %s\nInstalled-Size: 2000\nSize: 500000\n\n", name
  }
  FILENAME ~ /versions$/ { versions[$1] = $2; next }
  FILENAME != "-" { if (FILENAME ~ /lists$/) exact[$0]; known[++n] = $0; next }
  $0 in exact { tell($0); next }
  { for (i = 1; i <= n; ++i) if (known[i] ~ $0) tell(known[i]) }' "$machine"/{versions,base,lists} -
X
  : >"$machine/versions" # versions of the offered packages; 99 for packages that are not listed
  script dpkg <<'X'
[[ $2 != 99 && $3 == lt && $2 != "$4" && $(printf '%s\n' "$2" "$4" | sort -V | head -n 1) == "$2" ]]
X
  script apt-get <<'X'
if [[ " $* " == *" --simulate "* ]]; then
  for name; do grep -xF -e "$name" "$machine/lists" | sed 's/.*/Inst & (1.0 stable [all])/'; done
  exit
fi
echo "apt-get $* [${DEBIAN_FRONTEND:-}] as ${ROOT:-user}" >>"$machine/calls"
[[ -e /proc/self/fd/9 ]] && echo "apt-get inherits the lock" >>"$machine/calls"
case " $* " in
  *" update "*) [[ ! -e $machine/no-network ]] && cat "$machine/mirror" >"$machine/lists" ;;
  *" install "*)
    [[ -e $machine/no-network ]] && echo "E: could not resolve the mirror" && exit 100
    if [[ -e $machine/stale ]] && ! grep -q update "$machine/calls"; then echo "E: 404"; exit 100; fi
    for name; do grep -xF -e "$name" "$machine/lists" >>"$machine/installed"; done
    [[ ! -e $machine/install-seconds ]] || sleep "$(<"$machine/install-seconds")"
    ;;
esac
X
  script sudo <<'X'
ROOT=root exec "$@"
X
  script cmake <<'X'
mkdir "$machine/busy" || { echo "two at once" | tee -a "$machine/overlap"; exit 1; }
trap 'rmdir "$machine/busy"' EXIT
trap 'echo stopped >>"$machine/calls"; exit 130' INT
if [[ $1 == -S ]]; then
  echo "configure $4" >>"$machine/calls"
  echo
  [[ -e $machine/no-configure ]] && echo "CMake Error: no Boost" && exit 1
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$2" >"$2/build/$4/CMakeCache.txt"
  touch "$2/build/$4/build.ninja"
else # --build --preset NAME in the checkout
  echo "build $3" >>"$machine/calls"
  preset=$(sed -n "/buildPresets/,/]/s/.*\"name\": \"$3\", \"configurePreset\": \"\([a-z0-9-]*\)\".*/\1/p" CMakePresets.json)
  set -- --build "$PWD/build/$preset"
  [[ ! -e $machine/build-seconds ]] || sleep "$(<"$machine/build-seconds")"
  [[ -e $machine/no-build-$preset ]] && echo "x.cpp:1: error: no such thing" && exit 1
  [[ -d $2/harness/cli ]] || mkdir -p "$2/harness/cli" "$2/harness/benchmarks"
  for program in cli/evalcts=program benchmarks/evalcts-bench=benchmarks; do
    {
      echo '#!/usr/bin/env bash'
      echo "printf '<%s>' ${program#*=} \"\$@\"; echo; pwd"
      echo "flock --nonblock '$2/../.lock' true && echo lock is free"
      echo 'exit 7'
    } >"$2/harness/${program%=*}"
  done
  chmod +x "$2"/harness/*/evalcts*
fi
X
  script ninja </dev/null
  script ctest <<'X'
echo "ctest $* in ${PWD##*/}" >>"$machine/calls"
[[ -e $machine/junit ]] && cat "$machine/junit" >"build/$2.xml"
if [[ -e $machine/root-$2 ]]; then # the exit code of the clean root
  cat "$machine/root-$2" >"build/$2.status"
  [[ $(cat "$machine/root-$2") == 77 ]]
  exit $(($? * 8))
fi
[[ -e $machine/failing-$2 ]] && echo "50% tests passed, 1 tests failed out of 2" && exit 8
echo "100% tests passed, 0 tests failed out of 2"
X
  mkdir "$top/first"
  mv "$tree" "$bin" "$machine" "$top/elsewhere" "$top/first"
}

install_all() { echo "$everything" | tr ' ' '\n' >"$machine/installed"; }

# --- checks ------------------------------------------------------------------------------------------------

failures=0
check() { # arguments: the expectation in words, command...
  "${@:2}" && return
  failures=$((failures + 1))
  printf 'FAILED (%s, line %s): %s\n--- output, exit code %s\n%s\n--- calls\n%s\n' "$scenario" "${BASH_LINENO[*]}" \
    "$1" "$code" "$output" "$(cat "$machine/calls")"
}
scenario() { scenario=$1; fresh; }

# Runs the launcher with empty standard input. Sets `output` to both of its outputs and `code` to its exit code.
evalcts() {
  output=$(cd "$top/elsewhere" && PATH=$bin CI=true "$bin/env" -u DEBIAN_FRONTEND "$tree/evalcts" "$@" \
    </dev/null 2>&1)
  code=$?
}
exits() { check "exit code $1" test "$code" = "$1"; }
# Without a process for each, because there are hundreds of them.
contains() { [[ $1 == *"$2"* ]]; }
# The output has a line that the extended regular expression describes as a whole.
has_line() { [[ $'\n'$output$'\n' =~ $'\n'$1$'\n' ]]; }
says() { check "says '$1'" contains "$output" "$1"; }
says_not() { check "does not say '$1'" not contains "$output" "$1"; }
called() { check "called '$1'" contains "$(<"$machine/calls")" "$1"; }
called_not() { check "did not call '$1'" not contains "$(<"$machine/calls")" "$1"; }
not() { ! "$@"; }
count() { grep -cF -e "$1" "$machine/calls"; }
calls_are() { check "the calls are: $1" test "$(tr '\n' ';' <"$machine/calls")" = "$1"; }

scenario "help installs and writes nothing"
for arguments in '' -h --help; do
  # shellcheck disable=SC2086 # none or one
  evalcts $arguments
  exits 0
  for command in run list coverage explain reproduce report fuzz faults bench test; do
    check "help names $command" grep -qE "^  $command  " <<<"$output"
  done
done
check "nothing written" test ! -e "$tree/build"
calls_are ''

scenario "help and version of the program, without it"
evalcts --version
exits 0
check "the version" has_line "evalcts [0-9.]+"
for command in run list coverage explain reproduce report fuzz faults ulp vectors bench package test; do
  evalcts "$command" --help
  exits 0
  check "help of $command" grep -qE "^Usage: (./)?evalcts $command " <<<"$output"
done
evalcts vectors write --help
exits 0
says "Usage: evalcts vectors write "
check "nothing written" test ! -e "$tree/build"
calls_are ''

scenario "wrong use"
evalcts rum
exits 2
says "unknown command 'rum' (did you mean run?)"
evalcts test --al
exits 2
says "'--al'"
evalcts test --preset nonsense
exits 2
says "asan-ubsan"
check "nothing written" test ! -e "$tree/build"
calls_are ''

scenario "--no-install names what is missing in one line"
echo g++ >"$machine/installed"
for arguments in '--no-install run' 'run --no-install'; do
  # shellcheck disable=SC2086 # words
  evalcts $arguments
  exits 2
  check "the line" grep -qxF "  sudo apt-get install --no-install-recommends ${required#g++ } libosmesa6 xvfb" <<<"$output"
done
calls_are ''
: >"$machine/lists"
evalcts --no-install run
exits 2
says "  sudo apt-get update && sudo apt-get install --no-install-recommends cmake "
calls_are ''

scenario "--no-install with all there"
install_all
evalcts run --no-install x
exits 7
says "<program><run><x>"
called_not apt-get

scenario "--no-install goes on without an implementation, but not without a stage that was asked for"
echo "$required python3" | tr ' ' '\n' >"$machine/installed"
evalcts run --no-install
exits 7
says "libosmesa6 is not installed: without the implementation osmesa"
evalcts test --no-install --preset clang
exits 2
says "  sudo apt-get install --no-install-recommends libosmesa6 xvfb git bsdutils libmpfi-dev libosmesa6-dev apitrace gfortran nodejs libgles2 pkg-config libpng-dev clang libglu1-mesa-dev help2man"
called_not apt-get
called_not ctest

scenario "neither root nor sudo"
rm "$bin/sudo"
evalcts run
exits 2
says "only root"
check "the line" grep -qxF "  apt-get install --no-install-recommends $required libosmesa6 xvfb" <<<"$output"
calls_are ''

scenario "the first call installs, builds, hands over; the second only builds"
evalcts run --filter 'a  b' -- --no-install
exits 7
says "installing $required libosmesa6 xvfb"
says "16 packages, 8.0 MB to download, 33 MB on disk"
says "<program><run><--filter><a  b><--><--no-install>"
says "$top/elsewhere"
says "lock is free"
calls_are "apt-get -y -o DPkg::Lock::Timeout=120 install --no-install-recommends $required libosmesa6 xvfb \
[noninteractive] as root;configure release;build programs;"
: >"$machine/calls"
evalcts list tests
exits 7
check "nothing but the program's output" test "$(head -n 1 <<<"$output")" = "<program><list><tests>"
calls_are "build programs;"

scenario "the package lists are updated if they lack something"
: >"$machine/lists"
evalcts run
exits 7
check "once" test "$(count update)" = 1
scenario "and when they are stale"
touch "$machine/stale"
evalcts run
exits 7
check "once" test "$(count update)" = 1
check "second try" test "$(count " install ")" = 2

scenario "no network"
touch "$machine/no-network"
evalcts run
exits 2
says "could not resolve the mirror"
says "  sudo apt-get install --no-install-recommends $required"
called_not configure
: >"$machine/lists"
evalcts run
exits 2
says "apt has no package g++ cmake"

scenario "what the distribution lacks costs a lane, not the build, and is not looked for twice"
sed -i '/libosmesa6/d' "$machine/lists" "$machine/mirror"
evalcts run
exits 7
says "libosmesa6 is not in this distribution: without the implementation osmesa"
evalcts run
exits 7
check "once" test "$(count update)" = 1
sed -i '/clang$/d' "$machine/lists" "$machine/mirror"
evalcts test --all
check "clang is left out" has_line "clang +left out: no package clang"
check "tidy is left out" has_line "tidy +left out: no package clang"
called "ctest --preset debug"
called_not "configure clang"

scenario "no apt at all"
rm "$bin/apt-get" "$bin/dpkg-query"
touch "$machine/no-configure"
evalcts run
exits 2
says "this is not Debian or Ubuntu"
check "names them" grep -qxF "  nlohmann-json3-dev" <<<"$output"
says "libosmesa6 (optional: the implementation osmesa)"
rm "$machine/no-configure"
evalcts run
exits 7
rm -r "$tree/build"
rm "$bin/ninja"
evalcts run
exits 2

scenario "no apt, but dnf or pacman"
rm "$bin/apt-get" "$bin/dpkg-query"
touch "$machine/no-configure"
script dnf </dev/null
evalcts run
exits 2
says "Fedora's packages, as far as their names are known (untested):"
check "the line" grep -qxF "  sudo dnf install gcc-c++ cmake ninja-build boost-devel gtest-devel cli11-devel json-devel \
fmt-devel valijson-devel highway-devel snappy-devel libglvnd-devel mesa-libEGL-devel xorg-x11-server-Xvfb" <<<"$output"
check "what has no name there" grep -qxF "  libkainjow-mustache-dev" <<<"$output"
says_not nlohmann-json3-dev
rm "$bin/dnf"
script pacman </dev/null
evalcts run
exits 2
check "the line" grep -qxF "  sudo pacman -S --needed gcc cmake ninja boost gtest cli11 nlohmann-json fmt highway snappy libglvnd \
mesa xorg-server-xvfb" <<<"$output"
rm "$machine/no-configure"
evalcts run
exits 7
called_not "configure clang"

scenario "a distribution that is too old"
printf '%s\n' 'g++ 4:10.2.1-1' 'cmake 3.18.4-2+deb11u1' 'libboost-dev 1.74.0.3' >"$machine/versions"
evalcts run
exits 2
says "this distribution is too old: it offers g++ 10.2.1-1 (12 is needed), cmake 3.18.4-2+deb11u1 (3.25 is needed); Debian 12"
called_not install

scenario "a compiler that is too old"
echo "$required libosmesa6 xvfb" | tr ' ' '\n' >"$machine/installed"
touch "$machine/no-configure"
sed -i 's/CMake Error: no Boost/The compiler is too old: GCC 10/' "$bin/cmake"
mkdir -p "$tree/build/release"
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$tree" >"$tree/build/release/CMakeCache.txt"
evalcts run
exits 2
says "The compiler is too old: GCC 10"
check "the next call may choose another compiler" test ! -e "$tree/build/release/CMakeCache.txt"

scenario "a CMake that is too old"
install_all
touch "$machine/no-configure"
sed -i 's/CMake Error: no Boost/CMake 3.25 or higher is required.  You are running version 3.22/' "$bin/cmake"
evalcts run
exits 2
says "or higher is required"

scenario "EVALCTS_ASSUME_DEPENDENCIES"
EVALCTS_ASSUME_DEPENDENCIES=1 evalcts run
exits 7
called_not apt-get

scenario "a build that fails is a fault of evalcts"
install_all
touch "$machine/no-build-release"
evalcts run
exits 3
says "x.cpp:1: error"
says_not "<program>"
evalcts check EV-MAP1-COPY # `git bisect run` skips the revision
exits 125
says "x.cpp:1: error"
rm "$machine/no-build-release"
rm -r "$tree/build"
touch "$machine/no-configure"
evalcts run
exits 3
says "no Boost"
rm "$machine/no-configure"
evalcts run
exits 7

scenario "configured again when the presets change or the checkout moves"
install_all
evalcts run
evalcts run
check "once" test "$(count configure)" = 1
touch "$tree/CMakePresets.json"
evalcts run
check "presets" test "$(count configure)" = 2
mv "$tree" "$top/another tree"
tree="$top/another tree"
evalcts run
exits 7
check "moved" test "$(count configure)" = 3
tree="$top/a tree"

scenario "configured again when a package has come or gone"
echo "$required" | tr ' ' '\n' >"$machine/installed"
evalcts run --no-install
evalcts run --no-install
check "once" test "$(count configure)" = 1
echo python3 >>"$machine/installed"
evalcts run --no-install
check "come" test "$(count configure)" = 2
sed -i /python3/d "$machine/installed"
evalcts run --no-install
check "gone" test "$(count configure)" = 3
evalcts run
check "installed by the launcher" test "$(count configure)" = 4
evalcts run
check "nothing new" test "$(count configure)" = 4

scenario "through a symbolic link, by a relative path"
install_all
ln -s "../a tree/evalcts" "$top/elsewhere/link"
output=$(cd "$top/elsewhere" && PATH=$bin ./link run 2>&1 </dev/null)
code=$?
exits 7
check "built in the checkout" test -x "$tree/build/release/harness/cli/evalcts"
check "nothing beside the link" test "$(ls "$top/elsewhere")" = link

scenario "two launchers at once"
echo 2.5 >"$machine/install-seconds" # more than a launcher waits in silence
echo 0.2 >"$machine/build-seconds"
evalcts run first &
sleep 0.1
evalcts run second
exits 7
says "waiting for another"
says "<second>"
wait
check "one at a time" test ! -e "$machine/overlap"
check "installed once" test "$(count " install ")" = 1
check "configured once" test "$(count configure)" = 1
flock "$tree/build/.lock" sleep 0.2 & # another one with nothing to build
sleep 0.1
evalcts run third
exits 7
says_not "waiting for another"
wait

scenario "interrupted while it builds"
install_all
echo 20 >"$machine/build-seconds"
set -m # a process group of its own, which gets the signal as from a terminal
(cd "$top" && PATH=$bin exec "$tree/evalcts" run) >"$top/interrupted" 2>&1 </dev/null &
set +m
for ((i = 0; i < 100; ++i)); do
  grep -q '^build' "$machine/calls" && break
  sleep 0.1
done
kill -INT -- -$!
wait $!
code=$?
output=$(cat "$top/interrupted")
exits 130
says_not "<program>"
check "nobody holds the lock" flock --nonblock "$tree/build/.lock" true
rm "$machine/build-seconds"
evalcts run
exits 7

if terminal=$(type -P script); then # part of bsdutils
  scenario "on a terminal"
  touch "$machine/no-build-release"
  output=$(cd "$top" && PATH=$bin SHELL=$bin/bash "$terminal" -qec "'$tree/evalcts' run" /dev/null 2>&1 </dev/null)
  code=$?
  exits 3
  says "  x.cpp:1: error"
  says_not "evalcts: line" # bash complaining about the launcher
  rm "$machine/no-build-release"
  output=$(cd "$top" && PATH=$bin SHELL=$bin/bash "$terminal" -qec "'$tree/evalcts' run" /dev/null 2>&1 </dev/null)
  code=$?
  exits 7
  says "<program><run>"
else
  echo "not tried: on a terminal (no command script)"
fi

scenario "a checkout that cannot be written to"
install_all
chmod a-w "$tree"
evalcts run
chmod u+w "$tree"
exits 2
says "cannot write to $tree/build"

scenario "bench: installs its own packages, and builds its own program"
echo "$required libosmesa6 xvfb" | tr ' ' '\n' >"$machine/installed"
evalcts bench --benchmark_filter=Exact
exits 7
says "installing $benchmarks"
says "<benchmarks><--benchmark_filter=Exact>"
called "build bench"
scenario "bench: without a peer, but not without Google Benchmark"
echo "$required libosmesa6 xvfb libbenchmark-dev libosd-dev" | tr ' ' '\n' >"$machine/installed"
evalcts bench --no-install
exits 7
says "libeigen3-dev is not installed: without Eigen, for comparison in bench"
says_not libosd-dev
sed -i /libbenchmark-dev/d "$machine/installed"
evalcts bench --no-install
exits 2
says "libbenchmark-dev"
called_not apt-get

scenario "ulp: its program is built"
echo "$required libosmesa6 xvfb" | tr ' ' '\n' >"$machine/installed"
: >"$machine/calls"
evalcts ulp
exits 7
says "<program><ulp>"
calls_are "configure release;build programs-with-lab;"

scenario "test: stages, ctest's words, summary"
install_all
evalcts test
exits 0
calls_are "configure release;build release;ctest --preset release in a tree;\
configure asan-ubsan;build asan-evaluator;ctest --preset asan-evaluator in a tree;"
check "ctest is heard" test "$(grep -c "^100% tests passed, 0 tests failed out of 2" <<<"$output")" = 2
check "release passed" has_line "release +passed +[0-9]+ s"
check "asan-evaluator passed" has_line "asan-evaluator +passed +[0-9]+ s"

scenario "test: arguments for ctest"
install_all
evalcts test -- -R Value
exits 0
calls_are "configure release;build complete;ctest --preset complete --no-tests=ignore -R Value in a tree;"

scenario "test: installs for its stages"
evalcts test --preset debug
exits 0
called "libosmesa6 xvfb python3 git bsdutils libmpfi-dev libosmesa6-dev apitrace gfortran nodejs libgles2 pkg-config libpng-dev libglu1-mesa-dev help2man parallel ["
called "ctest --preset debug in"
called_not release

scenario "test: the lints are a stage of their own, whose packages no other stage needs"
evalcts test
exits 0
called_not codespell
called_not "ctest --preset lint"
evalcts test --preset lint
exits 0
called "install --no-install-recommends clang-format-14 codespell doxygen ["
called "build lint"
called "ctest --preset lint in"

scenario "test: the summary says why tests were skipped"
install_all
cat >"$machine/junit" <<'X'
<testsuite name="all">
	<testcase name="harness.Passes" classname="harness.Passes" time="0.1" status="run">
		<system-out>all is well
</system-out>
	</testcase>
	<testcase name="vectors.script" classname="vectors.script" time="0.1" status="notrun">
		<skipped message="SKIP_RETURN_CODE=77"/>
		<system-out>a line
&lt;Node&gt; &amp; npm are not installed
</system-out>
	</testcase>
	<testcase name="harness.Terminal.Size" classname="harness.Terminal.Size" time="0.1" status="notrun">
		<skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
		<system-out>[ RUN      ] Terminal.Size
/src/terminal_test.cpp:57: Skipped
no terminal without script(1)

[  SKIPPED ] Terminal.Size (0 ms)
</system-out>
	</testcase>
	<testcase name="silent" classname="silent" time="0.1" status="notrun">
		<skipped message="SKIP_RETURN_CODE=77"/>
		<system-out></system-out>
	</testcase>
	<testcase name="absent" classname="absent" time="0" status="notrun">
		<skipped message="Unable to find executable"/>
		<system-out>Unable to find executable: /absent</system-out>
	</testcase>
</testsuite>
X
evalcts test
exits 0
check "each stage has the skipped tests below it" test "$(sed '1,/^== summary/d' <<<"$output" | grep -A 3 ^release | tail -n 3)" = \
  "  skipped: vectors.script: <Node> & npm are not installed
  skipped: harness.Terminal.Size: no terminal without script(1)
  skipped: silent: no reason given"
check "no other test" test "$(grep -c '^  skipped: ' <<<"$output")" = 6
touch "$machine/no-build-release"
evalcts test --preset release
exits 3
says_not "skipped: " # the file is of an earlier run

scenario "test: a failure does not stop the other stages"
install_all
touch "$machine/failing-release"
evalcts test
exits 1
check "release failed" grep -qE "^release +FAILED" <<<"$output"
check "asan-evaluator passed" grep -qE "^asan-evaluator +passed" <<<"$output"
touch "$machine/no-build-release"
evalcts test
exits 3
check "release did not build" grep -qE "^release +did not build" <<<"$output"
check "asan-evaluator passed" grep -qE "^asan-evaluator +passed" <<<"$output"

scenario "test: stages that are tests in a build of another name"
install_all
evalcts test --preset stability --preset tidy --preset cxx23 --preset fuzz
exits 0
calls_are "configure release;build stability;ctest --preset stability in a tree;\
configure tidy;build tidy;ctest --preset tidy in a tree;configure cxx23;build cxx23;ctest --preset cxx23 in a tree;\
configure fuzz;build fuzz;ctest --preset fuzz in a tree;"
touch "$machine/failing-stability"
evalcts test --preset stability
exits 1

scenario "test: clean roots of Debian's releases"
install_all
evalcts test --preset debian-12 --preset debian-13 --preset debian-unstable
exits 0
for stage in debian-12 debian-13; do check "$stage passed" has_line "$stage +passed +[0-9]+ s"; done
check "unstable is reported" has_line "debian-unstable +reported: passed +[0-9]+ s"
echo 1 >"$machine/root-debian-unstable"
evalcts test --preset debian-unstable
exits 0
check "unstable is reported" has_line "debian-unstable +reported: FAILED +[0-9]+ s"
for code_of_root in 1 143; do # 143: ended by a signal
  echo $code_of_root >"$machine/root-debian-13"
  evalcts test --preset debian-13
  exits 1
  check "debian-13 failed" has_line "debian-13 +FAILED +[0-9]+ s"
done
echo 3 >"$machine/root-debian-13"
evalcts test --preset debian-13
exits 3
check "debian-13 did not build" has_line "debian-13 +did not build +[0-9]+ s"
rm "$machine/root-debian-13"
evalcts test --preset debian-13 # the note of the last time does not count
exits 0

scenario "test: no clean root can be made"
install_all
for stage in debian-12 debian-13 debian-unstable; do echo 77 >"$machine/root-$stage"; done
evalcts test --preset debian-12
exits 2
check "debian-12 is left out" grep -qE "^debian-12 +left out: no clean root could be made" <<<"$output"
evalcts test --preset debian-unstable
exits 0
evalcts test --all
exits 0
for stage in debian-12 debian-13; do check "$stage is left out" grep -qE "^$stage +left out: no clean root" <<<"$output"; done
check "unstable is left out" grep -qE "^debian-unstable +reported: left out: no clean root" <<<"$output"

((failures == 0)) && echo "all scenarios passed"
exit $((failures > 0))
