#!/bin/bash
# Opens the window of `npr view` on a display of its own, uses mouse and keys as a user does, lays pictures of every
# step side by side into OUT, and compares what the window saved with what the command draws, byte by byte.
#
#   cargo build -p npr-cli --features view
#   tests/window.sh target/debug/npr MODEL MODEL_WITH_CLIPS OUT.png [cpu|gpu]
#
# Controls are found by their names, as programs that read screens find them. Not part of `cargo xtask ci`: it needs
# Xvfb, xdotool, xclip, ImageMagick, at-spi2-core, dbus-run-session and python3-gi.
set -euo pipefail
if [ -z "${NPR_WINDOW_BUS:-}" ]; then
  NPR_WINDOW_BUS=1 exec dbus-run-session -- "$0" "$@"
fi
npr=$(realpath "$1")
model=$(realpath "$2")
animated=$(realpath "$3")
out=$(realpath -m "$4")
backend=${5:-cpu}
finder=$(realpath "$(dirname "$0")/window_place.py")
folder=$(mktemp -d)
cd "$folder"
cp "$model" "scene.${model##*.}"
cp "$animated" "film.${animated##*.}"
export DISPLAY=:93
unset WAYLAND_DISPLAY
view=
Xvfb $DISPLAY -screen 0 1280x800x24 >/dev/null 2>&1 &
screen=$!
trap 'kill $view $screen 2>/dev/null || true; rm -rf "$folder"' EXIT
trap 'echo "window.sh: line $LINENO failed" >&2; import -window root "${out%.png}.failed.png" || true' ERR
sleep 1
gdbus call --session -d org.a11y.Bus -o /org/a11y/bus -m org.freedesktop.DBus.Properties.Set \
  org.a11y.Status IsEnabled '<true>' >/dev/null

# Take a picture of the window.
shot() { import -window root "$1.png"; }
find() { /usr/bin/python3 "$finder" "$@"; }
# Put the pointer on a control.
at() { xdotool mousemove $(find "$@"); sleep 0.1; }
press() { at "$@"; xdotool click 1; sleep 0.3; }
# Drag what the pointer is on.
drag() { xdotool mousedown 1; for _ in $(seq 12); do xdotool mousemove_relative -- "$1" "$2"; sleep 0.06; done; }
search() { press Search; xdotool key ctrl+a BackSpace; xdotool type "$1"; sleep 0.6; }
# Wait for the full picture after a change: what was told of the one before stays until a draft is drawn. Two that took
# as long are told apart by nothing, so that it goes on after some seconds.
told_before=
full() {
  sleep 0.7
  for _ in $(seq 20); do
    told_now=$(find "(scene|film)\.[a-z]+   [0-9]+ × [0-9]+, [0-9.]+ s, .*" --text --wait 60)
    if [ "$told_now" != "$told_before" ]; then break; fi
    sleep 0.4
  done
  told_before=$told_now
  echo "$told_now"
}
told() { find "$1" --text --wait 60; }
open_window() {
  "$npr" view "$@" --backend "$backend" >>view.log 2>&1 &
  view=$!
  find Search --wait 60 >/dev/null
  xdotool search --sync --name 'npr (scene|film)' windowfocus
  full
}
same() { cmp "$1" "$2" || { echo "window.sh: $1 and $2 differ" >&2; exit 1; }; }

# Open the model, and choose another preset.
open_window "scene.${model##*.}"
shot 1
press Style
press ink
full
shot 2

# Drag the width of lines: a draft while the button is down, the full picture afterwards.
search line.width.base
at line.width.base
drag 4 0
shot 3
xdotool mouseup 1
full

# Drag a stop of a ramp.
search shade.ramp
at 'stop 2 of shade.ramp'
drag 3 0
xdotool mouseup 1
full
shot 4

# Turn the model and come nearer.
xdotool mousemove 400 600
drag 6 0
xdotool mouseup 1
for _ in 1 2 3; do xdotool click 4; sleep 0.1; done
full
shot 5

# Click the first line that a row of the picture meets, and see why it is there.
row=300
line=$(convert 5.png -crop "900x1+20+$row" +repage -colorspace gray -depth 8 txt:- |
  awk -F'[,:() ]+' 'NR > 1 && !found && $3 + 0 < 90 { print $1 + 21; found = 1 }')
xdotool mousemove "$line" $row click 1
told 'Why is this line here.*'
sleep 0.5
shot 6
xdotool key Escape
sleep 0.3

# Take all of it away.
xdotool key ctrl+s
told '.scene.toml. holds the style'
press PNG
told '.scene.png. is written'
press SVG
told '.scene.svg. is written'
shot 7
press 'Copy command'
copied=$(xclip -o -selection clipboard)
echo "$copied"
cat scene.toml
kill $view
wait $view 2>/dev/null || true

# The command, and the saved style in place of what it changes of the preset, draw the same bytes.
command=$(printf '%s' "$copied" | sed "s|^npr |$npr |")
eval "$command -o copied.png"
same scene.png copied.png
styled=$(printf '%s' "$command" | /usr/bin/python3 -c '
import shlex, sys
words, kept = shlex.split(sys.stdin.read()), []
while words:
    word = words.pop(0)
    if word in ("--style", "--set"):
        words.pop(0)
    else:
        kept.append(word)
print(shlex.join(kept + ["--style", "scene.toml"]))')
eval "$styled -o styled.png"
same scene.png styled.png
eval "${styled/ render / lines } -o lines.svg"
same scene.svg lines.svg

# Play a clip, and take a moment of it away.
open_window "film.${animated##*.}" --style ink
press Play
sleep 2.5
shot 8
press Pause
sleep 1.5
shot 9
press PNG
told '.film.png. is written'
press 'Copy command'
command=$(xclip -o -selection clipboard | sed "s|^npr |$npr |")
eval "$command -o moment.png"
same film.png moment.png
kill -0 $view
cat view.log

# Lay them side by side.
montage 1.png 2.png 3.png 4.png 5.png 6.png 7.png 8.png 9.png -tile 3x3 -geometry 640x400+2+2 -depth 8 +dither \
  -colors 64 PNG8:sheet.png
cp sheet.png "$out"
echo "window.sh: everything is as it should be"
