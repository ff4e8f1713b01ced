#!/bin/sh
# The headers of xsimd in later versions of Debian, as FOLDER/trixie/xsimd and FOLDER/sid/xsimd. Nothing is installed.
set -eu
[ $# = 1 ] || { echo "usage: newer_xsimd.sh FOLDER    (another mirror: DEBIAN_MIRROR=URL)" >&2; exit 2; }
mkdir -p "$1"
cd "$1"
for suite in trixie sid; do
    [ -d $suite ] && continue
    rm -rf apt
    mkdir -p apt/lists/partial apt/cache/archives/partial
    : > apt/status
    echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
        "${DEBIAN_MIRROR:-http://deb.debian.org/debian} $suite main" > apt/sources.list
    apt() {
        apt-get -qq -o Dir::Etc::SourceList="$PWD/apt/sources.list" -o Dir::Etc::SourceParts=- -o Dir::Cache="$PWD/apt/cache" \
            -o Dir::State="$PWD/apt" -o Dir::State::status="$PWD/apt/status" -o APT::Sandbox::User=root "$@"
    }
    apt update
    apt download libxsimd-dev
    dpkg-deb -x libxsimd-dev_*.deb apt/package
    mv apt/package/usr/include $suite
    rm -rf apt libxsimd-dev_*.deb
done
