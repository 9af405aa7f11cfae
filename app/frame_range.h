#pragma once
// Frames by number, as the command line names them.
#include <string>
#include <vector>

namespace softreel::app {

/// "1-48", "1,5,10-20x2" (every second from 10 to 20), "40-" (to the end); empty: all. Sorted, each once, within
/// [1, last]. Throws UserError (kUsage) naming the part that does not fit.
std::vector<int> parse_frames(const std::string& text, int last);

/// "frame_0001.png"
std::string frame_file_name(int frame, const char* extension = "png");

}  // namespace softreel::app
