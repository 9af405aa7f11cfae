// JUnit XML as Jenkins and GitLab read it: testsuites > testsuite > testcase > failure.
#include <fmt/format.h>

#include "app/compare_outputs.h"
#include "app/markup.h"

namespace softreel::app {

std::string compare_junit(const Comparison& c) {
  const ClipResult& clip = c.clip;
  int skipped = 0;
  std::string cases;
  for (const FrameResult& f : clip.frames) {
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escaped(c.actual), escaped(f.name));
    if (f.state == FrameState::kSkipped) {
      ++skipped;
      cases += "><skipped/></testcase>\n";
    } else if (f.good) {
      cases += "/>\n";
    } else {
      cases += fmt::format("><failure message=\"{}\">{}</failure></testcase>\n",
                           escaped(f.state == FrameState::kCompared ? f.judgement.limit : describe(f)),
                           escaped(describe(f)));
    }
  }
  int failures = clip.bad;
  const std::size_t tests = clip.frames.size() + (clip.flicker_too_much ? 1 : 0);
  if (clip.flicker_too_much) {
    ++failures;
    cases += fmt::format(
        "    <testcase classname=\"{}\" name=\"flicker\"><failure message=\"more than {:.3g} levels\"/></testcase>\n",
        escaped(c.actual), clip.flicker_limit);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{0}\" failures=\"{1}\">\n"
      "  <testsuite name=\"softreel compare\" tests=\"{0}\" failures=\"{1}\" skipped=\"{2}\" errors=\"0\">\n{3}"
      "    <system-out>{4}</system-out>\n  </testsuite>\n</testsuites>\n",
      tests, failures, skipped, cases, escaped(closing_lines(c)));
}

}  // namespace softreel::app
