#!/usr/bin/env bash
# Plans a sentence and drives its policy to `done`, one /step a move, as a robot would. Needs curl and python3.
# Usage: examples/drive.sh [SENTENCE] [ENVIRONMENT] [SERVER]
set -euo pipefail
sentence=${1:-"Put the cylinder in the box, then put the box in the bedroom"}
environment=${2:-toys-4x1-cylinder}
server=${3:-http://127.0.0.1:8000}

field() { python3 -c 'import json, sys; value = json.load(sys.stdin)
for name in sys.argv[1:]: value = value[int(name) if isinstance(value, list) else name]
print(value if isinstance(value, str) else json.dumps(value))' "$@"; }
body() { python3 -c 'import json, sys; print(json.dumps(dict(zip(sys.argv[1::2], map(json.loads, sys.argv[2::2])))))' "$@"; }
text() { python3 -c 'import json, sys; print(json.dumps(sys.argv[1]))' "$1"; }

plan=$(curl --silent --fail-with-body --json "$(body text "$(text "$sentence")" environment "$(text "$environment")")" "$server/plan")
echo "$(field ltl <<<"$plan")  probability $(field probability lower <<<"$plan"), expected steps $(field expected_steps <<<"$plan")"
url=$server$(field policy url <<<"$plan")
memory=$(field initial memory <<<"$plan")

# This world does not slip, so the robot will observe the states of the expected run.
for ((number = 0; ; number++)); do
  state=$(field trajectory "$number" state <<<"$plan")
  step=$(curl --silent --fail-with-body --json "$(body state "$state" memory "$memory")" "$url/step")
  memory=$(field memory <<<"$step")
  echo "$state  →  $(field action <<<"$step")"
  [ "$(field done <<<"$step")" = false ] || break
done
echo "done"
