#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "check/certificate.hpp"
#include "check/pose_task.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {
namespace {

using check::CertificateFile;

void check_program(const core::StraightLine& program, std::size_t variables) {
  using Operation = core::StraightLine::Operation;
  require(!program.steps.empty(), "a program has a step");
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const core::StraightLine::Step& step = program.steps[i];
    if (step.operation == Operation::variable)
      require(step.first >= 0 && static_cast<std::size_t>(step.first) < variables, "a variable is there");
    if (step.operation == Operation::add || step.operation == Operation::subtract ||
        step.operation == Operation::multiply)
      require(step.second >= 0 && static_cast<std::size_t>(step.second) < i, "a step uses earlier ones");
  }
}

/// Numbers of modes, functions and roots name something, a tree of cells has as many leaves as its cuts make.
void check_accepted(const CertificateFile& file) {
  require(file.coordinates.size() == 2, "two coordinates");
  for (const core::StraightLine& square : file.squares) check_program(square, 2 + file.squares.size());
  for (const check::Function& function : file.functions) check_program(function.program, 2 + file.squares.size());
  const auto is_mode = [&](int mode) { return mode >= 0 && static_cast<std::size_t>(mode) < file.modes.size(); };
  const auto is_function = [&](int one) { return one >= 0 && static_cast<std::size_t>(one) < file.functions.size(); };
  for (const core::WorkingMode& mode : file.modes) require(mode.size() == file.squares.size(), "a sign for every root");
  for (const check::SheetCells& sheet : file.sheets) {
    require(is_mode(sheet.mode) && is_function(sheet.function), "a sheet is of a mode and a function");
    std::size_t cuts = 0;
    for (const core::CellNode& cell : sheet.cells)
      if (cell.kind == core::CellNode::Kind::cut) ++cuts;
    require(sheet.cells.size() == 2 * cuts + 1, "every cut makes two cells");
  }
  for (const check::OpenClaim& open : file.open)
    require(is_mode(open.mode) && is_function(open.function), "what is open is of a mode and a function");
  for (const check::CurveClaim& curve : file.curves) {
    require(is_mode(curve.mode), "a curve is of a mode");
    for (const core::Arc& arc : curve.arcs) require(arc.points.size() >= 2, "an arc has two points");
  }
  for (const check::PointClaim& point : file.points) require(is_mode(point.mode), "a point is of a mode");
  for (const check::ZoneClaim& zone : file.zones) {
    require(is_mode(zone.mode), "a zone is of a mode");
    require(std::isfinite(zone.area), "an area is finite");
  }
}

}  // namespace

void certificate_target(std::string_view bytes) {
  const std::string text(bytes);
  try {
    const auto root = value_or_complaint([&] { return check::parse_certificate(text, "c.json"); });
    if (root && root->contains("pose_task")) {
      value_or_complaint([&] { return check::read_pose_task(*root, "c.json"); });
    } else if (root) {
      const auto file = value_or_complaint([&] { return check::read_certificate(*root, "c.json"); });
      if (file) check_accepted(*file);
    }
  } catch (const check::FalseClaim& claim) {  // read, and found to claim what cannot be: the answer is no
    require(*claim.what() != '\0', "a rejection says why");
  }
}

}  // namespace clearloci::fuzz
