#!/usr/bin/env bash
# What a newcomer meets: a bare Debian 12 with git and nothing else, a clone of this repository, and ./run.
# usage, as root: fresh_debian.sh FOLDER [WORD...]     makes the root in FOLDER where there is none, then ./run WORD... in it
set -euo pipefail

fail() {
    echo "fresh_debian.sh: $*" >&2
    exit 2
}

(($# > 0)) || fail "a folder expected, then words for ./run (demo if none)"
((EUID == 0)) || fail "only root may make a root"
command -v debootstrap > /dev/null || fail "debootstrap is not installed"

root=$(realpath -m "$1")
shift
[[ $root != / ]] || fail "a folder of its own expected, not /"
(($# > 0)) || set -- demo
repository=$(git -C "$(dirname "$(readlink -f "$0")")" rev-parse --show-toplevel)

if [[ ! -e $root/usr/bin/git ]]; then
    debootstrap --variant=minbase --include=git,ca-certificates bookworm "$root" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}"
fi
rm -rf "$root/opt/gnomon"
git clone --quiet --no-local "$repository" "$root/opt/gnomon"

# In a mount namespace of its own, so that /proc and /sys, which PoCL reads, go when the command ends.
exec unshare --mount --fork bash -c '
    mount -t proc proc "$0/proc"
    mount --rbind /sys "$0/sys"
    exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 /opt/gnomon/run "$@"
' "$root" "$@" < /dev/null
