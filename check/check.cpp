#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "check/arcs.hpp"
#include "check/certificate.hpp"
#include "check/curves.hpp"
#include "check/identity.hpp"
#include "check/labels.hpp"
#include "check/points.hpp"
#include "check/pose_range.hpp"
#include "check/pose_task.hpp"
#include "check/task.hpp"
#include "check/zones.hpp"
#include "core/errors.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/idle_limits.hpp"
#include "mechanism/read.hpp"

namespace clearloci::check {
namespace {

using core::FactorRole;
using core::Quantity;

constexpr int no_pose = -2;  // of an arc of a mode that could not be looked at
constexpr std::size_t most_bytes = 400'000'000;

bool has_angle(const core::StraightLine& line) {
  return std::any_of(line.steps.begin(), line.steps.end(), [](const core::StraightLine::Step& step) {
    return step.operation == core::StraightLine::Operation::angle;
  });
}

class Check {
 public:
  Check(const mechanism::Mechanism& m, CertificateFile c) : m_(m), c_(std::move(c)) {}

  Examination run() {
    check_header();
    check_kinds();
    find_slits();
    for (const CurveClaim& curve : c_.curves)
      for (const core::Arc& arc : curve.arcs) arcs_.push_back({&curve, &arc});
    for (int mode = 0; mode < static_cast<int>(c_.modes.size()); ++mode) {
      const Orders orders = orders_of(m_, c_, mode);
      if (!orders.known) {
        examination_.unchecked.push_back(fmt::format("mode {}: hardly a pose of it is in the box", mode + 1));
        for (KnownArc& arc : arcs_)
          if (arc.curve->mode == mode) arc.sheet = no_pose;
        continue;
      }
      check_mode(mode, orders);
    }
    check_labels();
    check_zones(m_, c_, examination_);
    examination_.open_share = area_ > 0 ? open_area_ / area_ : 0;
    examination_.accepted = true;
    return examination_;
  }

 private:
  void check_header() const {
    if (m_.space != mechanism::Space::planar || m_.coordinates.size() != 2 || m_.coordinates[0].angle ||
        m_.coordinates[1].angle)
      throw core::InputError({m_.file}, "only planar mechanisms over two lengths can be checked", "");
    for (std::size_t i = 0; i < 2; ++i) {
      if (c_.coordinates[i] != m_.coordinates[i].name) throw FalseClaim("coordinates: they are not the model's");
      if (in_file(i, c_.box[2 * i]) != m_.coordinates[i].lower ||
          in_file(i, c_.box[2 * i + 1]) != m_.coordinates[i].upper)
        throw FalseClaim("box: it is not the model's");
    }
    if (!(c_.box[0] < c_.box[1] && c_.box[2] < c_.box[3])) throw FalseClaim("box: it is empty");
    // By these names modes are told.
    std::vector<std::string> dyads, named;
    for (const mechanism::PointIndex point : mechanism::dyad_points(m_))
      dyads.push_back(m_.points[static_cast<std::size_t>(point)].name);
    for (std::size_t j = 0; j < c_.root_roles.size(); ++j)
      if (c_.root_roles[j] == core::RootRole::working_mode) named.push_back(c_.root_points[j]);
    if (named != dyads) throw FalseClaim("roots: there is not one for every dyad and slider, by its name");
    // Limits that keep a number, and so bound nothing, were left out.
    if (c_.limit_roots.size() != limit_ends(m_))
      throw core::InputError({m_.file}, "the model has a limit that the certificate knows no root of",
                             "leave a limit out that no pose is beyond");
    for (const core::WorkingMode& mode : c_.modes)
      for (std::size_t j = 0; j < mode.size(); ++j)
        if (c_.root_roles[j] == core::RootRole::length && mode[j] != 1) throw FalseClaim("modes: a length is negative");
    std::set<core::WorkingMode> different(c_.modes.begin(), c_.modes.end());
    if (c_.modes.empty() || different.size() != c_.modes.size()) throw FalseClaim("modes: there is none, or one twice");
    for (const std::string& joint : c_.joints)
      if (std::none_of(m_.joints.begin(), m_.joints.end(),
                       [&](const auto& candidate) { return candidate.name == joint; }))
        throw FalseClaim("joints: '" + joint.substr(0, 40) + "' is none of the model's");
  }

  /// The limits of torsion springs are the last, in the order of the springs, whose angles are named after them; so may
  /// points be.
  void find_slits() {
    std::size_t next = c_.limit_roots.size();
    for (const mechanism::Spring& spring : m_.springs)
      next -= spring.kind == mechanism::Spring::Kind::torsion ? 1U : 0U;
    for (const mechanism::Spring& spring : m_.springs) {
      if (spring.kind != mechanism::Spring::Kind::torsion) continue;
      const int limit = c_.limit_roots.at(next++);
      for (std::size_t j = 0; j < c_.root_points.size(); ++j)
        if (c_.root_points[j] == spring.name && has_angle(c_.squares[j]))
          c_.slits.emplace_back(static_cast<int>(j), limit);
    }
  }

  /// Kinds follow from what vanishes, whether it is claimed to be certain or not.
  void check_kinds() const {
    const auto check = [](core::LocusKind kind, const std::vector<Reaction>& vanishing, const std::string& what) {
      if (kind <= core::LocusKind::component && kind != gravest_kind(vanishing))
        throw FalseClaim(fmt::format("{} is said to be of the kind {}, where {} vanish", what, core::to_string(kind),
                                     names({vanishing.begin(), vanishing.end()})));
      // What vanishes along one of these has a curve of its own.
      const bool is_singular =
          kind == core::LocusKind::direct_singularity || kind == core::LocusKind::workspace_boundary;
      if (is_singular && !vanishing.empty())
        throw FalseClaim(fmt::format("{} of the kind {} is said to make {} vanish", what, core::to_string(kind),
                                     names({vanishing.begin(), vanishing.end()})));
      std::set<Reaction> different(vanishing.begin(), vanishing.end());
      if (different.size() != vanishing.size()) throw FalseClaim(what + " names one reaction twice");
    };
    for (const CurveClaim& curve : c_.curves) check(curve.kind, curve.vanishing, "a curve");
    for (const PointClaim& point : c_.points) check(point.kind, point.vanishing, "a point");
  }

  core::Rational in_file(std::size_t coordinate, const core::Rational& value) const {
    return c_.from[coordinate] + c_.scale * value;
  }

  std::string name(int function) const { return c_.functions[static_cast<std::size_t>(function)].name; }

  bool has_zeros(const std::optional<Exponents>& exponents, int f) const {
    return exponents && (*exponents)[static_cast<std::size_t>(f)] > 0;
  }

  /// Roots of dyads and sliders, then of limits, in the order of the model, as numbers of the certificate's roots.
  std::vector<int> mode_roots() const {
    std::vector<int> roots;
    for (std::size_t j = 0; j < c_.root_roles.size(); ++j)
      if (c_.root_roles[j] == core::RootRole::working_mode) roots.push_back(static_cast<int>(j));
    roots.insert(roots.end(), c_.limit_roots.begin(), c_.limit_roots.end());
    return roots;
  }

  void check_mode(int mode, const Orders& orders) {
    // What the certificate says of a function holds for all that it is made of.
    const auto makers = [&](int function) -> const auto& { return orders.makers[static_cast<std::size_t>(function)]; };
    std::vector<SheetCells> sheets;
    std::set<std::pair<int, FactorRole>> claimed;
    std::vector<int> singular;
    for (const SheetCells& sheet : c_.sheets)
      if (sheet.mode == mode) sheets.push_back(sheet);
    for (const OpenClaim& claim : c_.open)
      if (claim.mode == mode) sheets.push_back(without_cells(claim, orders));
    for (const SheetCells& sheet : sheets)
      for (const int maker : makers(sheet.function)) claimed.emplace(maker, sheet.role);
    const auto need = [&](int function, FactorRole role, const std::string& what) {
      if (!claimed.contains({function, role}))
        throw FalseClaim(
            fmt::format("{} in mode {}: {} vanishes with it, but no cells tell where", name(function), mode + 1, what));
    };
    const std::vector<int> roots = mode_roots();
    for (int f = 0; f < static_cast<int>(orders.determinant.size()); ++f) {
      if (orders.determinant[static_cast<std::size_t>(f)] != 0) {
        singular.push_back(f);
        need(f, FactorRole::direct_singularity, "|A|");
      }
      for (std::size_t j = 0; j < roots.size(); ++j)
        if (has_zeros(orders.squares[j], f)) need(f, FactorRole::workspace_boundary, "a root");
    }
    for (std::size_t j = 0; j < roots.size(); ++j)
      if (!orders.squares[j])
        throw FalseClaim("functions: the boundary made by " + c_.root_points[static_cast<std::size_t>(roots[j])] +
                         " is not among them");
    need_reactions(orders, need);
    for (const OpenClaim& claim : c_.open)
      if (claim.mode == mode) open_[mode].merge(vanishing_with(orders, makers(claim.function)));
    check_points(m_, c_, mode, orders, examination_);
    for (SheetCells& sheet : sheets) {
      const std::vector<int>& made_of = makers(sheet.function);
      if (made_of.empty()) sheet.at_zero.clear();  // what the closure divides by: no zeros of it are known
      for (const int j : sheet.at_zero) {
        if (!std::all_of(made_of.begin(), made_of.end(),
                         [&](int maker) { return has_zeros(orders.roots.at(static_cast<std::size_t>(j)), maker); }))
          throw FalseClaim(name(sheet.function) + ": it does not vanish with the root that is said to be zero");
      }
      check_sheet(sheet, {0, singular, vanishing_with(orders, makers(sheet.function))});
    }
    if (c_.task && c_.task->mode == mode) check_task(m_, c_, orders, examination_);
  }

  /// Reactions that one of the functions is a factor of.
  std::set<Reaction> vanishing_with(const Orders& orders, const std::vector<int>& functions) const {
    const std::vector<mechanism::Unknown> unknowns = reactions_of(m_);
    std::set<Reaction> result;
    for (std::size_t j = 0; j < m_.joints.size(); ++j) {
      const std::vector<Quantity> parts = mechanism::contact_components(m_, m_.joints[j]);
      bool force = false;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != static_cast<int>(j)) continue;
        const bool zero = !orders.reactions[k] || std::any_of(functions.begin(), functions.end(),
                                                              [&](int f) { return has_zeros(orders.reactions[k], f); });
        if (zero) result.insert({m_.joints[j].name, unknowns[k].quantity});
        force = force || (zero && std::find(parts.begin(), parts.end(), unknowns[k].quantity) != parts.end());
      }
      if (force) result.insert({m_.joints[j].name, Quantity::f});
    }
    return result;
  }

  void check_sheet(const SheetCells& sheet, CurvePart part) {
    Curve curve(c_, sheet);
    examination_.cells += curve.cells;
    examination_.graphs += curve.graphs;
    examination_.crossings += curve.ends;
    area_ += curve.area;
    open_area_ += curve.open_area;
    if (sheet.role == FactorRole::margin)
      examination_.unchecked.push_back(fmt::format("margin {} in mode {}: its function is not held against the model",
                                                   name(sheet.function).substr(0, 60), sheet.mode + 1));
    sheets_.push_back(sheet);
    part.number = static_cast<int>(sheets_.size()) - 1;
    check_arcs(m_, curve, part, arcs_, examination_.unchecked);
  }

  /// A function that was left to the exact engine: all of its cells are the checker's.
  SheetCells without_cells(const OpenClaim& claim, const Orders& orders) {
    SheetCells sheet{claim.mode, claim.function, c_.functions[static_cast<std::size_t>(claim.function)].role, {}, {},
                     {}};
    const std::vector<int> roots = mode_roots();
    for (std::size_t j = 0; j < roots.size(); ++j)
      if (core::depends_on(c_.functions[static_cast<std::size_t>(claim.function)].program, 2 + roots[j]) &&
          std::any_of(orders.makers[static_cast<std::size_t>(claim.function)].begin(),
                      orders.makers[static_cast<std::size_t>(claim.function)].end(),
                      [&](int maker) { return has_zeros(orders.squares[j], maker); }))
        sheet.at_zero.push_back(roots[j]);
    // Off the box and off what designs like.
    const double w = core::Rational(c_.box[1] - c_.box[0]).get_d(), h = core::Rational(c_.box[3] - c_.box[2]).get_d();
    sheet.domain = {c_.box[0].get_d() - 0.0011 * w, c_.box[1].get_d() + 0.0009 * w, c_.box[2].get_d() - 0.0013 * h,
                    c_.box[3].get_d() + 0.0007 * h};
    sheet.cells = {{core::CellNode::Kind::open, 0, 0, 0}};
    return sheet;
  }

  template <class Need>
  void need_reactions(const Orders& orders, const Need& need) const {
    const std::vector<mechanism::Unknown> unknowns = reactions_of(m_);
    for (const std::string& joint : c_.joints) {
      const auto found =
          std::find_if(m_.joints.begin(), m_.joints.end(), [&](const auto& j) { return j.name == joint; });
      const std::vector<Quantity> parts = mechanism::contact_components(m_, *found);
      std::vector<const std::vector<int>*> components;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != found - m_.joints.begin() || !orders.reactions[k]) continue;
        const Quantity quantity = unknowns[k].quantity;
        if (std::find(parts.begin(), parts.end(), quantity) != parts.end()) components.push_back(&*orders.reactions[k]);
        if (std::find(c_.quantities.begin(), c_.quantities.end(), quantity) == c_.quantities.end()) continue;
        for (std::size_t f = 0; f < c_.functions.size(); ++f)
          if ((*orders.reactions[k])[f] > 0)
            need(static_cast<int>(f), FactorRole::reaction, core::to_string(quantity) + "_" + joint);
      }
      if (components.empty() ||
          std::find(c_.quantities.begin(), c_.quantities.end(), Quantity::f) == c_.quantities.end())
        continue;
      for (std::size_t f = 0; f < c_.functions.size(); ++f)
        if (std::all_of(components.begin(), components.end(),
                        [&](const auto* orders_of_one) { return (*orders_of_one)[f] > 0; }))
          need(static_cast<int>(f), FactorRole::reaction, "f_" + joint);
    }
  }

  bool has_reaction_arc(int mode, const core::Point2& at) const {
    for (const KnownArc& arc : arcs_) {
      if (arc.curve->mode != mode || arc.curve->kind > core::LocusKind::component) continue;
      if (passes_near(arc.arc->points, at, 2.5 * c_.tolerance)) return true;
    }
    return false;
  }

  /// Near three places of an arc, none at its middle: what designs are symmetric about crosses there. Vertices but for
  /// arcs of few.
  static std::array<core::Point2, 3> places_of(const core::Polyline& points) {
    std::array<core::Point2, 3> places{};
    const auto last = static_cast<double>(points.size() - 1);
    for (std::size_t i = 0; i < 3; ++i) {
      constexpr std::array shares = {0.4142, 0.2361, 0.7321};
      const double along = points.size() > 8 ? std::round(shares[i] * last) : shares[i] * last;
      const auto k = std::min(static_cast<std::size_t>(along), points.size() - 2);
      const double t = along - static_cast<double>(k);
      for (std::size_t c = 0; c < 2; ++c) places[i][c] = (1 - t) * points[k][c] + t * points[k + 1][c];
    }
    return places;
  }

  /// What is wrong with what an arc says near a place; empty: nothing.
  std::string fault_near(const KnownArc& arc, const core::Point2& at, bool& told) const {
    const CurveClaim& curve = *arc.curve;
    const auto label = label_at(m_, c_, sheets_[static_cast<std::size_t>(arc.sheet)], at);
    const std::set<Reaction> said(curve.vanishing.begin(), curve.vanishing.end());
    const std::string place = fmt::format("near ({}, {})", at[0], at[1]);
    told = label.has_value();
    if (!label) return {};
    if (curve.kind > core::LocusKind::component) {
      if (label->empty() || has_reaction_arc(curve.mode, at)) return {};
      // Where the curve of a reaction is open nothing is claimed of it.
      const auto open = open_.find(curve.mode);
      const bool claimed =
          open == open_.end() || !std::includes(open->second.begin(), open->second.end(), label->begin(), label->end());
      if (!claimed) told = false;
      return claimed ? names(*label) + " vanish " + place + ", but no arc says so" : "";
    }
    if (*label == said) return {};
    return fmt::format("an arc {} is said to make {} vanish; it is {}", place, names(said), names(*label));
  }

  /// No arc is left over, and what each says vanishes on it does. Where another curve crosses more vanishes than along
  /// the arc: two of three places decide.
  void check_labels() {
    std::size_t uncertain = 0;
    for (const KnownArc& arc : arcs_) {
      if (arc.sheet == no_pose) continue;
      if (!arc.curve->certified) {
        ++uncertain;
        continue;
      }
      const std::array<core::Point2, 3> places = places_of(arc.arc->points);
      const std::string place = fmt::format("near ({}, {})", places[0][0], places[0][1]);
      if (arc.sheet < 0) throw FalseClaim("an arc " + place + " is on no curve that the cells prove");
      ++examination_.arcs;
      if (arc.curve->kind == core::LocusKind::margin) continue;
      int told = 0, wrong = 0;
      std::string fault;
      for (const core::Point2& at : places) {
        bool known_here = false;
        const std::string near_fault = fault_near(arc, at, known_here);
        told += known_here ? 1 : 0;
        if (!near_fault.empty()) ++wrong, fault = near_fault;
        if (told > 0 && wrong == 0) break;
      }
      if (told == 0)
        examination_.unchecked.push_back("what vanishes " + place);
      else if (2 * wrong >= told)
        throw FalseClaim(fault);
    }
    if (uncertain > 0)
      examination_.unchecked.push_back(fmt::format("{} arcs that are not claimed to be certain", uncertain));
  }

  const mechanism::Mechanism& m_;
  CertificateFile c_;
  std::vector<KnownArc> arcs_;
  std::map<int, std::set<Reaction>> open_;  ///< by mode: reactions of which a function is left open
  std::vector<SheetCells> sheets_;          // looked at so far
  double area_ = 0, open_area_ = 0;         // of all sheets, and of the cells of which nothing is known
  Examination examination_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw core::InputError({path}, "the file cannot be read", "give the path of a certificate");
  std::string bytes;
  std::vector<char> part(1 << 16);
  while (stream.read(part.data(), static_cast<std::streamsize>(part.size())) || stream.gcount() > 0) {
    bytes.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > most_bytes) throw core::InputError({path}, "the file is too large", "certificates are smaller");
  }
  return bytes;
}

/// A model's text is the certificate's. Returns what stands in the file.
std::string certified_text(const std::string& text, const std::string& file, const std::string& in_certificate) {
  std::string certified_text = mechanism::model_text(text, file).text;
  if (!same_text(certified_text, in_certificate))
    throw FalseClaim("model: it is not the file that the certificate was made for");
  return certified_text;
}

/// Of poses over any coordinates. `head`: with the text of the model.
Examination examination_of_poses(const std::string& model_text, const std::string& model_file,
                                 const PoseTaskClaim& head, const auto& check) {
  const std::string text = certified_text(model_text, model_file, head.model);
  const mechanism::Mechanism mechanism =
      mechanism::without_idle_limits(mechanism::parse_mechanism(text, model_file, head.overrides));
  Examination examination;
  check(mechanism, examination);
  return examination;
}

}  // namespace

Examination check_certificate_text(const std::string& model_text, const std::string& model_file,
                                   const std::string& certificate_text, const std::string& certificate_file,
                                   const Deadline& deadline) {
  try {
    const nlohmann::json root = parse_certificate(certificate_text, certificate_file);
    if (root.contains("pose_task")) {
      const PoseTaskClaim claim = read_pose_task(root, certificate_file);
      return examination_of_poses(model_text, model_file, claim, [&](const auto& mechanism, Examination& examination) {
        check_pose_task(mechanism, claim, deadline, examination);
      });
    }
    if (root.contains("pose_range")) {
      const PoseRangeClaim claim = read_pose_range(root, certificate_file);
      return examination_of_poses(model_text, model_file, claim.head,
                                  [&](const auto& mechanism, Examination& examination) {
                                    check_pose_range(mechanism, claim, deadline, examination);
                                  });
    }
    CertificateFile certificate = read_certificate(root, certificate_file);
    certificate.deadline = deadline;
    const std::string own_text = certified_text(model_text, model_file, certificate.model);
    mechanism::Mechanism mechanism =
        mechanism::without_idle_limits(mechanism::parse_mechanism(own_text, model_file, certificate.overrides));
    // What is claimed of a pose is held against the model at that pose of the model's own.
    mechanism.frame = mechanism::Frame{
        .origin = {}, .from = {certificate.from.begin(), certificate.from.end()}, .scale = certificate.scale};
    return Check(mechanism, certificate).run();
  } catch (const FalseClaim& claim) {
    Examination examination;
    examination.why = claim.what();
    return examination;
  }
}

Examination check_certificate(const std::string& model, const std::string& certificate, const Deadline& deadline) {
  return check_certificate_text(mechanism::read_model_text(model).text, model, bytes_of(certificate), certificate,
                                deadline);
}

}  // namespace clearloci::check
