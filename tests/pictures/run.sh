#!/usr/bin/env bash
# Takes the pictures of docs/pictures anew; what is given is passed on to Playwright. With ONLY=1
# pictures that are not taken stay.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec npx playwright test --config tests/pictures/playwright.config.js "$@"
