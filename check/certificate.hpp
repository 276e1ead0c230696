// What a certificate file says (certificates.md), read with limits on everything and believed in nothing.
// Private to check/.
#pragma once

#include <array>
#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "check/task_region.hpp"
#include "core/certificate.hpp"
#include "core/task.hpp"

namespace clearloci::check {

/// The certificate can be read and says something that does not hold, or that could not be shown to hold.
class FalseClaim : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Function {
  core::FactorRole role = core::FactorRole::reaction;
  std::string name;
  core::StraightLine program;
};

/// core::SheetClaim with its function by number.
struct SheetCells {
  int mode = 0, function = 0;
  core::FactorRole role = core::FactorRole::reaction;
  std::vector<int> at_zero;
  std::array<double, 4> domain{};
  std::vector<core::CellNode> cells;
};

using Reaction = std::pair<std::string, core::Quantity>;
/// The gravest of what vanishes: what loses contact, an actuator's couple or force, a component.
core::LocusKind gravest_kind(const std::vector<Reaction>& vanishing);

struct CurveClaim {
  int mode = 0;
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<Reaction> vanishing;
  bool certified = false;
  std::vector<core::Arc> arcs;
};

struct PointClaim {
  int mode = 0;
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<Reaction> vanishing;
  bool certified = false;
  core::Point2 at{};
};

struct OpenClaim {
  int mode = 0, function = 0;
};

struct ZoneClaim {
  std::string id;
  int mode = 0;
  int assembly_mode = 0;
  std::vector<std::pair<Reaction, int>> signs;
  double area = 0;
  core::Polyline outer;
  std::vector<core::Polyline> holes;
  core::Point2 sample{};
  bool certified = false;
};

/// Over the task and its margin nothing wanted vanishes.
struct TaskClaim {
  int mode = 0;
  ClaimedShape shape;
  std::vector<std::string> unchecked;  ///< what else was asked for
};

struct CertificateFile {
  std::string command, model;
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<std::string> coordinates;
  std::array<core::Rational, 2> from;  ///< the model's coordinates are from + scale times those of the certificate
  core::Rational scale;
  std::array<core::Rational, 4> box;  ///< x0, x1, y0, y1
  double tolerance = 0;
  std::vector<std::string> joints;
  std::vector<core::Quantity> quantities;
  std::vector<std::string> root_points;
  std::vector<core::RootRole> root_roles;
  std::vector<int> limit_roots;  ///< those of limits, which have the role `length`
  std::vector<core::StraightLine> squares;
  std::vector<Function> functions;
  std::vector<core::WorkingMode> modes;
  std::vector<SheetCells> sheets;
  std::vector<OpenClaim> open;
  std::vector<CurveClaim> curves;
  std::vector<PointClaim> points;
  std::vector<ZoneClaim> zones;
  std::vector<double> in_doubt;  ///< of every mode the area of the workspace that may be in no zone
  std::optional<TaskClaim> task;
  std::vector<std::pair<int, int>> slits;  ///< SheetParts::slits; from the model, not in the file
  std::optional<std::chrono::steady_clock::time_point> deadline;  ///< of the check; not in the file
};

/// "-3/4"; none: the text is no fraction, or longer than the program writes one.
std::optional<core::Rational> fraction_of(const std::string& digits);

/// Whether a model's text is the one of a certificate, in which bytes that are no UTF-8 were replaced.
bool same_text(const std::string& model, const std::string& in_certificate);

/// `file`: its name, for errors. Throws core::InputError where the text is no certificate of this version.
nlohmann::json parse_certificate(const std::string& text, const std::string& file);

/// Of loci, zones and tasks over two lengths. Throws core::InputError where the object is none, FalseClaim where its
/// cells are no partition.
CertificateFile read_certificate(const nlohmann::json& root, const std::string& file);

}  // namespace clearloci::check
