#!/bin/sh
# Renders the pictures of the gallery anew: sh assets/gallery/make.sh [NAME ...], from the top folder, with the built
# program. Look at them before committing. What was simulated is kept in out/gallery.
set -eu
softreel=${SOFTREEL:-build/release/softreel}
folder=$(dirname "$0")
wanted=" $* "

# picture NAME SCENE FRAME [OPTIONS]
picture() {
  name=$1 scene=$2 frame=$3
  shift 3
  case $wanted in "  " | *" $name "*) ;; *) return 0 ;; esac
  rm -f "out/gallery/$name/frame_"*.png
  "$softreel" render "assets/scenes/$scene.toml" --frames "$frame" -o "out/gallery/$name" --quiet \
    --set 'render.size=[640, 360]' "$@"
  cp "out/gallery/$name/$(printf 'frame_%04d.png' "$frame")" "$folder/$name.png"
}

picture studio studio 1 --set render.quality=final
picture hello hello 11
picture blanket blanket 42 --set render.samples=64
picture spinner spinner 8
picture strain strain 66
picture ripples ripples 70 --set render.samples=16
picture cooling_plate cooling_plate 80
picture washing-line washing-line 40 --set render.samples=64
picture overlay overlay 18 --set render.samples=64

case $wanted in "  " | *" wireframe "*)
  "$softreel" turntable assets/scenes/wireframe.toml --frame 1 --count 12 --size 640 360 -o out/gallery/wireframe --quiet
  cp out/gallery/wireframe/frame_0001.png "$folder/wireframe.png"
  ;;
esac

case $wanted in "  " | *" sheet "*)
  rm -f out/gallery/sheet/frame_*.png
  "$softreel" render assets/scenes/jelly.toml --sheet -o out/gallery/sheet --quiet --set 'render.size=[160, 90]' \
    --set 'camera.direction=[0, 0, 1]' --set camera.projection=orthographic
  cp out/gallery/sheet/sheet.png "$folder/sheet.png"
  ;;
esac
