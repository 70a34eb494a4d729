# What Understudy needs from Debian, and why. Sourced by tools/up and tools/check.
# shellcheck shell=bash disable=SC2034

build_packages=(
  "g++:compiles it"
  "cmake:configures the build"
  "ninja-build:runs the build"
  "python3:writes the manual pages"
  "libmujoco-dev:physics (MuJoCo 2.2.2)"
  "libtinyxml2-dev:reads robot models"
  "cyclonedds-dev:DDS, what the robot speaks (Cyclone DDS 0.10.2)"
  "cyclonedds-tools:idlc, which compiles the robot's message types"
  "libeigen3-dev:vectors and rotations"
  "libpng-dev:pictures as ground, ground as pictures"
  "liblz4-dev:compresses maps of what a lidar sees"
  "libzstd-dev:compresses recordings"
  "zlib1g-dev:checksums of recordings"
  "libsqlite3-dev:reads ROS 2 bags"
  "libyaml-cpp-dev:reads robot descriptions"
  "libspdlog-dev:log"
  "libfmt-dev:formats the log"
  "libcli11-dev:command line"
  "nlohmann-json3-dev:JSON of services and status"
  "libglfw3-dev:window onto a robot"
  "libegl-dev:pictures without a display"
  "libturbojpeg0-dev:pictures of a robot's cameras"
  "libx264-dev:video streams of a robot's cameras"
  "libsdl2-dev:gamepads of understudy remote"
  "libboost-dev:local HTTP of the control socket (Beast)"
  "libjs-three:3-D in the browser panel (three.js)"
  "libjs-dygraphs:plots in the browser panel"
)

unit_packages=(
  "clang:compiles the tests, in half the time of g++"
  "mold:links them"
  "libgtest-dev:unit tests"
  "libgmock-dev:unit tests"
  "ffmpeg:makes and measures films"
)

test_packages=(
  "python3-venv:a Python environment for the vendor's SDKs"
  "python3-dev:compiles the SDK's DDS binding"
  "iproute2:puts two hosts on a virtual cable"
  "iptables:a firewall for the doctor to find"
  "zsh:completions are tried in their shells"
  "fish:completions are tried in their shells"
  "mandoc:checks the manual pages"
  "xvfb:a screen without a monitor for the window"
  "xdotool:hands for the window"
  "libosmesa6:pictures are tried with it, too"
  "util-linux:private network namespaces for tests"
  "chromium:looks at the browser panel"
  "slurm-wlm:plays a campaign as an array job"
)

package_packages=(
  "dpkg-dev:finds the libraries that the package needs"
  "file:tells programs from other files"
)

installation_packages=(
  "lintian:checks the package"
  "mmdebstrap:a Debian to install it on"
  "buildah:builds an image with it, and runs that"
  "python3-yaml:reads the recipes of containers"
  "systemd:checks the units"
)

# What tests/conformance/other_dds needs (RustDDS 0.15). Debian 12's own cargo is older; cargo-web, which
# builds its browsers, is not.
least_cargo=1.88
has_cargo() {
  local version
  version=$(cargo --version 2>/dev/null) || return 1
  printf '%s\n' "$least_cargo" "$(cut -d ' ' -f 2 <<<"$version")" | sort --check --version-sort 2>/dev/null
}
has_cargo || test_packages+=("cargo-web:compiles a program on another DDS")

fuzz_packages=(
  "libclang-rt-dev:libFuzzer, and the sanitizers for Clang"
)

lint_packages=(
  "clang-format:one formatter"
  "clang-tidy:one list of checks"
  "shellcheck:checks the shell scripts"
)

# install_packages ENTRY...: installs those that are missing, after saying which and why.
install_packages() {
  local entry package missing=()
  for entry in "$@"; do
    package=${entry%%:*}
    if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed'; then
      missing+=("$package")
      printf 'missing: %-20s %s\n' "$package" "${entry#*:}"
    fi
  done
  [[ ${#missing[@]} -eq 0 ]] && return 0
  if ! command -v apt-get >/dev/null; then
    echo "This is no Debian or Ubuntu: install the above by hand and run this again." >&2
    return 1
  fi
  local root=()
  if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null || {
      echo "Run as root: apt-get install ${missing[*]}" >&2
      return 1
    }
    root=(sudo)
  fi
  echo "installing ${#missing[@]} Debian packages"
  "${root[@]}" apt-get update -q >/dev/null
  DEBIAN_FRONTEND=noninteractive "${root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}" >/dev/null
}

# build PRESET [TARGET...]: configures and builds, quietly unless it fails.
build() {
  local log=build/$1.log preset=$1
  shift
  mkdir -p build
  echo "building ($preset)"
  if ! { cmake --preset "$preset" && cmake --build --preset "$preset" --target "${@:-all}"; } >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
}
