# Sourced by scripts: shows that a long command goes on, how long it has taken, and how far it is.
#   show_progress TEXT [FUNCTION]   begins; FUNCTION prints the state of the command
#   end_progress                    ends; call it also in the EXIT trap
# A terminal shows one line, rewritten every half second from the first second on. Elsewhere a line comes every ten seconds.

progress_pid=

# Prints one line of at most the terminal's width, over the last one.
rewrite_line() {
  local width
  width=$(tput cols 2>/dev/null || echo 80)
  printf '\r%s\033[K' "${1:0:$((width - 1))}"
}

watch_progress() {
  local text=$1 state=${2:-true} start=$SECONDS wait=10 line now
  [ ! -t 1 ] || wait=0.5
  while sleep "$wait" >/dev/null 2>&1; do # holds no pipe open when it outlives this function
    line="$text: $((SECONDS - start)) s"
    now=$($state)
    [ -z "$now" ] || line+=", $now"
    if [ -t 1 ]; then rewrite_line "$line"; else echo "$line"; fi
  done
}

show_progress() {
  end_progress
  watch_progress "$@" &
  progress_pid=$!
}

end_progress() {
  [ -n "$progress_pid" ] || return 0
  kill "$progress_pid" 2>/dev/null || true
  wait "$progress_pid" 2>/dev/null || true
  progress_pid=
  [ ! -t 1 ] || printf '\r\033[K'
}
