#!/bin/sh
# A browser without root's privilege of opening a serial port that somebody else holds.
exec setpriv --bounding-set -sys_admin "${CHROMIUM:-/usr/bin/chromium}" "$@"
