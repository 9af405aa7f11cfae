// The table: every key of a scene file. To add one, add a line here (and a rule in scene_rules.cpp, if it depends on
// another key). Bodies and colliders are in scene_keys_bodies.cpp, fields in scene_keys_fields.cpp, what acts on bodies
// in scene_keys_forces.cpp, contact in scene_keys_contact.cpp, camera, light and picture in scene_keys_picture.cpp.
#include "assets/scene_limits.h"
#include "assets/scene_rules.h"
#include "assets/scene_walk.h"

namespace softreel::assets {

using enum Role;

void walk(KeyVisitor& v, Time& t) {
  v.key({"fps", kPhysics, "1/s", kFps, "frames per second of the clip"}, &t.fps);
  v.key({"duration", kNeither, "s", kDuration, "length of the clip; frame 1 shows t = 0"}, &t.duration);
  v.key({"substeps", kPhysics, "", kSubsteps, "simulation steps per frame; with accuracy the least number of them"},
        &t.substeps);
  v.key({"accuracy",
         kPhysics,
         "",
         {},
         "takes the steps that this error in time needs (largest RMS over the vertices of any frame; promised where "
         "nothing collides); px as the camera sees the middle of the scene, of its start if the camera is placed by "
         "itself; % of the scene's diagonal, or of a field's range"},
        &t.accuracy);
  v.key({"integrator", kPhysics, "", {}, "method of time integration"}, MethodRef{&t.integrator, sim::integrators()});
  v.key({"max_halvings", kPhysics, "", between(0, 30), "how often a step that fails is retried with half its size"},
        &t.max_halvings);
  if (v.reading() && t.accuracy && !v.given("substeps")) t.substeps = 1;
  if (v.reading()) check(v, t);
}

void walk(KeyVisitor& v, Solver& s) {
  v.key({"method", kPhysics, "", {}, "minimizer of an implicit step"}, MethodRef{&s.method, sim::minimizers()});
  v.key({"hessian", kPhysics, "", {}, "how newton makes its matrix positive definite"},
        MethodRef{&s.hessian, sim::hessian_modifications()});
  v.key({"line_search", kPhysics, "", {}, "how far newton and gradient-descent go along a direction"},
        MethodRef{&s.line_search, sim::line_searches()});
  v.key({"stop", kPhysics, "", {}, "what has to be small, relative to what it was, for the minimizer to stop"},
        MethodRef{&s.stop, sim::stopping_tests()});
  v.key({"linear", kPhysics, "", {}, "linear solver; auto chooses by size and stiffness"},
        MethodRef{&s.linear, sim::linear_solvers()});
  v.key({"tolerance", kPhysics, "", kTolerance, "of a step, relative to the motion it has to produce"}, &s.tolerance);
  v.key({"preconditioner", kPhysics, "", {}, "of cg, gmres and steepest-descent; none: the plain method"},
        MethodRef{&s.preconditioner, sim::preconditioners()});
  v.key({"omega", kPhysics, "", kRelaxation, "relaxation of sor; 1 is gauss-seidel"}, &s.omega);
  v.key({"restart", kPhysics, "", between(1, 10000), "vectors that gmres keeps before it begins anew"}, &s.restart);
  v.key({"linear_tolerance", kPhysics, "", kTolerance,
         "finest relative residual of one iterative solve; it stops earlier where a Newton iteration is worth less"},
        &s.linear_tolerance);
  v.key({"linear_max_iterations", kPhysics, "", between(0, 1000000000),
         "after which it gives up; 0: 10000, with cg 10 for every unknown"},
        &s.linear_max_iterations);
  v.key({"max_iterations", kPhysics, "", between(1, 100000), "of the minimizer, per step"}, &s.max_iterations);
  if (v.reading()) check(v, s);
}

void walk(KeyVisitor& v, Damping& d) {
  v.key({"drag", kPhysics, "1/s", at_least(0, 1e9), "force against the velocity relative to the wind, per mass"},
        &d.drag);
  v.key({"alpha", kPhysics, "1/s", at_least(0, 1e9), "Rayleigh damping by the mass"}, &d.alpha);
  v.key({"beta", kPhysics, "s", at_least(0, 1e6), "Rayleigh damping by the stiffness"}, &d.beta);
}

void walk_scene(KeyVisitor& v, Scene& s) {
  v.key({"title", kNeither, "", {}, "of the clip"}, &s.title);
  v.key({"gravity", kPhysics, "m/s^2", between(-1e5, 1e5), "acceleration of everything that is free"}, &s.gravity);
  v.section({"time", "length of the clip and steps in time"}, keys_of(s.time));
  v.section({"solver", "how an implicit step is solved"}, keys_of(s.solver));
  v.list({"soft", "a soft body of tetrahedra"}, keys_of(s.soft));
  v.list({"cloth", "a sheet of triangles"}, keys_of(s.cloth));
  v.list({"springs", "points with masses, and springs between them"}, keys_of(s.springs));
  v.list({"field", "a scalar field on a surface"}, keys_of(s.fields));
  v.list({"collider", "what bodies bump into"}, keys_of(s.colliders));
  v.list({"load", "forces on a part of a body that keep their size and direction"}, keys_of(s.loads));
  v.list({"attach", "ties between vertices of a body and the surface of another"}, keys_of(s.attachments));
  v.section({"wind", "moving air; presses on cloths and soft bodies"}, keys_of(s.wind));
  v.section({"contact", "between bodies, and with colliders"}, keys_of(s.contact));
  v.section({"damping", "of all bodies"}, keys_of(s.damping));
  v.section({"reference", "the motion in closed form, against which softreel study measures errors"},
            keys_of(s.reference));
  v.section({"camera", "where the clip is seen from"}, keys_of(s.camera));
  v.list({"light", "left out, there is one area light; light = [] means none"}, keys_of(s.lights));
  v.section({"render", "size and quality of the pictures"}, keys_of(s.render));
  if (v.reading()) check(v, s);
}

}  // namespace softreel::assets
