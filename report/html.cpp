// `--export html`: the loci as one page that a browser opens from disk.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "report/svg_text.hpp"
#include "report/viewer.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

/// JSON inside a script element: "</script" and "<!--" would end or hide it.
std::string inside_script(std::string json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

std::string html_page(const LociSheet& loci) {
  const ViewerBundle bundle = viewer_bundle();
  core::ensure(!bundle.script.empty(), "this build has the viewer");
  nlohmann::ordered_json data = viewer_object(loci);
  data["rules"] = drawing_rules();
  const std::string title = escape_xml(printable(loci.map.mechanism)) + " \u2013 discontinuity loci";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n"
      "<title>{}</title>\n<style>\n{}\n</style>\n</head>\n<body>\n<main id=\"viewer\"></main>\n"
      "<noscript>The picture is drawn by a script, which this browser does not run.</noscript>\n"
      "<script type=\"application/json\" id=\"loci\">{}</script>\n<script>\n{}\n</script>\n</body>\n</html>\n",
      title, bundle.style, inside_script(data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)),
      bundle.script);
}

}  // namespace clearloci::report
