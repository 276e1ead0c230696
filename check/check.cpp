#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "check/certificate.hpp"
#include "check/curves.hpp"
#include "check/identity.hpp"
#include "check/labels.hpp"
#include "check/points.hpp"
#include "check/task.hpp"
#include "check/zones.hpp"
#include "core/errors.hpp"
#include "mechanism/read.hpp"

namespace clearloci::check {
namespace {

using core::FactorRole;
using core::Quantity;

constexpr std::size_t most_bytes = 400'000'000;

std::string names(const std::set<Reaction>& reactions) {
  std::string text;
  for (const auto& [joint, quantity] : reactions)
    text += (text.empty() ? "" : ", ") + core::to_string(quantity) + "_" + joint;
  return text.empty() ? "nothing" : text;
}

class Check {
 public:
  Check(const mechanism::Mechanism& m, const CertificateFile& c) : m_(m), c_(c) {}

  Verdict run() {
    check_header();
    for (const CurveClaim& curve : c_.curves)
      for (const core::Arc& arc : curve.arcs) arcs_.push_back({&curve, &arc});
    for (int mode = 0; mode < static_cast<int>(c_.modes.size()); ++mode) {
      const Orders orders = orders_of(m_, c_, mode);
      if (!orders.known) {
        verdict_.unchecked.push_back(fmt::format("mode {}: hardly a pose of it is in the box", mode + 1));
        for (KnownArc& arc : arcs_)
          if (arc.curve->mode == mode) arc.sheet = 0;
        continue;
      }
      check_mode(mode, orders);
    }
    check_arcs();
    for (const ZoneClaim& zone : c_.zones) {
      if (!zone.certified) {
        verdict_.unchecked.push_back("zone " + zone.id + ": not claimed to be certain");
        continue;
      }
      check_zone(m_, c_, zone);
      ++verdict_.zones;
    }
    verdict_.cells = tally_.cells;
    verdict_.graphs = tally_.graphs;
    verdict_.crossings = tally_.crossings;
    verdict_.open_share = tally_.area > 0 ? tally_.open_area / tally_.area : 0;
    verdict_.accepted = true;
    return verdict_;
  }

 private:
  void check_header() const {
    if (m_.space != mechanism::Space::planar || m_.coordinates.size() != 2 || m_.coordinates[0].angle ||
        m_.coordinates[1].angle)
      throw core::InputError({m_.file}, "only planar mechanisms over two lengths can be checked", "");
    for (std::size_t i = 0; i < 2; ++i) {
      if (c_.coordinates[i] != m_.coordinates[i].name) throw FalseClaim("coordinates: they are not the model's");
      if (c_.box[2 * i] != m_.coordinates[i].lower || c_.box[2 * i + 1] != m_.coordinates[i].upper)
        throw FalseClaim("box: it is not the model's");
    }
    if (!(c_.box[0] < c_.box[1] && c_.box[2] < c_.box[3])) throw FalseClaim("box: it is empty");
    const auto dyads = static_cast<std::ptrdiff_t>(mechanism::dyad_points(m_).size());
    if (std::count(c_.root_roles.begin(), c_.root_roles.end(), core::RootRole::working_mode) != dyads)
      throw FalseClaim("roots: there is not one for every dyad and slider");
    for (const core::WorkingMode& mode : c_.modes)
      for (std::size_t j = 0; j < mode.size(); ++j)
        if (c_.root_roles[j] == core::RootRole::length && mode[j] != 1) throw FalseClaim("modes: a length is negative");
    std::set<core::WorkingMode> different(c_.modes.begin(), c_.modes.end());
    if (c_.modes.empty() || different.size() != c_.modes.size()) throw FalseClaim("modes: there is none, or one twice");
    for (const std::string& joint : c_.joints)
      if (std::none_of(m_.joints.begin(), m_.joints.end(), [&](const auto& own) { return own.name == joint; }))
        throw FalseClaim("joints: '" + joint.substr(0, 40) + "' is none of the model's");
  }

  const std::string& name(int function) const { return c_.functions[static_cast<std::size_t>(function)].name; }

  void check_mode(int mode, const Orders& orders) {
    // What the certificate says of a function holds for all with the same zeros.
    std::map<int, std::set<FactorRole>> claimed;
    std::set<int> open, singular;
    const auto same = [&](int function) { return orders.same_zeros[static_cast<std::size_t>(function)]; };
    for (const SheetCells& sheet : c_.sheets)
      if (sheet.mode == mode) claimed[same(sheet.function)].insert(sheet.role);
    for (const OpenClaim& claim : c_.open)
      if (claim.mode == mode) {
        open.insert(same(claim.function));
        const core::Rational area = (c_.box[1] - c_.box[0]) * (c_.box[3] - c_.box[2]);
        tally_.area += area.get_d();
        tally_.open_area += area.get_d();
        verdict_.unchecked.push_back(
            fmt::format("{} in mode {}: no cells, left to the exact engine", name(claim.function), mode + 1));
      }
    const auto need = [&](int function, FactorRole role, const std::string& what) {
      if (claimed[function].contains(role) || open.contains(function)) return;
      throw FalseClaim(
          fmt::format("{} in mode {}: {} vanishes with it, but no cells tell where", name(function), mode + 1, what));
    };
    for (int f = 0; f < static_cast<int>(c_.functions.size()); ++f)
      if (orders.determinant[static_cast<std::size_t>(f)] != 0) {
        singular.insert(f);
        need(f, FactorRole::direct_singularity, "|A|");
      }
    need_reactions(orders, need);
    for (int s = 0; s < static_cast<int>(c_.sheets.size()); ++s) {
      const SheetCells& sheet = c_.sheets[static_cast<std::size_t>(s)];
      if (sheet.mode != mode) continue;
      if (sheet.role == FactorRole::margin) {
        verdict_.unchecked.push_back(fmt::format("margin {} in mode {}: its function is not held against the model",
                                                 name(sheet.function).substr(0, 60), mode + 1));
        for (KnownArc& arc : arcs_)
          if (arc.curve->mode == mode && arc.curve->kind == core::LocusKind::margin) arc.sheet = s;
        continue;
      }
      // |A| does not cut a curve that is its own.
      std::vector<int> cutters;
      std::copy_if(singular.begin(), singular.end(), std::back_inserter(cutters),
                   [&](int f) { return f != same(sheet.function); });
      check_chains(s, check_sheet(c_, s, cutters, arcs_, tally_));
    }
    check_points(m_, c_, mode, orders, verdict_);
    if (c_.task && c_.task->mode == mode) check_task(m_, c_, orders, verdict_);
  }

  template <class Need>
  void need_reactions(const Orders& orders, const Need& need) const {
    const std::vector<mechanism::Unknown> unknowns = reactions_of(m_);
    for (const std::string& joint : c_.joints) {
      const auto own = std::find_if(m_.joints.begin(), m_.joints.end(), [&](const auto& j) { return j.name == joint; });
      const std::vector<Quantity> parts = mechanism::force_components(m_, *own);
      std::vector<const std::vector<int>*> components;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != own - m_.joints.begin() || !orders.reactions[k]) continue;
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

  /// Chains without an arc are parts of reactions' functions on which nothing wanted vanishes; on others a reaction may
  /// vanish too, and then an arc of its own says so.
  void check_chains(int s, const std::vector<Chain>& chains) {
    const SheetCells& sheet = c_.sheets[static_cast<std::size_t>(s)];
    for (const Chain& chain : chains) {
      const bool is_reaction = sheet.role == FactorRole::reaction;
      if (chain.has_arc && is_reaction) continue;
      const std::string place = fmt::format("{} in mode {}: near ({}, {}) ", name(sheet.function), sheet.mode + 1,
                                            chain.inner[0], chain.inner[1]);
      if (!chain.has_arc && !is_reaction) throw FalseClaim(place + "there is no arc for a piece of it");
      const auto label = label_at(m_, c_, sheet, chain.inner);
      if (!label)
        verdict_.unchecked.push_back(place + "what vanishes was not told");
      else if (!label->empty() && (is_reaction || !has_reaction_arc(sheet.mode, chain.inner)))
        throw FalseClaim(place + names(*label) + " vanish, but no arc says so");
    }
  }

  bool has_reaction_arc(int mode, const core::Point2& at) const {
    for (const KnownArc& known : arcs_) {
      if (known.curve->mode != mode || known.curve->kind > core::LocusKind::component) continue;
      if (passes_near(known.arc->points, at, 2.5 * c_.tolerance)) return true;
    }
    return false;
  }

  /// No arc is left over, and what each says vanishes on it does.
  void check_arcs() {
    std::size_t uncertain = 0, open_arcs = 0;
    for (const KnownArc& known : arcs_) {
      const CurveClaim& curve = *known.curve;
      const core::Arc& arc = *known.arc;
      const core::Point2 middle = arc.points.size() > 2 ? arc.points[arc.points.size() / 2]
                                                        : core::Point2{0.5 * (arc.points[0][0] + arc.points[1][0]),
                                                                       0.5 * (arc.points[0][1] + arc.points[1][1])};
      if (!curve.certified) {
        ++uncertain;
        continue;
      }
      if (known.sheet < 0) {
        const bool open =
            std::any_of(c_.open.begin(), c_.open.end(), [&](const OpenClaim& o) { return o.mode == curve.mode; });
        if (!open)
          throw FalseClaim(
              fmt::format("an arc through ({}, {}) is on no curve that the cells prove", middle[0], middle[1]));
        ++open_arcs;
        continue;
      }
      ++verdict_.arcs;
      if (curve.kind > core::LocusKind::component) continue;
      const auto label = label_at(m_, c_, c_.sheets[static_cast<std::size_t>(known.sheet)], middle);
      const std::set<Reaction> said(curve.vanishing.begin(), curve.vanishing.end());
      if (!label)
        verdict_.unchecked.push_back(fmt::format("what vanishes near ({}, {})", middle[0], middle[1]));
      else if (*label != said)
        throw FalseClaim(fmt::format("an arc through ({}, {}) is said to make {} vanish; it is {}", middle[0],
                                     middle[1], names(said), names(*label)));
    }
    if (open_arcs > 0) verdict_.unchecked.push_back(fmt::format("{} arcs of functions without cells", open_arcs));
    if (uncertain > 0)
      verdict_.unchecked.push_back(fmt::format("{} arcs that are not claimed to be certain", uncertain));
  }

  const mechanism::Mechanism& m_;
  const CertificateFile& c_;
  std::vector<KnownArc> arcs_;
  Tally tally_;
  Verdict verdict_;
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

}  // namespace

Verdict check_certificate_text(const std::string& model_text, const std::string& model_file,
                               const std::string& certificate_text, const std::string& certificate_file,
                               const Deadline& deadline) {
  try {
    CertificateFile certificate = read_certificate(certificate_text, certificate_file);
    certificate.deadline = deadline;
    if (!same_text(model_text, certificate.model))
      throw FalseClaim("model: it is not the file that the certificate was made for");
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model_text, model_file, certificate.overrides);
    return Check(mechanism, certificate).run();
  } catch (const FalseClaim& claim) {
    Verdict verdict;
    verdict.why = claim.what();
    return verdict;
  }
}

Verdict check_certificate(const std::string& model, const std::string& certificate, const Deadline& deadline) {
  return check_certificate_text(bytes_of(model), model, bytes_of(certificate), certificate, deadline);
}

}  // namespace clearloci::check
