#!/bin/sh
# Runs cqltl. Compiled code is copied to where it may be added to: numba reads no cache that it cannot write.
set -eu
if [ -d /opt/numba ] && [ ! -d "$NUMBA_CACHE_DIR" ]; then
    cp -r /opt/numba "$NUMBA_CACHE_DIR"
fi
exec cqltl "$@"
