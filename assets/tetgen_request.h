#pragma once
// What goes to the TetGen worker and what comes back. The readers throw BrokenBlob.
#include "assets/blob.h"
#include "sim/mesh.h"

namespace softreel::assets {

struct TetgenRequest {
  std::vector<sim::Vec3> vertices;
  std::vector<sim::Triangle> triangles;
  double quality = 1.4;   ///< radius-edge ratio
  double max_volume = 0;  ///< 0: none
};

struct TetgenReply {
  std::vector<sim::Vec3> vertices;  ///< those of the request first
  std::vector<sim::Tet> tets;       ///< of either orientation
  std::vector<int> regions;         ///< per tet: number of the region between the surface's components
};

std::string write_request(const TetgenRequest& request);
TetgenRequest read_request(std::string_view bytes);
std::string write_reply(const TetgenReply& reply);
TetgenReply read_reply(std::string_view bytes);

/// Whether TetGen is linked in.
bool has_tetgen_library();

}  // namespace softreel::assets
