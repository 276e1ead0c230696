// What a page in a browser needs to draw loci as the pictures do: the workbench and `--export html`. Colours, dashes
// and words are those of the pictures, as data.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "clearloci/sketch.hpp"
#include "report/formats.hpp"

namespace clearloci::report {

/// {"themes": {"light", "dark"}, "kinds": [{"kind", "words", "happens"}], "dashes", ...}: what does not depend on the
/// mechanism.
nlohmann::ordered_json drawing_rules();

/// {"loci": as loci.json, "units", "notes" and "parameters" as tables tell them, "zones" as zones.json, "curve_groups",
/// "point_groups", "surface_groups", "meshes", "sketches"}: what is drawn alike and how, by the ids of loci.json;
/// triangles as little-endian floats and indices in base64.
nlohmann::ordered_json viewer_object(const LociSheet& loci);

nlohmann::ordered_json sketch_object(const core::Sketch& sketch);

/// The viewer as a browser runs it: script and style. Empty in a build without the workbench.
struct ViewerBundle {
  std::string_view script, style;
};
ViewerBundle viewer_bundle();

/// One page that needs nothing else: no server, no request. Required: a bundle.
std::string html_page(const LociSheet& loci);

}  // namespace clearloci::report
