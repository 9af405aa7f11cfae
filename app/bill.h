#pragma once
// The bill: what a scene needs, and what is left out of the run because it does not.
#include <string>
#include <vector>

#include "assets/scene.h"

namespace softreel::app {

struct BillItem {
  std::string feature;
  bool needed = false;
  std::string why;
};

/// Every feature of the program, in the order of a run.
std::vector<BillItem> bill_of(const assets::Scene& scene);

}  // namespace softreel::app
