#pragma once
// Every method that a scene can choose, with where it comes from (softreel check --list).
#include <span>
#include <string>

#include "sim/catalogue.h"

namespace softreel::app {

struct MethodGroup {
  const char* key;    ///< of the scene file
  const char* title;  ///< "integrators"
  sim::Catalogue methods;
};

std::span<const MethodGroup> method_groups();

/// A paragraph per group, a line or two per method: name, order, cost class, source, and what it is good for.
std::string method_list_text();

}  // namespace softreel::app
