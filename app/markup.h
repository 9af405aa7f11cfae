#pragma once
// Text inside HTML and XML.
#include <string>
#include <string_view>

namespace softreel::app {

/// < > & " ' as entities; control characters that XML forbids and bytes that are no UTF-8 as U+FFFD.
std::string escaped(std::string_view text);

/// RFC 4648, section 4.
std::string base64(std::string_view bytes);

}  // namespace softreel::app
