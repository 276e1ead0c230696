#include "report/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/fold.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;
using core::CellNode;
using core::StraightLine;

std::string program_text(const StraightLine& line) {
  std::string text;
  for (const StraightLine::Step& step : line.steps) {
    if (!text.empty()) text += ' ';
    switch (step.operation) {
      case StraightLine::Operation::constant:
        text += 'c' + core::to_string(step.value());
        if (step.radius() != 0) text += '~' + core::to_string(step.radius());
        break;
      case StraightLine::Operation::variable:
        text += fmt::format("v{}", step.first);
        break;
      case StraightLine::Operation::add:
        text += fmt::format("+{},{}", step.first, step.second);
        break;
      case StraightLine::Operation::subtract:
        text += fmt::format("-{},{}", step.first, step.second);
        break;
      case StraightLine::Operation::multiply:
        text += fmt::format("*{},{}", step.first, step.second);
        break;
      case StraightLine::Operation::inverse:
        text += fmt::format("i{}", step.first);
        break;
      case StraightLine::Operation::angle:
        text += fmt::format("a{},{}", step.first, step.second);
        break;
    }
  }
  return text;
}

StraightLine line_of(const core::Polynomial& p) {
  core::StraightLineBuilder builder;
  std::vector<int> variables;
  for (int v = 0; v < p.variables; ++v) variables.push_back(builder.variable(v));
  return builder.line(builder.polynomial(p, variables));
}

std::string cells_text(const std::vector<CellNode>& cells) {
  std::string text;
  for (const CellNode& node : cells) {
    if (!text.empty()) text += ' ';
    switch (node.kind) {
      case CellNode::Kind::cut:
        text += fmt::format("{}:{:a}", node.axis == 0 ? 'x' : 'y', node.at);
        break;
      case CellNode::Kind::free:
        text += '.';
        break;
      case CellNode::Kind::graph:
        text += fmt::format("g{}:{}", node.axis, node.ends);
        break;
      case CellNode::Kind::open:
        text += '?';
        break;
    }
  }
  return text;
}

std::string role_text(core::FactorRole role) {
  switch (role) {
    case core::FactorRole::reaction:
      return "reaction";
    case core::FactorRole::margin:
      return "margin";
    case core::FactorRole::preload:
      return "preload";
    case core::FactorRole::direct_singularity:
      return "direct-singularity";
    case core::FactorRole::workspace_boundary:
      return "workspace-boundary";
    case core::FactorRole::construction:
      break;
  }
  return "construction";
}

/// Functions of a certificate, each program once.
class Functions {
 public:
  int add(core::FactorRole role, const std::string& name, const StraightLine& line) {
    std::string program = program_text(line);
    const auto [found, fresh] = known_.try_emplace(program, static_cast<int>(list.size()));
    if (fresh) list.push_back({{"role", role_text(role)}, {"name", name}, {"program", std::move(program)}});
    return found->second;
  }

  Json list = Json::array();

 private:
  std::map<std::string, int> known_;
};

Json vanishing_list(const std::vector<core::Vanishing>& vanishing) {
  Json list = Json::array();
  for (const core::Vanishing& v : vanishing) list.push_back({v.joint, core::to_string(v.quantity)});
  return list;
}

Json demands_list(const std::vector<core::TaskDemand>& demands) {
  Json list = Json::array();
  for (const core::TaskDemand& demand : demands)
    list.push_back({demand.joint, core::to_string(demand.quantity), core::to_string(demand.least)});
  return list;
}

Json points_list(const core::Polyline& line) {
  Json list = Json::array();
  for (const core::Point2& p : line) list.push_back({p[0], p[1]});
  return list;
}

/// What every certificate begins with.
Json begun(const CertificateSource& source) {
  Json root = {{"format", "clearloci-certificate"}, {"version", 1}, {"command", source.command}};
  root["model"] = {{"text", source.model_text}, {"set", Json::array()}};
  for (const auto& [name, value] : source.overrides) root["model"]["set"].push_back({name, value});
  return root;
}

std::string text_of(const Json& root) { return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json pose_list(const core::RationalPose& pose) {
  Json list = Json::array();
  for (const core::Rational& value : pose) list.push_back(core::to_string(value));
  return list;
}

Json task_object(const core::Task& task) {
  Json points = Json::array();
  const auto add = [&](const core::RationalPose& p) {
    points.push_back({core::to_string(p[0]), core::to_string(p[1])});
  };
  core::Rational radius = 0;
  if (const auto* box = std::get_if<core::TaskBox>(&task.shape)) {
    add(box->lower);
    add(box->upper);
  } else if (const auto* circle = std::get_if<core::TaskBall>(&task.shape)) {
    add(circle->centre);
    radius = circle->radius;
  } else if (const auto* polygon = std::get_if<core::TaskPolygon>(&task.shape)) {
    for (const core::RationalPose& p : polygon->corners) add(p);
  } else {
    for (const core::RationalPose& p : std::get<core::TaskPath>(task.shape).points) add(p);
  }
  Json unchecked = Json::array();
  if (task.min_force || task.min_couple) unchecked.push_back("the least forces and couples");
  if (task.loads) unchecked.push_back("the loads, but for the first of the range");
  return {{"mode", 0},
          {"shape", core::kind_of(task.shape)},
          {"points", std::move(points)},
          {"radius", core::to_string(radius)},
          {"margin", core::to_string(task.margin)},
          {"unchecked", std::move(unchecked)}};
}

Json exact_list(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(core::to_string(core::Rational(value)));
  return list;
}

Json law_of(const std::vector<core::PreloadLawCell>& law) {
  Json cells = Json::array();
  for (const core::PreloadLawCell& cell : law) {
    Json efforts = Json::array(), gains = Json::array();
    for (const std::vector<double>& values : cell.efforts) efforts.push_back(exact_list(values));
    for (const std::vector<double>& values : cell.gains) gains.push_back(exact_list(values));
    cells.push_back({exact_list(cell.lower), exact_list(cell.upper), std::move(efforts), std::move(gains)});
    if (cell.joints != law.front().joints) cells.back().push_back(cell.joints);  // other cables are chosen here
  }
  return {{"joints", law.front().joints}, {"cells", std::move(cells)}};
}

}  // namespace

std::string certificate_text(const CertificateSource& source, const core::Certificate& certificate,
                             const core::Task* task) {
  const core::LocusProblem& problem = certificate.problem;
  const auto mode_of = [&](const core::WorkingMode& mode) {
    return std::find(problem.modes.begin(), problem.modes.end(), mode) - problem.modes.begin();
  };
  Json root = begun(source);
  root["coordinates"] = problem.tower.coordinates;
  root["frame"] = {{"from", {core::to_string(certificate.from[0]), core::to_string(certificate.from[1])}},
                   {"scale", core::to_string(certificate.scale)}};
  root["box"] = Json::array();
  for (std::size_t i = 0; i < problem.lower.size(); ++i)
    root["box"].push_back({core::to_string(problem.lower[i]), core::to_string(problem.upper[i])});
  root["tolerance"] = problem.tolerance;
  root["joints"] = problem.joints;
  root["quantities"] = Json::array();
  for (const core::Quantity quantity : problem.quantities) root["quantities"].push_back(core::to_string(quantity));
  root["roots"] = Json::array();
  for (const core::Root& tower_root : problem.tower.roots)
    root["roots"].push_back(
        {{"point", tower_root.point},
         {"role", tower_root.name == core::limit_name         ? "limit"
                  : tower_root.role == core::RootRole::length ? "length"
                                                              : "working-mode"},
         {"square", program_text(tower_root.line.empty() ? line_of(tower_root.square) : tower_root.line)}});
  root["modes"] = problem.modes;

  Functions functions;
  Json sheets = Json::array(), open = Json::array();
  for (const core::SheetClaim& claim : certificate.sheets) {
    Json domain = Json::array();
    for (const double side : claim.domain) domain.push_back(fmt::format("{:a}", side));
    sheets.push_back({{"mode", claim.mode},
                      {"function", functions.add(claim.role, claim.name, claim.function)},
                      {"role", role_text(claim.role)},
                      {"at_zero", claim.at_zero},
                      {"domain", std::move(domain)},
                      {"cells", cells_text(claim.cells)}});
  }
  for (const core::OpenClaim& claim : certificate.open) {
    const core::LocusFactor& factor = problem.factors.at(static_cast<std::size_t>(claim.factor));
    open.push_back({{"mode", claim.mode},
                    {"function", functions.add(factor.role, factor.expression,
                                               factor.line.empty() ? line_of(factor.sheet) : factor.line)}});
  }
  // Factors without curves make up components of forces; of the others the sheets tell.
  const auto has_sheet = [&](const core::LocusFactor& factor) {
    return std::any_of(certificate.sheets.begin(), certificate.sheets.end(), [&](const core::SheetClaim& claim) {
      return claim.role == factor.role && claim.name == factor.expression;
    });
  };
  for (const core::LocusFactor& factor : problem.factors)
    if (factor.role != core::FactorRole::construction && !has_sheet(factor))
      functions.add(factor.role, factor.expression, factor.line.empty() ? line_of(factor.sheet) : factor.line);
  root["functions"] = std::move(functions.list);
  root["sheets"] = std::move(sheets);
  root["open"] = std::move(open);

  root["curves"] = Json::array();
  for (const core::LocusCurve& curve : certificate.map.curves) {
    Json arcs = Json::array();
    for (const core::Arc& arc : curve.arcs)
      arcs.push_back({{"closed", arc.closed},
                      {"ends", {core::to_string(arc.ends[0]), core::to_string(arc.ends[1])}},
                      {"points", points_list(arc.points)}});
    root["curves"].push_back({{"id", curve.id},
                              {"mode", mode_of(curve.mode)},
                              {"kind", core::to_string(curve.kind)},
                              {"vanishing", vanishing_list(curve.vanishing)},
                              {"certified", curve.certified},
                              {"arcs", std::move(arcs)}});
  }
  root["points"] = Json::array();
  for (const core::IsolatedPoint& point : certificate.map.isolated_points)
    root["points"].push_back({{"mode", mode_of(point.mode)},
                              {"kind", core::to_string(point.kind)},
                              {"vanishing", vanishing_list(point.vanishing)},
                              {"certified", point.certified},
                              {"at", point.at}});
  if (task != nullptr) root["task"] = task_object(*task);
  if (source.command == "zones") {
    root["zones"] = Json::array();
    for (const core::Zone& zone : certificate.zones) {
      Json signs = Json::array(), holes = Json::array();
      for (const auto& [reaction, sign] : zone.signs)
        signs.push_back({reaction.joint, core::to_string(reaction.quantity), sign});
      for (const core::Polyline& hole : zone.holes) holes.push_back(points_list(hole));
      root["zones"].push_back({{"id", zone.id},
                               {"mode", mode_of(zone.mode)},
                               {"assembly_mode", zone.assembly_mode},
                               {"signs", std::move(signs)},
                               {"area", zone.size},
                               {"outer", points_list(zone.outer)},
                               {"holes", std::move(holes)},
                               {"sample", zone.sample},
                               {"certified", zone.certified}});
    }
    root["in_doubt"] = Json::array();
    for (const core::WorkingMode& mode : problem.modes) {
      const auto found = std::find_if(certificate.zoned_modes.begin(), certificate.zoned_modes.end(),
                                      [&](const core::ZonedMode& zoned) { return zoned.mode == mode; });
      root["in_doubt"].push_back(found == certificate.zoned_modes.end() ? 0 : found->in_doubt);
    }
  }
  return text_of(root);
}

namespace {

Json root_of(const CertificateSource& source, const core::TaskCertificate& certificate) {
  const core::Task& task = certificate.task;
  Json root = begun(source);
  root["coordinates"] = certificate.coordinates;
  Json points = Json::array();
  core::Rational radius = 0;
  if (const auto* box = std::get_if<core::TaskBox>(&task.shape)) {
    points.push_back(pose_list(box->lower));
    points.push_back(pose_list(box->upper));
  } else if (const auto* ball = std::get_if<core::TaskBall>(&task.shape)) {
    points.push_back(pose_list(ball->centre));
    radius = ball->radius;
  } else if (const auto* polygon = std::get_if<core::TaskPolygon>(&task.shape)) {
    for (const core::RationalPose& corner : polygon->corners) points.push_back(pose_list(corner));
  } else {
    for (const core::RationalPose& pose : std::get<core::TaskPath>(task.shape).points)
      points.push_back(pose_list(pose));
  }
  Json parameters = Json::array();
  for (const core::TaskCertificate::Range& parameter : certificate.parameters)
    parameters.push_back({parameter.parameter, core::to_string(parameter.lower), core::to_string(parameter.upper)});
  std::string shape = core::kind_of(task.shape);
  if (shape == "circle") shape = "ball";
  root["pose_task"] = {{"shape", shape},
                       {"points", std::move(points)},
                       {"radius", core::to_string(radius)},
                       {"margin", core::to_string(task.margin)},
                       {"angle_length", task.angle_length ? Json(core::to_string(*task.angle_length)) : Json()},
                       {"sides", certificate.sides},
                       {"parameters", std::move(parameters)},
                       {"demands", demands_list(certificate.demands)},
                       {"unchecked", Json::array()}};
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&task.shape)) {
    root["pose_task"]["across"] = polygon->across;
    root["pose_task"]["above"] = pose_list(polygon->above);
  }
  if (task.loads)
    root["pose_task"]["loads_from"] = Json::array({pose_list(task.loads->first), pose_list(task.loads->second)});
  for (const core::LoadWithin& load_range : task.loads_within)
    root["pose_task"]["loads_within"].push_back(
        {load_range.load, core::to_string(load_range.force), core::to_string(load_range.couple)});
  return root;
}

/// Rows of the efforts' own bounds are those of the ranges.
Json rows_of(const core::PreloadPattern& pattern) {
  Json rows = Json::array();
  for (const core::PreloadRow& row : pattern.refutation) {
    if (row.bound && row.at.empty()) continue;
    rows.push_back({{"reaction", row.reaction},
                    {"sign", row.sign},
                    {"bound", row.bound},
                    {"at", exact_list(row.at)},
                    {"load", exact_list(row.load)},
                    {"multiplier", core::to_string(core::Rational(row.multiplier))}});
  }
  return rows;
}

}  // namespace

std::string certificate_text(const CertificateSource& source, const core::TaskCertificate& certificate,
                             const std::vector<core::PreloadLawCell>& law) {
  Json root = root_of(source, certificate);
  if (!law.empty()) root["pose_task"]["law"] = law_of(law);
  return text_of(root);
}

std::string certificate_text(const CertificateSource& source, const core::TaskCertificate& certificate,
                             const core::PreloadAnswer& refuted) {
  Json root = root_of(source, certificate), patterns = Json::array(), ranges = Json::array();
  for (std::size_t k = 0; k < refuted.joints.size(); ++k)
    ranges.push_back(exact_list({refuted.lower[k], refuted.upper[k]}));
  for (const core::PreloadPattern& pattern : refuted.patterns) {
    Json signs = Json::array();
    for (const auto& [name, sign] : pattern.signs) signs.push_back({name, sign});
    patterns.push_back({{"signs", std::move(signs)}, {"joints", pattern.joints}, {"rows", rows_of(pattern)}});
  }
  root["pose_task"]["refutation"] = {{"joints", refuted.joints},
                                     {"ranges", std::move(ranges)},
                                     {"controlled", certificate.task.controlled_preload},
                                     {"knows_load", certificate.task.knows_load},
                                     {"patterns", std::move(patterns)}};
  return text_of(root);
}

std::string certificate_text(const CertificateSource& source, const core::RangeCertificate& certificate) {
  Json root = begun(source);
  root["coordinates"] = Json::array({certificate.coordinate});
  Json modes = Json::array();
  for (const core::RangeCertificate::Mode& mode : certificate.modes) {
    Json free = Json::array(), points = Json::array(), open = Json::array();
    for (const core::RangeCertificate::Free& entry : mode.free) {
      Json signs = Json::array();
      for (const auto& [what, sign] : entry.signs) signs.push_back({what.joint, core::to_string(what.quantity), sign});
      free.push_back({{"zone", entry.zone},
                      {"from", core::to_string(entry.from)},
                      {"to", core::to_string(entry.to)},
                      {"assembly_mode", entry.assembly_mode},
                      {"signs", std::move(signs)},
                      {"too_small", vanishing_list(entry.too_small)}});
    }
    for (const core::IsolatedPoint& point : mode.points)
      points.push_back({{"at", core::to_string(core::Rational(point.at.front()))},
                        {"kind", core::to_string(point.kind)},
                        {"vanishing", vanishing_list(point.vanishing)},
                        {"certified", point.certified}});
    for (const auto& [from, to] : mode.open) open.push_back({core::to_string(from), core::to_string(to)});
    modes.push_back({{"sides", mode.sides},
                     {"demands", demands_list(mode.demands)},
                     {"free", std::move(free)},
                     {"points", std::move(points)},
                     {"open", std::move(open)}});
  }
  root["pose_range"] = {{"modes", std::move(modes)}};
  return text_of(root);
}

}  // namespace clearloci::report
