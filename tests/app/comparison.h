#pragma once
// Small pictures and clips to be compared.
#include <filesystem>
#include <string>
#include <vector>

#include "render/image.h"
#include "tests/app/program.h"

namespace softreel::test {

/// Two slopes of colour.
render::Image gradient(int width = 60, int height = 50);

/// The gradient with `levels` more of green on the first `pixels` pixels.
render::Image changed(int levels, int pixels);

/// A white disc that moves through the picture: frame `time` of a clip.
render::Image moving_disc(int time);

/// `softreel compare A B MORE...`
RunResult compare(const std::filesystem::path& a, const std::filesystem::path& b, std::vector<std::string> more = {});

}  // namespace softreel::test
