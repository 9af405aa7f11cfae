// The table, continued: what acts on bodies, and between them.
#include "assets/scene_limits.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk(KeyVisitor& v, Load& l) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, load-1, load-2, ..."}, NameRef{&l.name});
  v.key({"body", kPhysics, "", {}, "on which it acts"}, &l.body);
  v.key({"box", kPhysics, "m", kPlace, "what lies inside, after the body's transform, in world coordinates"}, &l.box);
  v.key({"force", kPhysics, "N", between(-1e12, 1e12), "in all, shared out over the vertices inside by their mass"},
        &l.force);
  v.key(
      {"traction", kPhysics, "Pa", between(-1e12, 1e12), "per rest area of the surface triangles that are all inside"},
      &l.traction);
  v.key({"from", kPhysics, "s", at_least(0, 1e6), "time at which it begins"}, &l.from);
  v.key({"until", kPhysics, "s", at_least(0, 1e6), "time at which it ends; left out, never"}, &l.until);
  v.key({"ramp", kPhysics, "s", at_least(0, 1e6), "time in which it rises, in a straight line"}, &l.ramp);
  if (v.reading()) check(v, l);
}

void walk(KeyVisitor& v, Reference& r) {
  v.key({"body", kNeither, "", {}, "whose motion is known"}, &r.body);
  v.key({"x", kNeither, "m", {}, "displacement along x; x, y, z in it are the position at rest"}, FormulaRef{&r.x});
  v.key({"y", kNeither, "m", {}, "displacement along y"}, FormulaRef{&r.y});
  v.key({"z", kNeither, "m", {}, "displacement along z"}, FormulaRef{&r.z});
  if (v.reading()) check(v, r);
}

void walk(KeyVisitor& v, Attach& a) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, attach-1, attach-2, ..."}, NameRef{&a.name});
  v.key({"bodies", kPhysics, "", {}, "vertices of the first are bound to the surface of the second"}, &a.bodies);
  v.key({"box", kPhysics, "m", kPlace, "vertices of the first inside, after its transform, in world coordinates"},
        &a.box);
  v.key({"near", kPhysics, "m", kLength, "vertices of the first that are nearer than this to the second"}, &a.near);
  v.key(
      {"stiffness", kPhysics, "N/m", kStiffness, "of each tie; left out, ten times that of the softer body around it"},
      &a.stiffness);
  v.key({"damping", kPhysics, "N s/m", at_least(0, 1e9), "of each tie"}, &a.damping);
  v.key({"snap", kPhysics, "", {}, "draw the two together; otherwise a gap between them stays"}, &a.snap);
  if (v.reading()) check(v, a);
}

void walk(KeyVisitor& v, Gusts& g) {
  v.key({"amplitude", kPhysics, "", between(0, 10), "largest deviation along and across, relative to the speed"},
        &g.amplitude);
  v.key({"period", kPhysics, "s", above(0, 1e6), "of the slowest gusts; the fastest take a quarter of it"}, &g.period);
  v.key({"seed", kPhysics, "", between(0, 2147483647), "another one, other gusts"}, &g.seed);
}

void walk(KeyVisitor& v, Wind& w) {
  v.key({"velocity", kPhysics, "m/s", between(-1e3, 1e3), "of the air; zero is still air, which resists"}, &w.velocity);
  v.key({"density", kPhysics, "kg/m^3", at_least(0, 1e5), "of the air"}, &w.density);
  v.key({"drag", kPhysics, "", at_least(0, 1e3), "coefficient of the pressure across a surface"}, &w.drag);
  v.key({"friction", kPhysics, "", at_least(0, 1e3), "coefficient of the shear along a surface"}, &w.friction);
  v.section({"gusts", "changes of the wind, carried along with it"}, keys_of(w.gusts));
}

}  // namespace softreel::assets
