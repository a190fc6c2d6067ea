# Of ninja's output, with NINJA_STATUS='[%f/%t] ': how far the build is and how long it will take, and all that is no progress. Silent
# when nothing is built: catkin looks at each message's dependencies in every build.
#   tty   not empty: one line that is written over; else a line at every 5 %

function minutes(seconds) { return seconds < 90 ? sprintf("%d s", seconds) : sprintf("%.0f min", seconds / 60) }

function show(done, total,    percent, left) {
  percent = int(100 * done / total)
  left = work > 1 ? (systime() - begin) * (total - done) / work : 0
  if (!tty && percent < next_percent) return
  next_percent = percent - percent % 5 + 5
  printf "%s   %3d %%%s%s", (tty ? "\r\033[K" : ""), percent, (left >= 10 ? ", about " minutes(left) " to go" : ""), (tty ? "" : "\n")
  fflush()
}

/^\[[0-9]+\/[0-9]+\] / {
  split(substr($1, 2), counts, /[\/\]]/)
  is_noise = $0 ~ /genmsg_check_deps|Re-checking globbed directories|Running utility command/
  if (is_noise && !work) next
  if (!work++) {
    begin = systime()
    print "\n== build"
  }
  show(counts[1], counts[2])
  next
}

/^ninja: (no work to do|Entering directory)|^-- / { next }

{
  if (tty && work) printf "\n"
  print
  fflush()
}

END { if (tty && work) printf "\n" }
