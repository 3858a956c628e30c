#!/usr/bin/env bash
# update_pictures.sh: draws the pictures of RViz in doc/images anew, without a screen: the kitchen (rviz_kitchen.png), a front
# that is tried out in the panel (rviz_panel.png), and a door that opens and is learned (rviz_door.gif). Needs a build, and the
# packages xvfb, libgl1-mesa-dri, imagemagick and xdotool. Takes a minute; look at the pictures before you commit them.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
images=$root/doc/images
view=890x750+460+62     # [px] the scene in RViz' window, as rviz/cabinet.rviz sets it
export PATH=/usr/bin:$PATH LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=xcb
for program in Xvfb import convert xdotool; do
  command -v $program >/dev/null || { echo "$program is missing: apt-get install xvfb libgl1-mesa-dri imagemagick xdotool" >&2; exit 1; }
done
set +eu
. "$root/devel/setup.sh"
set -eu
. "$here/own_master.sh"

work=$(mktemp -d)
# RViz remembers windows in the home folder.
export HOME=$work ROS_LOG_DIR=$work
mkfifo "$work/display"
Xvfb -displayfd 3 -screen 0 1380x860x24 -nolisten tcp 3>"$work/display" 2>/dev/null &
server=$!
read -r number <"$work/display"
export DISPLAY=:$number
clean_up() {
  stop_launch
  kill "$server" 2>/dev/null || true
  rm -rf "$work"
}

start() {
  launch_with_own_master "$work/$1.log" demo.launch scene:="$1" rviz:=true
  trap clean_up EXIT
}

wait_for() {
  timeout 90 rostopic echo -n 1 --filter "$1" /cabinet/models >/dev/null || { echo "the scene was not learned" >&2; exit 1; }
}

# RViz' window as doc/images/rviz_NAME.png.
take() {
  import -window root "$work/$1.png"
  convert "$work/$1.png" -resize 1000x -dither None -colors 64 -depth 8 "$images/rviz_$1.png"
}

start kitchen
wait_for "len([j for j in m.models if j.moved and j.type in (1, 2)]) > 1 and any(j.type == 2 and j.q > 0.6 for j in m.models)"
sleep 1 # until RViz has drawn it
take kitchen
# The second row, "Handle path", and the slider to its middle, where rviz/cabinet.rviz has them.
xdotool mousemove 83 648 click 1 sleep 1.5 mousemove 334 727 click 1 sleep 1.5 mousemove 44 727 mousedown 1
for x in 60 90 120 150 180; do xdotool mousemove $x 727 sleep 0.2; done
xdotool mouseup 1 sleep 3
take panel
stop_launch

# The door opens as soon as RViz listens.
start door
until rostopic info /cabinet/models 2>/dev/null | grep -q '\* /rviz'; do sleep 0.2; done
sleep 1 # until its window is there
# PNG24: a frame without colours, saved as grey, would make all of them grey.
for frame in $(seq -w 13); do
  import -window root -crop $view +repage -resize 420x PNG24:"$work/door_$frame.png"
  sleep 0.4
done
# One palette for all frames: that of the first, before anything is learned, would be grey.
convert "$work"/door_*.png -append -dither None -colors 64 -unique-colors "$work/palette.png"
convert -delay 50 -loop 0 "$work"/door_*.png -dither None -remap "$work/palette.png" -layers Optimize "$images/rviz_door.gif"
ls -l "$images"/rviz_{kitchen,panel}.png "$images"/rviz_door.gif
