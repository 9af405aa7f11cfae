#pragma once
// By what the frames of a clip are judged: one rule for all, and other ones for some. From the command line and a TOML
// file.
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "app/arguments.h"
#include "render/compare_images.h"
#include "render/tolerance.h"

namespace softreel::app {

struct FrameRule {
  render::Tolerance tolerance;
  std::vector<render::PixelRectangle> rectangles;  ///< do not count
  std::vector<int> ids;                            ///< nor do bodies with these
  bool skip = false;                               ///< the frame is not judged at all
  std::string why;                                 ///< as the file says, for the reader
};

/// "driver", "perceptual,flip=0.05", "levels=5,pixels=1%": a rung, and limits other than its own; the keys are pixels,
/// levels, cluster (of driver), flip, visible (of perceptual, which they choose). `base`: what it changes. Throws
/// UserError (kUsage) with `where` in front, naming the part that does not fit.
render::Tolerance parse_tolerance(const std::string& text, const render::Tolerance& base, const std::string& where);

class CompareRules {
 public:
  /// Reads the file of rules, if there is one. Throws UserError (kUsage, kInput).
  explicit CompareRules(const CompareArguments& arguments);

  /// Once the frames are known, so that "10-" ends somewhere: `last` is the largest number of a frame.
  void resolve(int last);
  /// `number`: of the frame, -1 if its name has none.
  FrameRule rule_for(const std::string& name, int number) const;

  const std::string& ids() const { return ids_; }          ///< picture or folder; empty: none
  double flicker_limit() const { return flicker_limit_; }  ///< [levels]
  double pixels_per_degree() const { return pixels_per_degree_; }

 private:
  struct Exception {
    std::string frames, where;  ///< numbers as in --frames, or the name of a file
    std::vector<int> numbers;
    std::string tolerance;
    FrameRule rule;  ///< its masks are added to those of all
  };
  void read_file(const std::string& file);

  FrameRule all_;
  std::vector<Exception> exceptions_;
  std::string ids_;
  double flicker_limit_ = std::numeric_limits<double>::infinity();
  double pixels_per_degree_ = render::FlipView{}.pixels_per_degree;
};

}  // namespace softreel::app
