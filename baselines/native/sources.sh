#!/bin/sh
# Build libccd, Bullet and FCL for x86-64-v3 from the sources of the distribution's packages, for
# the plugins *_v3 of the native lane. Some ten minutes; what is built already is not built again.
#   sources.sh [FOLDER]: sources and objects go there, libraries into FOLDER/v3 [build/native]
# apt finds the sources by deb-src entries made of the machine's own; nothing of it is installed.
set -eu
cd "$(dirname "$0")/../.."
mkdir -p "${1:-build/native}"
to=$(cd "${1:-build/native}" && pwd)
jobs=${JOBS:-2}
command -v dpkg-source >/dev/null || {
  echo "sources.sh needs dpkg-source of a Debian: apt-get install dpkg-dev" >&2
  exit 1
}
fetched="$to/sources"
if [ ! -e "$fetched/.ready" ]; then
  parts="$fetched/apt/parts"
  mkdir -p "$parts" "$fetched/apt/state/lists/partial" "$fetched/apt/cache/archives/partial"
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/debian.list; do
    [ ! -e "$list" ] || sed -n 's/^deb /deb-src /p' "$list" >>"$parts/old.list"
  done
  for list in /etc/apt/sources.list.d/debian.sources; do
    [ ! -e "$list" ] || sed 's/^Types: deb$/Types: deb-src/' "$list" >"$parts/debian.sources"
  done
  cd "$fetched"
  set -- -qq -o Dir::State="$PWD/apt/state" -o Dir::Cache="$PWD/apt/cache" \
    -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$PWD/apt/parts"
  apt-get "$@" update
  apt-get "$@" source fcl libccd bullet >/dev/null
  touch .ready
  cd - >/dev/null
fi
folder() { find "$fetched" -mindepth 1 -maxdepth 1 -type d -name "$1-[0-9]*" | head -1; }
# A project of the 2010s names an older CMake than there is.
common="-DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=$to/v3 -DCMAKE_INSTALL_LIBDIR=lib
  -DCMAKE_PREFIX_PATH=$to/v3 -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF
  -DCMAKE_POLICY_VERSION_MINIMUM=3.5 -DBUILD_TESTING=OFF"
flags="-O3 -DNDEBUG -march=x86-64-v3"
build() {  # NAME OPTION...
  name=$1
  shift
  log="$to/v3-$name.log"
  { cmake -S "$(folder "$name")" -B "$to/v3-$name" $common "$@" -DCMAKE_C_FLAGS="$flags" \
    -DCMAKE_CXX_FLAGS="$flags" && cmake --build "$to/v3-$name" --target install -j "$jobs"
  } >"$log" 2>&1 || {
    echo "$name does not build; see $log" >&2
    exit 1
  }
  echo "$name stands in $to/v3"
}
build libccd -DENABLE_DOUBLE_PRECISION=ON
build bullet -DUSE_DOUBLE_PRECISION=ON -DINSTALL_LIBS=ON -DBUILD_EXTRAS=OFF -DBUILD_BULLET3=OFF \
  -DBUILD_BULLET2_DEMOS=OFF -DBUILD_CPU_DEMOS=OFF -DBUILD_OPENGL3_DEMOS=OFF -DBUILD_UNIT_TESTS=OFF \
  -DBUILD_PYBULLET=OFF -DBUILD_CLSOCKET=OFF -DBUILD_ENET=OFF
build fcl -DFCL_STATIC_LIBRARY=ON -DFCL_WITH_OCTOMAP=OFF -DFCL_USE_X64_SSE=OFF
