#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "assets/worker.h"

// The workers of the library are this program started again.
int main(int argc, char** argv) {
  if (softreel::assets::is_worker(argc, argv)) return softreel::assets::worker_main(argc, argv);
  return doctest::Context(argc, argv).run();
}
