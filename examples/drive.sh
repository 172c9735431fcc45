#!/usr/bin/env bash
# Plans the ship sentence and drives its policy to `done`, one /step a move, as a robot would. Needs curl and python3.
# Usage: examples/drive.sh [SERVER]
#
# In place of a robot's sensors this takes the states of the expected run: the world toys-4x1-cylinder has no slip, so the
# run is what happens. A real robot sends the whole state that it observes.
set -euo pipefail
server=${1:-http://127.0.0.1:8000}
sentence='{"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys-4x1-cylinder"}'

post() { curl --silent --show-error --fail-with-body --json "$2" "$server$1" || { echo "POST $1 failed" >&2; return 1; }; }
field() { # the member at a path, strings bare, anything else as JSON
  python3 -c '
import json, sys
value = json.load(sys.stdin)
for name in sys.argv[1:]:
    value = value[int(name) if isinstance(value, list) else name]
print(value if isinstance(value, str) else json.dumps(value))' "$@"
}

plan=$(post /plan "$sentence") || { echo "$plan" >&2; exit 1; }
echo "$(field ltl <<<"$plan"): probability $(field probability lower <<<"$plan"), $(field expected_steps <<<"$plan") steps"
url=$(field policy url <<<"$plan")
memory=$(field initial memory <<<"$plan")
for ((number = 0; ; number++)); do
  state=$(field trajectory "$number" state <<<"$plan")
  step=$(post "$url/step" "{\"state\": $state, \"memory\": $memory}")
  memory=$(field memory <<<"$step")
  echo "$state  →  $(field action <<<"$step")"
  if [ "$(field done <<<"$step")" = true ]; then break; fi
done
echo "done"
