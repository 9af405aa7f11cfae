#pragma once
// Foreign code that can crash, hang or ask for all memory (assimp on broken files, TetGen on broken surfaces) runs in
// this same program, started again as a worker. A program that imports or tetrahedralizes begins its main with
//
//   if (softreel::assets::is_worker(argc, argv)) return softreel::assets::worker_main(argc, argv);

namespace softreel::assets {

/// Whether this process was started as a worker: its first argument says so.
bool is_worker(int argc, char** argv);

/// Does the worker's one task and returns its exit code. Standard input and output belong to the parent; nothing is
/// printed.
int worker_main(int argc, char** argv);

}  // namespace softreel::assets
