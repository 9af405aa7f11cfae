// The table, continued: contact.
#include "assets/scene_limits.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk(KeyVisitor& v, BodyContact& c) {
  v.key({"self", kPhysics, "", {}, "whether it touches itself; left out, as contact.self"}, &c.self);
  v.key({"others", kPhysics, "", {}, "whether it touches other bodies and mesh colliders"}, &c.others);
  v.key({"friction", kPhysics, "", at_least(0, 100), "Coulomb's coefficient; left out, contact.friction"}, &c.friction);
  v.key({"thickness", kPhysics, "m", at_least(0, 1e3), "its surface keeps half of this on either side"}, &c.thickness);
}

void walk(KeyVisitor& v, ContactPair& p) {
  v.key({"between", kPhysics, "", {}, "two soft bodies, cloths or mesh colliders; one twice: with itself"}, &p.between);
  v.key({"touch", kPhysics, "", {}, "false: they pass through each other"}, &p.touch);
  v.key({"friction", kPhysics, "", at_least(0, 100), "Coulomb's coefficient; left out, the geometric mean of the two"},
        &p.friction);
  v.key({"thickness", kPhysics, "m", at_least(0, 1e3), "their distance when they touch; left out, half of each"},
        &p.thickness);
  if (v.reading()) check(v, p);
}

void walk(KeyVisitor& v, Contact& c) {
  v.key({"self", kPhysics, "", {}, "whether soft bodies and cloths touch themselves"}, &c.self);
  v.key({"friction", kPhysics, "", at_least(0, 100), "Coulomb's coefficient between the surfaces of bodies"},
        &c.friction);
  v.key({"resolve_overlap",
         kPhysics,
         "",
         {},
         "bodies that overlap in the first frame are moved apart; otherwise they are refused"},
        &c.resolve_overlap);
  v.list({"pair", "what is different between two surfaces"}, keys_of(c.pairs));
  v.key({"distance", kPhysics, "m", kLength, "at which the penalty begins"}, &c.distance);
  v.key({"slip_speed", kPhysics, "m/s", above(0, 1e3), "below which friction holds"}, &c.slip_speed);
  v.key({"sleep_speed", kPhysics, "m/s", at_least(0, 1e3),
         "bodies that stay slower for 0.5 s, with all that they touch, are left out until something touches them; left "
         "out, slip_speed/2; 0: never"},
        &c.sleep_speed);
  v.key({"stiffness", kPhysics, "N/m^2", kStiffness,
         "of the penalty; left out, 100 mass / (step^2 distance) of each vertex"},
        &c.stiffness);
}

}  // namespace softreel::assets
