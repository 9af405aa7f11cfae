// The table, continued: camera, lights, what is around, and the picture itself.
#include "assets/scene_limits.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk(KeyVisitor& v, Camera& c) {
  v.key({"position", kPicture, "m", kPlace, "left out, the whole clip is framed"}, &c.position);
  v.key({"target", kPicture, "m", kPlace, "what it looks at; left out, the middle of what is to be seen"}, &c.target);
  v.key({"direction", kPicture, "", {}, "from the target to the camera, when position is left out"}, &c.direction);
  v.key({"up", kPicture, "", {}, "direction that is up in the picture"}, &c.up);
  v.key({"projection", kPicture, "", {}, "orthographic: nothing gets smaller with distance"}, choice(c.projection));
  v.key({"fov", kPicture, "deg", between(1, 150), "vertical angle of view"}, &c.fov);
  v.key({"height", kPicture, "m", kLength, "that an orthographic picture covers; left out, the clip is framed"},
        &c.height);
  v.key({"aperture", kPicture, "m", at_least(0, 1e3), "diameter of the lens: depth of field; 0: everything is sharp"},
        &c.aperture);
  v.key({"focus", kPicture, "m", kLength, "distance at which things are sharp; left out, that of the target"}, &c.focus);
  if (v.reading()) check(v, c);
}

void walk(KeyVisitor& v, Light& l) {
  v.key({"kind", kPicture, "", {}, "area: a glowing disc; rectangle: shines to one side; sun: parallel light"}, choice(l.kind));
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
}

void walk(KeyVisitor& v, Ground& g) {
  v.key({"show", kPicture, "", {}, "auto: unless a plane collider is visible"}, choice(g.show));
  v.key({"height", kPicture, "m", kPlace, "left out, under the lowest point of the clip"}, &g.height);
  v.key({"color", kPicture, "", kUnit, "of the ground"}, &g.color);
  v.key({"roughness", kPicture, "", kUnit, "0 mirror to 1 matt"}, &g.roughness);
}

void walk(KeyVisitor& v, Render& r) {
  v.key({"size", kPicture, "pixels", kPixels, "width and height"}, &r.size);
  v.key({"quality", kPicture, "", {}, "presets of samples: draft 4, default 16, final auto"}, choice(r.quality));
  if (v.reading()) apply_quality(r);
  v.key({"samples", kPicture, "", kSamples, "passes averaged into one frame; auto: as many as tolerance needs"},
        AutoRef{&r.samples});
  v.key({"tolerance", kPicture, "levels", above(0, 255),
         "RMS error of a frame, as estimated from its halves, at which samples = \"auto\" stops; 255 levels are white"},
        &r.tolerance);
  v.key({"seed", kPicture, "", between(0, 2147483647), "of the sample positions"}, &r.seed);
  v.key({"animate_seed", kPicture, "", {}, "other sample positions in each frame: grain that moves, instead of none"},
        &r.animate_seed);
  v.key({"shutter", kPicture, "", kUnit,
         "motion blur: part of the time between frames for which light falls in, until the frame's own time; 0.5: film"},
        &r.shutter);
  v.section({"background", "a colour, or one for the top and one for the bottom", {"top", "bottom"}},
            keys_of(r.background));
  v.section({"ground", "the plane that things stand on; drawn only, colliders stop bodies", {"show"}},
            keys_of(r.ground));
  v.key({"exposure", kPicture, "stops", between(-20, 20), "brightness of the whole picture"}, &r.exposure);
  v.key({"sky", kPicture, "", at_least(0, 1e3), "brightness of the sky's even light"}, &r.sky);
  if (v.reading()) check(v, r);
}

}  // namespace softreel::assets
