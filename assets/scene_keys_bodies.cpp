// The table, continued: bodies and colliders.
#include "assets/scene_limits.h"
#include "assets/scene_presets.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk_transform(KeyVisitor& v, Transform& t) {
  v.key({"translate", kPhysics, "m", kPlace, "after scale and rotate"}, &t.translate);
  v.key({"rotate", kPhysics, "deg", kAngle, "about x, then y, then z, through pivot"}, &t.rotate);
  v.key({"scale", kPhysics, "", above(0, 1e6), "about pivot, one number or one per axis"}, ScaleRef{&t.scale});
  v.key({"pivot", kPhysics, "m", kPlace, "in the coordinates of the mesh"}, &t.pivot);
}

void walk_mesh(KeyVisitor& v, MeshSource& m) {
  v.key({"mesh", kPhysics, "", {}, "file: OBJ, PLY, STL, OFF, glTF, FBX, ..."}, FileRef{&m.path});
  v.key({"unit", kPhysics, "m", above(0, 1e6), "of the mesh file"}, UnitRef{&m.unit});
  v.key({"up", kPhysics, "", {}, "axis of the mesh file that points up"}, choice(m.up));
  v.key({"size", kPhysics, "m", kLength, "scales the longest side of the mesh to this"}, &m.size);
}

namespace {

void walk_motion(KeyVisitor& v, std::vector<MotionKey>& motion, const char* help) {
  v.list({"motion", help}, keys_of(motion));
  if (v.reading()) check(v, motion);
}

void walk_mass(KeyVisitor& v, Body& b) {
  v.key({"mass", kPhysics, "", {}, "matrix of the mass: one mass per vertex, or that of the finite elements"},
        choice(b.mass));
}

void walk_body(KeyVisitor& v, Body& b) {
  walk_transform(v, b.transform);
  v.key({"velocity", kPhysics, "m/s", kSpeed, "at t = 0"}, &b.velocity);
  v.key({"spin", kPhysics, "deg/s", kTurns, "at t = 0, about the world's axes through the centre of mass"}, &b.spin);
  v.list({"pins", "vertices that are held or driven"}, keys_of(b.pins));
  v.section({"look", "how it looks", {"color"}}, keys_of(b.look));
  v.key({"visible", kPicture, "", {}, "whether it is drawn"}, &b.visible);
}

}  // namespace

void walk(KeyVisitor& v, MotionKey& k) {
  v.key({"t", kPhysics, "s", at_least(0, 1e6), "time, later than that of the key frame before"}, &k.t);
  v.key({"translate", kPhysics, "m", kPlace, "from where it was put"}, &k.translate);
  v.key({"rotate", kPhysics, "deg", kAngle, "about x, then y, then z; each angle is interpolated by itself"},
        &k.rotate);
}

void walk(KeyVisitor& v, Pin& p) {
  v.key({"box", kPhysics, "m", kPlace, "vertices inside, after the body's transform, in world coordinates"}, &p.box);
  v.key({"vertices", kPhysics, "", between(0, 2147483647), "vertices by number, from 0"}, &p.vertices);
  v.key({"axes", kPhysics, "", {}, "directions in which they are held"}, AxesRef{&p.axes});
  walk_motion(v, p.motion, "key frames of driven vertices");
  v.key({"pivot", kPhysics, "m", kPlace, "what motion turns about; left out, the middle of the vertices"}, &p.pivot);
  if (v.reading()) check(v, p);
}

void walk(KeyVisitor& v, Look& l) {
  v.key({"color", kPicture, "", kUnit, "left out, colours and textures of the mesh file, or light grey"}, &l.color);
  v.key({"back_color", kPicture, "", kUnit, "of the back of a cloth; left out, as the front"}, &l.back_color);
  v.key({"roughness", kPicture, "", kUnit, "0 mirror to 1 matt"}, &l.roughness);
  v.key({"metallic", kPicture, "", kUnit, "0 for everything but metals"}, &l.metallic);
  v.key({"texture", kPicture, "", {}, "picture file, laid on by the texture coordinates of the mesh"},
        FileRef{&l.texture});
  v.key({"normal_texture", kPicture, "", {}, "picture file of normals in tangent space, green up (glTF)"},
        FileRef{&l.normal_texture});
  v.key({"roughness_texture", kPicture, "", {}, "picture file: green times roughness, blue times metallic (glTF)"},
        FileRef{&l.roughness_texture});
  v.key({"emission_texture", kPicture, "", {}, "picture file: what the surface gives off, times emission"},
        FileRef{&l.emission_texture});
  v.key({"emission", kPicture, "", kUnit, "colour that the surface gives off; it lights nothing else"}, &l.emission);
  v.key({"emission_strength", kPicture, "", at_least(0, 1e4), "times emission; 1: as bright as white in the light"},
        &l.emission_strength);
  v.key({"sheen", kPicture, "", kUnit, "soft bright rim of fibres: velvet, wool"}, &l.sheen);
  v.key(
      {"pattern", kPicture, "", {}, "drawn where the body is at rest, so that it sticks; takes the place of a texture"},
      choice(l.pattern));
  v.key({"pattern_color", kPicture, "", kUnit, "of every other field; the rest have color"}, &l.pattern_color);
  v.key({"pattern_size", kPicture, "m", kLength, "of a field"}, &l.pattern_size);
  v.key({"wire", kPicture, "", kUnit, "colour of the triangles' edges; left out, they are not drawn"}, &l.wire);
  v.key({"crease", kPicture, "deg", between(0, 180), "edges sharper than this stay hard"}, &l.crease);
}

void walk(KeyVisitor& v, Block& b) {
  v.key({"size", kPhysics, "m", kLength, "along x, y, z"}, &b.size);
  v.key({"cells", kPhysics, "", kCells, "along x, y, z"}, &b.cells);
  if (v.reading()) check(v, b);
}

void walk(KeyVisitor& v, Grid& g) {
  v.key({"size", kPhysics, "m", kLength, "along x and z"}, &g.size);
  v.key({"cells", kPhysics, "", kCells, "along x and z, two triangles each"}, &g.cells);
  if (v.reading()) check(v, g);
}

void walk(KeyVisitor& v, Tetrahedralize& t) {
  v.key({"mode", kPhysics, "", {}, "conform: tetrahedra whose boundary is the surface"}, choice(t.mode));
  v.key({"quality", kPhysics, "", between(1.05, 100, "below that TetGen does not end"),
         "largest ratio of circumradius to shortest edge"},
        &t.quality);
  v.key({"max_volume", kPhysics, "m^3", above(0, 1e12), "of one tetrahedron"}, &t.max_volume);
  v.key({"time_limit", kNeither, "s", above(0, 1e6), "after which it is given up"}, &t.time_limit);
}

void walk(KeyVisitor& v, SolidMaterial& m) {
  v.key({"preset", kNeither, "", {}, "named figures, also for density; keys beside it go first"},
        PresetRef{&m.preset, solid_preset_names()});
  if (v.reading()) apply_preset(m);
  v.key({"model", kPhysics, "", {}, "law of the material"}, MethodRef{&m.model, sim::solid_materials()});
  v.key({"young", kPhysics, "Pa", kYoung, "Young's modulus"}, &m.young);
  v.key({"poisson", kPhysics, "", kPoisson, "Poisson's ratio"}, &m.poisson);
}

void walk(KeyVisitor& v, ClothMaterial& m) {
  v.key({"preset", kNeither, "", {}, "named figures, also for density; keys beside it go first"},
        PresetRef{&m.preset, cloth_preset_names()});
  if (v.reading()) apply_preset(m);
  v.key({"model", kPhysics, "", {}, "law of a membrane's material"}, MethodRef{&m.model, sim::membrane_materials()});
  v.key({"young", kPhysics, "Pa", kYoung, "Young's modulus"}, &m.young);
  v.key({"poisson", kPhysics, "", kPoisson, "Poisson's ratio"}, &m.poisson);
  v.key({"thickness", kPhysics, "m", kLength, "of the sheet"}, &m.thickness);
  v.key({"bending", kPhysics, "N m", at_least(0, 1e12), "bending stiffness of a membrane"}, &m.bending);
}

void walk(KeyVisitor& v, Springs& s) {
  v.key({"structural", kPhysics, "N/m", at_least(0, 1e12), "along the edges; left out, from the material"},
        &s.structural);
  v.key({"shear", kPhysics, "N/m", at_least(0, 1e12), "along the diagonals; left out, half of structural"}, &s.shear);
  v.key({"bend", kPhysics, "N/m", at_least(0, 1e12), "to every second neighbour; left out, a tenth of structural"},
        &s.bend);
}

void walk(KeyVisitor& v, SoftBody& b) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, soft-1, soft-2, ..."}, NameRef{&b.name});
  walk_mesh(v, b.mesh);
  v.section({"block", "a box of tetrahedra around the origin, instead of a mesh"}, keys_of(b.block));
  v.section({"tetrahedralize", "how the inside of a surface mesh is filled"}, keys_of(b.tetrahedralize));
  v.section({"material", "a preset's name, or figures", {"preset"}}, keys_of(b.material));
  if (const SolidPreset* preset = find_solid_preset(b.material.preset); preset && v.reading())
    b.density = preset->density;
  v.key({"density", kPhysics, "kg/m^3", kDensity, "mass per volume"}, &b.density);
  walk_mass(v, b);
  walk_body(v, b);
  v.section({"data", "colours by a figure of the simulation", {"show"}}, keys_of(b.data));
  v.section({"contact", "how its surface touches itself and others"}, keys_of(b.contact));
  if (v.reading()) check(v, b);
}

void walk(KeyVisitor& v, Cloth& c) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, cloth-1, cloth-2, ..."}, NameRef{&c.name});
  v.section({"grid", "a rectangle in the xz plane around the origin, instead of a mesh"}, keys_of(c.grid));
  walk_mesh(v, c.mesh);
  v.key({"model", kPhysics, "", {}, "finite elements, or masses and springs"}, choice(c.model));
  v.section({"material", "a preset's name, or figures", {"preset"}}, keys_of(c.material));
  v.key({"bending_model",
         kPhysics,
         "",
         {},
         "of a membrane; quadratic is for sheets that are flat at rest, auto takes it there"},
        choice(c.bending_model));
  v.section({"springs", "stiffness of a mass-spring cloth"}, keys_of(c.springs));
  v.key({"spring_damping", kPhysics, "N s/m", at_least(0, 1e9), "along each spring of a mass-spring cloth"},
        &c.spring_damping);
  if (const ClothPreset* preset = find_cloth_preset(c.material.preset); preset && v.reading())
    c.density = preset->density;
  v.key({"density", kPhysics, "kg/m^3", kDensity, "mass per volume; mass per area is density x thickness"}, &c.density);
  walk_mass(v, c);
  walk_body(v, c);
  v.section({"data", "colours by a figure of the simulation", {"show"}}, keys_of(c.data));
  v.section({"contact", "how its surface touches itself and others"}, keys_of(c.contact));
  if (v.reading()) check(v, c);
}

void walk(KeyVisitor& v, Chain& c) {
  v.key({"from", kPhysics, "m", kPlace, "first point, in the body's coordinates"}, &c.from);
  v.key({"to", kPhysics, "m", kPlace, "last point"}, &c.to);
  v.key({"links", kPhysics, "", between(1, kMostPoints - 1), "edges; there is one point more"}, &c.links);
  if (v.reading()) check(v, c);
}

void walk(KeyVisitor& v, SpringBody& b) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, springs-1, springs-2, ..."}, NameRef{&b.name});
  v.key({"points", kPhysics, "m", kPlace, "where they are, in the body's coordinates"}, &b.points);
  v.key({"edges", kPhysics, "", between(0, kMostPoints), "springs between points, by number, from 0"}, &b.edges);
  v.section({"chain", "a row of points and edges, instead of points"}, keys_of(b.chain));
  v.key({"mass", kPhysics, "kg", above(0, 1e12), "of each point, or one for each"}, &b.masses);
  v.key({"stiffness", kPhysics, "N/m", above(0, 1e12), "of each edge, or one for each"}, &b.stiffness);
  v.key({"rest_length", kPhysics, "m", at_least(0, 1e6), "of each edge, or one for each; left out, as the points lie"},
        &b.rest_length);
  v.key({"damping", kPhysics, "N s/m", at_least(0, 1e9), "along each edge"}, &b.damping);
  v.key({"radius", kPicture, "m", kLength, "of each drawn ball, or one for each; left out, from the edges"}, &b.radius);
  v.key({"edge_radius", kPicture, "m", kLength, "of drawn rods; left out, a third of the smallest ball's"},
        &b.edge_radius);
  walk_body(v, b);
  if (v.reading()) check(v, b);
}

void walk(KeyVisitor& v, Collider& c) {
  v.key({"name", kNeither, "", {}, "by which it is called; left out, collider-1, collider-2, ..."}, NameRef{&c.name});
  v.key({"shape", kPhysics, "", {}, "what it is"}, choice(c.shape));
  v.key({"normal", kPhysics, "", {}, "of a plane, towards the free side"}, &c.normal);
  v.key({"radius", kPhysics, "m", kLength, "of a sphere or capsule"}, &c.radius);
  v.key({"size", kPhysics, "m", kLength, "of a box, around its origin"}, &c.size);
  v.key({"height", kPhysics, "m", kLength, "of a capsule, along y, between the centres of its round ends"}, &c.height);
  // A mesh's `size` would be that of a box: scale does.
  v.key({"mesh", kPhysics, "", {}, "of shape mesh, open or closed; file: OBJ, PLY, STL, OFF, glTF, FBX, ..."},
        FileRef{&c.mesh.path});
  v.key({"unit", kPhysics, "m", above(0, 1e6), "of the mesh file"}, UnitRef{&c.mesh.unit});
  v.key({"up", kPhysics, "", {}, "axis of the mesh file that points up"}, choice(c.mesh.up));
  v.key({"thickness", kPhysics, "m", at_least(0, 1e3), "of a mesh: half of it on either side"}, &c.thickness);
  v.key({"friction", kPhysics, "", at_least(0, 100), "Coulomb's coefficient"}, &c.friction);
  walk_transform(v, c.transform);
  walk_motion(v, c.motion, "key frames that move it");
  v.section({"look", "how it looks", {"color"}}, keys_of(c.look));
  v.key({"visible", kPicture, "", {}, "whether it is drawn"}, &c.visible);
  if (v.reading()) check(v, c);
}

}  // namespace softreel::assets
