#!/usr/bin/env bash
# Page tests in real Chromium. Those with real Web Serial need the emulated encoder's pty at
# the path of a serial port that Chromium lists: it is bound over /dev/ttyS0 in a private mount
# namespace, so that nothing outside changes.
# PAGE_CONFIG names another set of them.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PAGE_CONFIG=${PAGE_CONFIG:-tests/page/playwright.config.js}

why=
[ -e /dev/ttyS0 ] || why="there is no /dev/ttyS0 to bind a pty over"
if [ "$(id -u)" = 0 ]; then enter=(unshare --mount); else enter=(unshare --mount --map-root-user); fi
[ -n "$why" ] || "${enter[@]}" true 2>/dev/null || why="mount namespaces are not allowed here"
[ -n "$why" ] || [ -d /etc/chromium ] || why="there is no /etc/chromium to put a policy in"

if [ -n "$why" ]; then
  echo "Not run: the page tests with a serial port, because $why."
  [ "${CI:-}" != true ] || exit 1
  exec npx playwright test --config "$PAGE_CONFIG" --grep-invert @serial "$@"
fi

exec "${enter[@]}" bash -c '
  set -e
  # A fresh directory over the real one: this browser alone may open the port unasked.
  mount -t tmpfs tmpfs /etc/chromium
  mkdir -p /etc/chromium/policies/managed
  echo "{\"SerialAllowAllPortsForUrls\": [\"http://localhost:8089\", \"file:///\"]}" >/etc/chromium/policies/managed/encoderscope.json
  exec npx playwright test --config "$PAGE_CONFIG" "$@"
' page-tests "$@"
