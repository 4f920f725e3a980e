#!/bin/sh
# Opens the window of `npr view` on a display of its own, uses mouse and keys as a user does, and lays pictures of it
# side by side into OUT. Not part of `cargo xtask ci`: it needs Xvfb, xdotool and ImageMagick.
#
#   cargo build -p npr-cli --features view
#   tests/window.sh target/debug/npr MODEL OUT.png
set -eu
npr=$(realpath "$1")
model=$(realpath "$2")
out=$(realpath -m "$3")
display=:93
folder=$(mktemp -d)
cd "$folder"
cp "$model" "scene.${model##*.}"

# Start a display, and the window in it.
Xvfb $display -screen 0 1280x800x24 >/dev/null 2>&1 &
screen=$!
sleep 1
export DISPLAY=$display
unset WAYLAND_DISPLAY
"$npr" view "scene.${model##*.}" --style ink >view.log 2>&1 &
view=$!
trap 'kill $view $screen 2>/dev/null || true; rm -rf "$folder"' EXIT
sleep 8
xdotool search --name 'npr scene' windowfocus || true
shot() { import -window root "$1.png"; }
at() { xdotool mousemove "$1" "$2"; sleep 0.1; }
shot 1

# Turn the figure: a draft while the button is down, the full picture afterwards.
at 400 400
xdotool mousedown 1
for _ in 1 2 3 4 5 6 7 8 9 10; do xdotool mousemove_relative 12 3; sleep 0.08; done
shot 2
xdotool mouseup 1
sleep 1

# Search a key, and drag its slider.
at 1100 69; xdotool click 1; sleep 0.3
xdotool type 'line opacity'; sleep 1
shot 3

# Look from the front in parallel view, and come nearer.
at 400 400; xdotool click 1; sleep 0.3
xdotool key 1; sleep 0.3; xdotool key 5; sleep 1
at 400 415; for _ in 1 2 3 4 5 6 7 8; do xdotool click 4; sleep 0.1; done; sleep 1.5
shot 4

# Unfold a group, and change a colour by its text.
at 1100 69; xdotool click 1; xdotool key ctrl+a BackSpace; sleep 0.5
at 968 242; xdotool click 1; sleep 1
at 1185 288; xdotool click 1; sleep 1; xdotool key ctrl+a; sleep 0.3; xdotool type --delay 60 '#c02818'; xdotool key Return; sleep 1.5
shot 5

# Undo it, save the style and copy the command.
at 400 400; xdotool click 1; sleep 0.2
xdotool key ctrl+z; sleep 1; xdotool key ctrl+y; sleep 1; xdotool key ctrl+s; sleep 1
shot 6
cat view.log scene.toml

# Click the outline where a row of the picture meets it first, and see why it is there.
outline=$(convert 6.png -crop 900x1+20+250 +repage -colorspace gray txt:- |
  awk -F'[,:() ]+' 'NR > 1 && $3 + 0 < 150 * ($3 > 255 ? 257 : 1) { print $1 + 21; exit }')
at "${outline:-400}" 250; xdotool click 1; sleep 2
shot 7

# Drag a stop of a ramp.
xdotool key Escape; sleep 0.3
at 1100 69; xdotool click 1; xdotool key ctrl+a; xdotool type 'shade.ramp'; sleep 1
at 1072 188; xdotool mousedown 1
for _ in 1 2 3 4 5 6; do xdotool mousemove_relative 8 0; sleep 0.1; done
xdotool mouseup 1; sleep 1.5
shot 8

# Place guide points on the model.
at 1098 95; xdotool click 1; sleep 0.5
for place in '420 300' '470 420' '520 330'; do
  at ${place% *} ${place#* }; xdotool click 1; sleep 1.5
done
shot 9
kill -0 $view

# Lay them side by side.
montage 1.png 2.png 3.png 4.png 5.png 6.png 7.png 8.png 9.png -tile 3x3 -geometry 640x400+2+2 -depth 8 +dither -colors 48 PNG8:sheet.png
cp sheet.png "$out"
