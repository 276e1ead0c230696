#include "mechanism/import/formats.hpp"

#include <charconv>
#include <cmath>

namespace clearloci::mechanism::imports {

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {"PMKS+", "", is_pmks, read_pmks},      {"Linkage", "", is_linkage, read_linkage},
      {"MJCF", "", is_mjcf, read_mjcf},       {"URDF", ".yaml", is_urdf, read_urdf},
      {"SDF", "", is_sdf, read_sdf},          {"DXF", "", is_dxf, read_dxf},
      {"pyslvs", "", is_pyslvs, read_pyslvs}, {"CUIK", "", is_cuik, read_cuik},
  };
  return all;
}

std::string_view trimmed(std::string_view text) {
  const std::string_view white = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(white);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white) - first + 1);
}

bool is_xml_of(std::string_view text, std::string_view root) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  for (int i = 0; i < 100; ++i) {
    text = trimmed(text);
    std::string_view end;
    if (text.starts_with("<?"))
      end = "?>";
    else if (text.starts_with("<!--"))
      end = "-->";
    else if (text.starts_with("<!"))
      end = ">";
    else
      break;
    const std::size_t at = text.find(end);
    if (at == std::string_view::npos) return false;
    text.remove_prefix(at + end.size());
  }
  if (!text.starts_with('<') || !text.substr(1).starts_with(root)) return false;
  const std::string_view rest = text.substr(1 + root.size());
  return !rest.empty() && std::string_view(" \t\r\n>/").find(rest.front()) != std::string_view::npos;
}

bool number_of(std::string_view text, double& value) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace clearloci::mechanism::imports
