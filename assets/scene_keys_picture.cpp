// The table, continued: camera, lights, what is around, and the picture itself.
#include "assets/scene_limits.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk(KeyVisitor& v, DataView& d) {
  v.key({"show",
         kPicture,
         "",
         {},
         "speed [m/s]; strain: largest principal stretch less 1; stress: von Mises [Pa]; pressure: of contact [Pa]"},
        choice(d.show));
  v.key({"colormap", kPicture, "", {}, "coolwarm has its middle in white, the others go from dark to bright"},
        choice(d.colormap));
  v.key({"range", kPicture, "", {}, "values of the first and last colour; left out, what the clip covers"}, &d.range);
  v.key({"shading", kPicture, "", kUnit, "0: the very colours of the bar; 1: darkened by light and shadow"},
        &d.shading);
  v.key({"colorbar", kPicture, "", {}, "whether the scale is drawn beside"}, &d.colorbar);
  v.key({"label", kPicture, "", {}, "over the colour bar; left out, quantity and unit"}, &d.label);
  if (v.reading()) check(v, d);
}

void walk(KeyVisitor& v, CameraKey& k) {
  v.key({"t", kPicture, "s", at_least(0, 1e6), "time, later than that of the key frame before"}, &k.t);
  v.key({"position", kPicture, "m", kPlace, "left out, that of the camera"}, &k.position);
  v.key({"target", kPicture, "m", kPlace, "left out, that of the camera"}, &k.target);
  v.key({"fov", kPicture, "deg", between(1, 150), "left out, that of the camera"}, &k.fov);
}

void walk(KeyVisitor& v, Camera& c) {
  v.key({"position", kPicture, "m", kPlace, "left out, the whole clip is framed"}, &c.position);
  v.key({"target", kPicture, "m", kPlace, "what it looks at; left out, the middle of what is to be seen"}, &c.target);
  v.key({"view", kPicture, "", {}, "standard direction, when position is left out; front looks along -z"},
        choice(c.view));
  v.key({"direction", kPicture, "", {}, "from the target to the camera, when position is left out"}, &c.direction);
  v.key({"up", kPicture, "", {}, "direction that is up in the picture"}, &c.up);
  v.key({"projection", kPicture, "", {}, "orthographic: nothing gets smaller with distance"}, choice(c.projection));
  v.key({"fov", kPicture, "deg", between(1, 150), "vertical angle of view"}, &c.fov);
  v.key({"height", kPicture, "m", kLength, "that an orthographic picture covers; left out, the clip is framed"},
        &c.height);
  v.key({"aperture", kPicture, "m", at_least(0, 1e3), "diameter of the lens: depth of field; 0: everything is sharp"},
        &c.aperture);
  v.key({"focus", kPicture, "m", kLength, "distance at which things are sharp; left out, that of the target"},
        &c.focus);
  v.list({"keys", "key frames of the camera, with a smooth way between them"}, keys_of(c.keys));
  v.key({"orbit", kPicture, "deg/s", kTurns, "round the target, counter-clockwise seen from above"}, &c.orbit);
  v.key({"follow", kPicture, "", {}, "name of a body that the camera goes along with"}, NameRef{&c.follow});
  if (v.reading()) check(v, c);
}

void walk(KeyVisitor& v, Light& l) {
  v.key({"kind", kPicture, "", {}, "area: a glowing disc; rectangle: shines to one side; sun: parallel light"},
        choice(l.kind));
  v.key({"position", kPicture, "m", kPlace, "of area and rectangle; left out, in direction, at a fitting distance"},
        &l.position);
  v.key({"direction", kPicture, "", {}, "from the scene to the light"}, &l.direction);
  v.key({"radius", kPicture, "m", at_least(0, 1e6), "of an area light; larger is softer"}, &l.radius);
  v.key({"size", kPicture, "m", at_least(0, 1e6), "of a rectangle: width and height; it faces the middle of the scene"},
        &l.size);
  v.key({"angle", kPicture, "deg", between(0, 90), "at which a sun is seen; larger is softer"}, &l.angle);
  v.key({"color", kPicture, "", kUnit, "of the light"}, &l.color);
  v.key({"intensity", kPicture, "", at_least(0, 1e6), "1: a white surface facing it comes out nearly white"},
        &l.intensity);
  v.key({"shadow", kPicture, "", {}, "whether it throws shadows"}, &l.shadow);
  if (v.reading()) check(v, l);
}

void walk(KeyVisitor& v, Background& b) {
  v.key({"top", kPicture, "", kUnit, "colour at the top of the picture"}, &b.top);
  v.key({"bottom", kPicture, "", kUnit, "colour at the bottom"}, &b.bottom);
  v.key({"sky", kPicture, "", {}, "the picture sky_map in place of colours"}, &b.sky);
  v.key({"transparent", kPicture, "", {}, "none: frames have an alpha channel (straight) to be laid over others"},
        &b.transparent);
  if (v.reading()) check(v, b);
}

void walk(KeyVisitor& v, Ground& g) {
  v.key({"show", kPicture, "", {}, "auto: unless a plane collider is visible; shadow: only the shadows on it"},
        choice(g.show));
  v.key({"height", kPicture, "m", kPlace, "left out, under the lowest point of the clip"}, &g.height);
  v.key({"color", kPicture, "", kUnit, "of the ground"}, &g.color);
  v.key({"roughness", kPicture, "", kUnit, "0 mirror to 1 matt"}, &g.roughness);
  v.key({"pattern", kPicture, "", {}, "fields of two colours, to see motion and size by"}, choice(g.pattern));
  v.key({"pattern_color", kPicture, "", kUnit, "of every other field"}, &g.pattern_color);
  v.key({"pattern_size", kPicture, "m", kLength, "of a field; left out, about a tenth of the scene"}, &g.pattern_size);
}

void walk(KeyVisitor& v, Render& r) {
  v.key({"size", kPicture, "pixels", kPixels, "width and height"}, &r.size);
  v.key({"quality", kPicture, "", {}, "presets: draft 4 samples and no sky_shadow, default 16, final auto"},
        choice(r.quality));
  if (v.reading()) apply_quality(r);
  v.key({"samples", kPicture, "", kSamples, "passes averaged into one frame; auto: as many as tolerance needs"},
        AutoRef{&r.samples});
  v.key({"tolerance", kPicture, "levels", above(0, 255),
         "RMS error of a frame, as estimated from its halves, at which samples = \"auto\" stops; 255 levels are white"},
        &r.tolerance);
  v.key({"seed", kPicture, "", between(0, 2147483647), "of the sample positions"}, &r.seed);
  v.key({"animate_seed", kPicture, "", {}, "other sample positions in each frame: grain that moves, instead of none"},
        &r.animate_seed);
  v.key(
      {"shutter", kPicture, "", kUnit,
       "motion blur: part of the time between frames for which light falls in, until the frame's own time; 0.5: film"},
      &r.shutter);
  v.section({"background", "a colour, or one for the top and one for the bottom", {"top", "bottom"}},
            keys_of(r.background));
  v.section({"ground", "the plane that things stand on; drawn only, colliders stop bodies", {"show"}},
            keys_of(r.ground));
  v.key({"exposure", kPicture, "stops", between(-20, 20), "brightness of the whole picture"}, &r.exposure);
  v.key({"sky", kPicture, "", at_least(0, 1e3), "brightness of the sky's light"}, &r.sky);
  v.key({"sky_map",
         kPicture,
         "",
         {},
         "picture of all directions (equirectangular .hdr) that lights the scene; pixels that are no finite numbers "
         "count as black, brighter ones than 1e6 as that"},
        FileRef{&r.sky_map});
  v.key({"sky_turn", kPicture, "deg", kAngle, "turns sky_map about the vertical"}, &r.sky_turn);
  v.key({"depth", kPicture, "", {}, "also writes depth_0001.png, ...: 16-bit, millimetres along the view"}, &r.depth);
  v.key({"normal", kPicture, "", {}, "also writes normal_0001.png, ...: 16-bit, world normals from -1..1"}, &r.normal);
  v.key({"id", kPicture, "", {}, "also writes id_0001.png, ...: 16-bit, 0 nothing, 1 the ground, bodies from 2"},
        &r.id);
  v.key({"sky_shadow", kPicture, "", {}, "bodies keep the sky's light from one another and from the ground"},
        &r.sky_shadow);
  if (v.reading()) check(v, r);
}

}  // namespace softreel::assets
