// The table, continued: scalar fields.
#include "assets/scene_limits.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk(KeyVisitor& v, FixedValue& f) {
  v.key({"boundary", kPhysics, "", {}, "all vertices on the boundary of the mesh"}, &f.boundary);
  v.key({"box", kPhysics, "m", kPlace, "vertices inside, after the field's transform, in world coordinates"}, &f.box);
  v.key({"value", kPhysics, "", {}, "what they are held at"}, FormulaRef{&f.value});
  if (v.reading()) check(v, f);
}

void walk(KeyVisitor& v, Field& f) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, field-1, field-2, ..."}, NameRef{&f.name});
  v.key({"equation", kPhysics, "", {}, "poisson: at rest; heat: u_t = ...; wave: u_tt = ..."},
        MethodRef{&f.equation, sim::field_equations()});
  v.section({"grid", "a rectangle in the xz plane around the origin, instead of a mesh"}, keys_of(f.grid));
  walk_mesh(v, f.mesh);
  walk_transform(v, f.transform);
  v.key({"diffusivity", kPhysics, "m^2/s", above(0, 1e9), "of heat"}, &f.diffusivity);
  v.key({"speed", kPhysics, "m/s", above(0, 1e6), "of a wave"}, &f.speed);
  v.key({"mass", kPhysics, "", {}, "of heat and wave: at the vertices, or as the elements integrate it"},
        choice(f.mass));
  v.key({"source", kPhysics, "", {}, "what is fed in: the f of -Laplace u = f, u_t = ... + f, u_tt = ... + f"},
        FormulaRef{&f.source});
  v.key({"initial", kPhysics, "", {}, "the value at t = 0, of heat and wave"}, FormulaRef{&f.initial});
  v.key({"initial_rate", kPhysics, "1/s", {}, "its change per second at t = 0, of a wave"},
        FormulaRef{&f.initial_rate});
  v.list({"fixed", "vertices whose value is given; elsewhere nothing flows through the boundary"}, keys_of(f.fixed));
  v.key({"height", kPicture, "m", between(-1e6, 1e6),
         "drawn moved along the normal (y of a grid) by this times the value"},
        &f.height);
  v.key({"colormap", kPicture, "", {}, "coolwarm has its middle in white, the others go from dark to bright"},
        choice(f.colormap));
  v.key({"range",
         kPicture,
         "",
         {},
         "values of the first and last colour; left out, what the clip covers (coolwarm: alike on both sides of 0)"},
        &f.range);
  v.key({"shading", kPicture, "", kUnit,
         "0: the very colours of the bar; 1: darkened by light and shadow; left out, 0, or 0.5 with a height"},
        &f.shading);
  v.key({"colorbar", kPicture, "", {}, "whether the scale is drawn beside"}, &f.colorbar);
  v.key({"label", kPicture, "", {}, "over the colour bar: quantity and unit"}, &f.label);
  if (v.reading()) check(v, f);
}

}  // namespace softreel::assets
