#pragma once
// Keys of each part of a scene; together they are the table.
#include "assets/scene_table.h"

namespace softreel::assets {

void walk(KeyVisitor& v, Time& time);
void walk(KeyVisitor& v, Solver& solver);
void walk(KeyVisitor& v, MotionKey& key);
void walk(KeyVisitor& v, Pin& pin);
void walk(KeyVisitor& v, Look& look);
void walk(KeyVisitor& v, Block& block);
void walk(KeyVisitor& v, Grid& grid);
void walk(KeyVisitor& v, Tetrahedralize& options);
void walk(KeyVisitor& v, SolidMaterial& material);
void walk(KeyVisitor& v, ClothMaterial& material);
void walk(KeyVisitor& v, Springs& springs);
void walk(KeyVisitor& v, SoftBody& body);
void walk(KeyVisitor& v, Cloth& cloth);
void walk(KeyVisitor& v, Chain& chain);
void walk(KeyVisitor& v, SpringBody& body);
void walk(KeyVisitor& v, FixedValue& fixed);
void walk(KeyVisitor& v, Field& field);
void walk(KeyVisitor& v, Collider& collider);
void walk(KeyVisitor& v, Load& load);
void walk(KeyVisitor& v, Attach& attach);
void walk(KeyVisitor& v, Gusts& gusts);
void walk(KeyVisitor& v, Wind& wind);
void walk(KeyVisitor& v, BodyContact& contact);
void walk(KeyVisitor& v, ContactPair& pair);
void walk(KeyVisitor& v, Contact& contact);
void walk(KeyVisitor& v, Damping& damping);
void walk(KeyVisitor& v, Reference& reference);
void walk(KeyVisitor& v, DataView& data);
void walk(KeyVisitor& v, CameraKey& key);
void walk(KeyVisitor& v, Camera& camera);
void walk(KeyVisitor& v, Light& light);
void walk(KeyVisitor& v, Background& background);
void walk(KeyVisitor& v, Ground& ground);
void walk(KeyVisitor& v, Render& render);

// Keys that stand beside others in the same table.
void walk_mesh(KeyVisitor& v, MeshSource& mesh);
void walk_transform(KeyVisitor& v, Transform& transform);

}  // namespace softreel::assets
