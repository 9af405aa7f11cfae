#pragma once
// Rules that tie keys together. Each reports what breaks it through `v.problem`, with a path from the keys just walked.
#include <initializer_list>

#include "assets/scene_table.h"

namespace softreel::assets {

/// A key that the choice made elsewhere leaves without a meaning.
void only_for(KeyVisitor& v, bool applies, std::initializer_list<const char*> keys, const char* rule);
void nonzero(KeyVisitor& v, const char* key, const Vec3& direction);

/// Sets what the preset stands for.
void apply_quality(Render& render);

/// Finds the bodies that loads and attachments speak of, too.
void check(KeyVisitor& v, Scene& scene);
void check_references(KeyVisitor& v, Scene& scene);
/// Bodies that say nothing of contact with themselves follow [contact].
void fill_self_contact(KeyVisitor& v, Scene& scene);
/// What camera and pictures say of bodies.
void check_pictures(KeyVisitor& v, const Scene& scene);
void check(KeyVisitor& v, const Time& time);
void check(KeyVisitor& v, const Solver& solver);
void check(KeyVisitor& v, const Block& block);
void check(KeyVisitor& v, const Grid& grid);
void check(KeyVisitor& v, const Pin& pin);
void check(KeyVisitor& v, const std::vector<MotionKey>& motion);
void check(KeyVisitor& v, const SoftBody& body);
void check(KeyVisitor& v, const Cloth& cloth);
void check(KeyVisitor& v, const Chain& chain);
void check(KeyVisitor& v, const SpringBody& body);
void check(KeyVisitor& v, const FixedValue& fixed);
void check(KeyVisitor& v, const Field& field);
void check(KeyVisitor& v, Collider& collider);
void check(KeyVisitor& v, const Load& load);
void check(KeyVisitor& v, const Reference& reference);
void check(KeyVisitor& v, const Attach& attach);
void check(KeyVisitor& v, const ContactPair& pair);
void check(KeyVisitor& v, Camera& camera);
void check(KeyVisitor& v, const DataView& data);
void check(KeyVisitor& v, const Light& light);
void check(KeyVisitor& v, const Background& background);
void check(KeyVisitor& v, const Render& render);

}  // namespace softreel::assets
