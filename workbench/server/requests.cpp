#include "workbench/server/requests.hpp"

#include <algorithm>

#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {
namespace {

std::optional<Quantity> quantity_named(const std::string& name) {
  for (const Quantity quantity : all_quantities)
    if (to_string(quantity) == name) return quantity;
  return std::nullopt;
}

}  // namespace

std::string file_of(const Fields& fields) {
  constexpr std::size_t longest = 1000;
  std::string name = fields.text("file", "model.yaml");
  if (name.size() > longest) throw Refusal(400, "'file' is to be a name of 1000 bytes at most");
  return name;
}

Model model_of(const Fields& fields) {
  std::vector<Model::Value> efforts;
  for (const std::string& word : fields.words("preload")) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) throw Refusal(400, "'preload' is to be a list of words such as B2=-20");
    efforts.emplace_back("preload_" + word.substr(0, equals), word.substr(equals + 1));
  }
  return Model::parse(fields.text("text"), file_of(fields), efforts);
}

DyadSides sides_of(const Fields& fields) {
  DyadSides sides;
  for (const double side : fields.numbers("mode")) {
    if (side != 1 && side != -1) throw Refusal(400, "'mode' is to be a list of 1 and -1");
    sides.push_back(static_cast<int>(side));
  }
  return sides;
}

LociRequest loci_request(const Fields& fields, const Model& model) {
  LociRequest request;
  request.joints = fields.words("joints");
  if (fields.has("quantities")) {
    request.quantities.clear();
    for (const std::string& word : fields.words("quantities")) {
      const std::optional<Quantity> quantity = quantity_named(word);
      if (!quantity) throw Refusal(400, "'quantities' is to be a list of quantities such as f, M, F, N, T");
      request.quantities.push_back(*quantity);
    }
    if (request.quantities.empty()) throw Refusal(400, "'quantities' is to be a list of at least one quantity");
  }
  request.min_force = fields.positive("min_force");
  request.min_couple = fields.positive("min_couple");
  if (const DyadSides sides = sides_of(fields); !sides.empty()) request.working_modes = {sides};
  request.all_working_modes = fields.flag("all_modes");
  // Of the box's longest side: what is too small to see in a picture is fine enough.
  constexpr double finest = 1e-7, coarsest = 1e-1, usual = 5e-5;
  const double part = fields.number("tolerance", usual, finest, coarsest);
  double extent = 0;
  for (const Model::Coordinate& coordinate : model.coordinates())
    if (!coordinate.angle) extent = std::max(extent, coordinate.upper - coordinate.lower);
  request.tolerance = part * (extent > 0 ? extent : 1);
  request.mesh_size = fields.number("mesh_size", request.mesh_size, 1.0 / 128, 1.0 / 4);
  return request;
}

}  // namespace clearloci::workbench
