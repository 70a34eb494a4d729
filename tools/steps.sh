# A line for each step of a check: its name, and how long all of it still takes. Sourced by tools/check.
# shellcheck shell=bash

# plan MODE "SECONDS NAME"...: the steps to come. A step takes as long as the last time here, which build/check/MODE
# remembers, or else SECONDS, as on two cores of a laptop.
plan() {
  local entry name
  plan_names=() plan_log=build/check/$1 plan_done=0 plan_begin=$SECONDS
  declare -gA plan_usual=() plan_took=() beside_pid=()
  mkdir -p "$plan_log"
  for entry in "${@:2}"; do
    name=${entry#* }
    plan_names+=("$name")
    plan_usual[$name]=${entry%% *}
    [[ ! -e $plan_log/$name.seconds ]] || plan_usual[$name]=$(<"$plan_log/$name.seconds")
  done
  set -m # each step is a process group, so that all of it can be ended
  trap 'interrupted INT' INT
  trap 'interrupted TERM' TERM
}

# How long what is left takes, if it goes as what is done went.
time_left() {
  local i left=0 usual=0 took=0 name
  for i in "${!plan_names[@]}"; do
    name=${plan_names[i]}
    if [[ i -lt plan_done ]]; then
      usual=$((usual + plan_usual[$name]))
      took=$((took + plan_took[$name]))
    else
      left=$((left + plan_usual[$name]))
    fi
  done
  # A short beginning says nothing of what comes, such as a build with little to do.
  if [[ usual -ge 60 && took -ge 60 ]]; then left=$((left * took / usual)); fi
  if [[ left -lt 45 ]]; then echo "less than a minute left"; else echo "about $(((left + 30) / 60)) min left"; fi
}

# announce NAME: the line of the step, which has to be the next of the plan.
announce() {
  [[ $1 == "${plan_names[plan_done]}" ]] || { echo "step '$1' is not the next of the plan" >&2; exit 1; }
  printf '[%d/%d] %s … %s\n' $((plan_done + 1)) ${#plan_names[@]} "$1" "$(time_left)"
  step_begin=$SECONDS
}

finished() { # NAME
  plan_took[$1]=$((SECONDS - step_begin))
  echo "${plan_took[$1]}" >"$plan_log/$1.seconds"
  plan_done=$((plan_done + 1))
}

# step NAME COMMAND...: runs it quietly; if it fails, prints what it said and exits with its code.
step() {
  announce "$1"
  beside "$@"
  wait_for "$1"
  finished "$1"
}

# visible_step NAME COMMAND...: one that may ask for a password.
visible_step() {
  announce "$1"
  "${@:2}"
  finished "$1"
}

# beside NAME COMMAND...: begins it, quietly, beside the steps to come, until `joined_step NAME`.
beside() {
  ("${@:2}") >"$plan_log/$1.log" 2>&1 </dev/null &
  beside_pid[$1]=$!
}

# alone COMMAND...: runs it, in a step, while those beside that step wait. Compilers that ninja has begun end first.
alone() {
  local pid code=0
  for pid in "${beside_pid[@]}"; do kill -STOP -- "-$pid" 2>/dev/null || true; done
  "$@" || code=$?
  for pid in "${beside_pid[@]}"; do kill -CONT -- "-$pid" 2>/dev/null || true; done
  return "$code"
}

# Lines that begin with "said: " are shown of a step that passes, too.
joined_step() {
  announce "$1"
  wait_for "$1"
  finished "$1"
}

wait_for() {
  local code=0 pid=${beside_pid[$1]}
  wait "$pid" || code=$?
  unset "beside_pid[$1]"
  if [[ $code -eq 0 ]]; then
    grep '^said: ' "$plan_log/$1.log" || true
    return 0
  fi
  grep -v ' Passed  ' "$plan_log/$1.log" >&2
  echo "failed: $1 (code $code); all that it said is in $plan_log/$1.log" >&2
  end_all
  exit "$code"
}

all_passed() {
  local took=$((SECONDS - plan_begin))
  echo "all checks passed in $((took / 60)) min $((took % 60)) s"
}

# Ends the steps that run, with what they have started: politely, and after a minute in any case.
end_all() {
  local pid tries
  for pid in "${beside_pid[@]}"; do
    kill -INT -- "-$pid" 2>/dev/null || true
    kill -CONT -- "-$pid" 2>/dev/null || true # it may wait for one that runs alone
  done
  for pid in "${beside_pid[@]}"; do
    for ((tries = 0; tries < 600; tries++)); do
      kill -0 -- "-$pid" 2>/dev/null || break
      sleep 0.1
    done
    kill -KILL -- "-$pid" 2>/dev/null || true
    wait "$pid" 2>/dev/null || true
  done
  beside_pid=()
}

interrupted() { # SIGNAL
  trap '' INT TERM
  end_all
  echo "stopped in step $((plan_done + 1)) of ${#plan_names[@]}: ${plan_names[plan_done]}. What is built stays." >&2
  exit "$((128 + $([[ $1 == INT ]] && echo 2 || echo 15)))"
}
