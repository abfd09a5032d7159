#!/bin/bash
# SPDX-License-Identifier: MIT
# tools/install_packages asks apt only for what dpkg does not have, and says in one line what it cannot get.
# dpkg-query, apt-get, apt-cache and sudo are played by scripts that note how they were called.
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir -p "$work/clone/tools" "$work/bin" "$work/tools-only"
cp "$source/tools/install_packages" "$work/clone/tools/"
printf '%s\n' '# list' alpha 'beta # a comment' '# checks (only ./check needs these)' gamma > "$work/clone/packages.txt"

play() { printf '#!/bin/bash\n%s\n' "$2" > "$work/bin/$1"; chmod +x "$work/bin/$1"; }
play dpkg-query 'for p in "$@"; do [[ " $INSTALLED " == *" $p "* ]] && echo "$p installed"; done; exit 0'
play apt-get 'echo "apt-get $*" >> "$CALLS"; exit "${APT_FAILS:-0}"'
play apt-cache '[[ "$2" != "${UNKNOWN:-}" ]]'
play sudo 'echo "sudo" >> "$CALLS"; exec "$@"'
export CALLS=$work/calls PATH=$work/bin:$PATH

install() { : > "$CALLS"; bash "$work/clone/tools/install_packages" "$@" > "$work/out" 2> "$work/err"; }
fail() { echo "FAILED: $*"; echo "calls:"; cat "$CALLS"; echo "out:"; cat "$work/out"; echo "err:"; cat "$work/err"; exit 1; }

export INSTALLED="alpha beta"
install demo || fail "all installed"
[[ ! -s $CALLS ]] || fail "apt was called although nothing is missing"

install check || fail "gamma is missing"
grep -q 'install --no-install-recommends gamma$' "$CALLS" || fail "gamma was not installed alone"
grep -q 'update' "$CALLS" || fail "no update before the installation"

INSTALLED="beta" UNKNOWN=alpha install demo && fail "a package that cannot be had went unnoticed"
[[ $(wc -l < "$work/err") == 1 ]] && grep -q alpha "$work/err" || fail "not one line that names alpha"

INSTALLED="beta" APT_FAILS=100 install demo && fail "a failing apt-get went unnoticed"
[[ $(wc -l < "$work/err") == 1 ]] || fail "not one line about apt-get"

# An ordinary user without sudo: played with a PATH that has none.
if [[ $EUID == 0 ]] && command -v setpriv > /dev/null; then
    rm "$work/bin/sudo"
    for tool in bash dirname sed tr cat grep mkdir env; do ln -s "$(command -v "$tool")" "$work/tools-only/$tool"; done
    chmod -R a+rX "$work"
    chmod a+rwx "$work"
    INSTALLED="beta" PATH=$work/bin:$work/tools-only "$(command -v setpriv)" --reuid=65534 --clear-groups \
        "$(command -v bash)" "$work/clone/tools/install_packages" demo > "$work/out" 2> "$work/err" &&
        fail "missing sudo went unnoticed"
    [[ $(wc -l < "$work/err") == 1 ]] && grep -q 'alpha' "$work/err" && grep -q sudo "$work/err" || fail "not one line about sudo"
fi
echo "all well"
