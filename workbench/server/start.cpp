#include "workbench/server/start.hpp"

#include <nlohmann/json.hpp>

#include "report/viewer.hpp"
#include "workbench/server/assets.hpp"

namespace clearloci::workbench {
namespace {

/// Of the kinds of files, mechanisms alone have an end effector.
bool is_mechanism(std::string_view text) { return text.find("\nend_effector:") != std::string_view::npos; }

}  // namespace

Json start_of(const ServerOptions& options) {
  Json examples = Json::array(), companions = Json::array();
  for (const Asset& asset : example_assets()) {
    Json one = {{"name", asset.path}, {"text", asset.bytes}};
    if (is_mechanism(asset.bytes))
      examples.push_back(std::move(one));
    else if (!asset.path.starts_with("studies/"))
      companions.push_back(std::move(one));
  }
  Json values = Json::object();
  for (const auto& [name, value] : options.values) values[name] = value;
  return {{"file", options.file},
          {"text", options.text},
          {"values", std::move(values)},
          {"examples", std::move(examples)},
          {"companions", std::move(companions)},
          {"rules", report::drawing_rules()},
          {"time_limit", options.time_limit}};
}

}  // namespace clearloci::workbench
