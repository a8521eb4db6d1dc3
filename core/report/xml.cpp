// A line end in an attribute would be read as a space, so it goes by its number.
#include "core/report/xml.h"

namespace quell {

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 32 && c != '\t' ? '?' : c;
    }
  return out;
}

}  // namespace quell
