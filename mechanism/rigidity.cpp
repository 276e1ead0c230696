#include "mechanism/rigidity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "mechanism/place_vectors.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/precise_posture.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using place_vectors::cross;
using place_vectors::distance;
using place_vectors::dot;
using place_vectors::minus;
using place_vectors::Vector;
using Pair = std::array<PointIndex, 2>;

constexpr std::size_t enough_postures = 24;
/// Of a link's size: points nearer than that are in one place.
constexpr double least_part = 1e-6;
/// What rounding moves a point by, of its coordinates, with room for a construction.
constexpr double rounding = 1e-13;
/// The same of points to 256 bits, and what irrational numbers, replaced within 1e-30, move of a link's length beside
/// the end of a reach.
constexpr double precise_rounding = 1e-60, precise_bending = 1e-26;

Pair pair_of(PointIndex a, PointIndex b) { return {std::min(a, b), std::max(a, b)}; }

const PointForm& form_of(const Mechanism& mechanism, PointIndex point) {
  return mechanism.points[static_cast<std::size_t>(point)].form;
}

/// The points that have to stay where they are in a link: its own, its centre of mass and its masses.
std::vector<PointIndex> points_held(const Link& link) {
  std::vector<PointIndex> list = link.points;
  const auto add = [&](PointIndex point) {
    if (std::find(list.begin(), list.end(), point) == list.end()) list.push_back(point);
  };
  if (!link.mass.is_zero_literal()) add(link.centre_of_mass);
  for (const PointMass& mass : link.masses) add(mass.at);
  return list;
}

/// Whether a number or a vector is the same in every pose as it is written: made of numbers and parameters.
bool is_constant(const Mechanism& mechanism, const Expression& number) {
  const std::set<std::string> names = symbols(number);
  return std::none_of(mechanism.coordinates.begin(), mechanism.coordinates.end(),
                      [&](const Coordinate& coordinate) { return names.contains(coordinate.name); });
}

bool is_constant(const Mechanism& mechanism, const VectorExpression& vector) {
  const std::vector<Expression> numbers = numbers_of(vector);
  return points_of(vector).empty() && std::all_of(numbers.begin(), numbers.end(), [&](const Expression& number) {
           return is_constant(mechanism, number);
         });
}

/// Distances that the construction of the points holds, as far as simple rules tell.
class Construction {
 public:
  explicit Construction(const Mechanism& mechanism) : m_(mechanism) {
    for (std::size_t i = 0; i < m_.points.size(); ++i) {
      const auto index = static_cast<PointIndex>(i);
      if (const auto* dyad = std::get_if<DyadPoint>(&m_.points[i].form)) {
        if (is_constant(m_, dyad->from_length)) held_.insert(pair_of(index, dyad->from));
        if (!dyad->right_angle && is_constant(m_, dyad->to_length)) held_.insert(pair_of(index, dyad->to));
      } else if (const auto* slider = std::get_if<SliderPoint>(&m_.points[i].form)) {
        if (is_constant(m_, slider->length)) held_.insert(pair_of(index, slider->from));
      } else if (const auto* shifted = std::get_if<ShiftedPoint>(&m_.points[i].form)) {
        if (is_constant(m_, shifted->by)) held_.insert(pair_of(index, shifted->from));
      }
    }
    for (const Group& group : m_.groups)
      for (const Group::Distance& distance : group.distances)
        if (is_constant(m_, distance.length)) held_.insert(pair_of(distance.first, distance.second));
  }

  /// A distance between a point on the way between two points and another one follows from those of the two.
  bool holds(PointIndex a, PointIndex b) const { return holds(a, b, 0); }

  bool is_built_by_roots(PointIndex point) const {
    const PointForm& form = form_of(m_, point);
    if (std::holds_alternative<ExplicitPoint>(form)) return false;
    if (const auto* mean = std::get_if<MeanPoint>(&form))
      return is_built_by_roots(mean->first) || is_built_by_roots(mean->second);
    if (const auto* shifted = std::get_if<ShiftedPoint>(&form)) {
      const std::set<PointIndex> used = points_of(shifted->by);
      return is_built_by_roots(shifted->from) ||
             std::any_of(used.begin(), used.end(), [&](PointIndex candidate) { return is_built_by_roots(candidate); });
    }
    return true;
  }

 private:
  bool holds(PointIndex a, PointIndex b, int depth) const {
    constexpr int deepest = 6;
    if (a == b || held_.contains(pair_of(a, b))) return true;
    if (depth == deepest) return false;
    for (const auto& [near_end, other] : {std::pair(a, b), std::pair(b, a)}) {
      const PointForm& form = form_of(m_, near_end);
      std::optional<Pair> ends;
      bool beside = false;
      if (const auto* mean = std::get_if<MeanPoint>(&form)) ends = {mean->first, mean->second};
      if (const auto* offset = std::get_if<OffsetPoint>(&form)) {
        ends = {offset->first, offset->second};
        beside = !offset->left.is_zero_literal();
      }
      if (!ends) continue;
      const auto& [first, second] = *ends;
      if (beside && other != first && other != second && !beside_same(other, *ends)) continue;
      if (holds(first, second, depth + 1) && holds(first, other, depth + 1) && holds(second, other, depth + 1))
        return true;
    }
    return false;
  }

  /// A point that is placed in the frame of the same two points.
  bool beside_same(PointIndex point, const Pair& ends) const {
    const auto* offset = std::get_if<OffsetPoint>(&form_of(m_, point));
    const auto* mean = std::get_if<MeanPoint>(&form_of(m_, point));
    return (offset != nullptr && pair_of(offset->first, offset->second) == pair_of(ends[0], ends[1])) ||
           (mean != nullptr && pair_of(mean->first, mean->second) == pair_of(ends[0], ends[1]));
  }

  const Mechanism& m_;
  std::set<Pair> held_;
};

/// The value that most of the sampled ones are, to `tolerance`; nothing where no two agree.
template <class Number>
std::optional<Number> usual_value(std::vector<Number> values, double tolerance) {
  if (values.size() == 1) return values.front();
  std::sort(values.begin(), values.end());
  std::size_t best = 0, most = 1;
  for (std::size_t i = 0, last = 0; i < values.size(); ++i) {
    while (last + 1 < values.size() && values[last + 1] - values[i] <= tolerance) ++last;
    if (last - i + 1 > most) most = last - i + 1, best = i + (last - i) / 2;
  }
  return most > 1 ? std::optional(values[best]) : std::nullopt;
}

/// Postures, and where all points have closed forms the same to 256 bits.
struct Samples {
  std::vector<SampledPosture> postures;
  std::vector<PrecisePoints> precise;
};

Samples samples_of(const Mechanism& mechanism) {
  const std::vector<int> sides = working_mode(mechanism);
  Samples all{sample_poses(mechanism, sides, enough_postures), {}};
  if (!mechanism.groups.empty()) return all;
  Samples closed;
  for (const SampledPosture& posture : all.postures)
    if (auto points = precise_posture(mechanism, posture.pose, sides)) {
      closed.postures.push_back(posture);
      closed.precise.push_back(std::move(*points));
    }
  return closed.postures.size() < 2 ? all : closed;
}

/// One distance that has to be held, over sampled postures.
struct Sampled {
  HeldDistance held;
  std::vector<mpf_class> lengths;
  double size = 0, tolerance = 0;  ///< m: of the link, and by which lengths may differ
  std::optional<mpf_class> usual;
};

mpf_class precise_distance(const std::array<mpf_class, 3>& a, const std::array<mpf_class, 3>& b) {
  mpf_class sum(0, precise_bits);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const mpf_class way = a[i] - b[i];
    sum += way * way;
  }
  return sqrt(sum);
}

double size_of(const std::vector<PointIndex>& points, const std::vector<SampledPosture>& postures) {
  double size = 0;
  for (const SampledPosture& posture : postures)
    for (const PointIndex a : points)
      for (const PointIndex b : points)
        size = std::max(
            size, distance(posture.points[static_cast<std::size_t>(a)], posture.points[static_cast<std::size_t>(b)]));
  return size;
}

/// The lengths of a distance, and by how much those of a rigid link may differ.
void measure(Sampled& sampled, const Samples& samples) {
  const auto a = static_cast<std::size_t>(sampled.held.first), b = static_cast<std::size_t>(sampled.held.second);
  double farthest = 0;
  for (std::size_t k = 0; k < samples.postures.size(); ++k) {
    const Vector &p = samples.postures[k].points[a], &q = samples.postures[k].points[b];
    farthest = std::max({farthest, distance(p, {}), distance(q, {})});
    if (samples.precise.empty())
      sampled.lengths.emplace_back(distance(p, q));
    else
      sampled.lengths.push_back(precise_distance(samples.precise[k][a], samples.precise[k][b]));
  }
  sampled.tolerance = samples.precise.empty() ? bending * sampled.size + rounding * farthest
                                              : precise_bending * sampled.size + precise_rounding * farthest;
  sampled.usual = usual_value(sampled.lengths, sampled.tolerance);
  sampled.held.length = sampled.usual ? sampled.usual->get_d() : 0;
}

/// Distances that rigid links hold and the construction does not: what samples have to tell of.
std::vector<HeldDistance> open_distances(const Mechanism& mechanism, const Construction& construction,
                                         bool by_sides_alone) {
  std::vector<HeldDistance> all;
  for (std::size_t l = 0; l < mechanism.links.size(); ++l) {
    const std::vector<PointIndex> points = points_held(mechanism.links[l]);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const PointIndex a = points[j], b = points[i];
        const bool by_sides = construction.is_built_by_roots(a) || construction.is_built_by_roots(b);
        if (construction.holds(a, b) || (by_sides_alone && !by_sides)) continue;
        all.push_back({static_cast<LinkIndex>(l), a, b, 0, by_sides});
      }
  }
  return all;
}

std::vector<Sampled> sampled_distances(const Mechanism& mechanism, const Samples& samples,
                                       const std::vector<HeldDistance>& open) {
  std::vector<Sampled> all;
  for (const HeldDistance& held : open) {
    const std::vector<PointIndex> points = points_held(mechanism.links[static_cast<std::size_t>(held.link)]);
    Sampled sampled{held, {}, size_of(points, samples.postures), 0, {}};
    measure(sampled, samples);
    all.push_back(std::move(sampled));
  }
  return all;
}

std::string in_file_units(const Mechanism& mechanism, double value, bool angle) {
  char text[40];
  if (angle)
    std::snprintf(text, sizeof text, "%.6g deg", value * 180 / std::numbers::pi);
  else
    std::snprintf(text, sizeof text, "%.10g %s", value / mechanism.units.length.size,
                  mechanism.units.length.name.c_str());
  return text;
}

/// Two lengths with as many digits as tell them apart, at least 10.
std::array<std::string, 2> lengths_in_file_units(const Mechanism& mechanism, const mpf_class& first,
                                                 const mpf_class& second) {
  constexpr int fewest = 10, most = 40;
  const auto text = [&](const mpf_class& length, int digits) {
    const mpf_class this_length = length / mechanism.units.length.size;
    char buffer[2 * most];
    gmp_snprintf(buffer, sizeof buffer, "%.*Fg %s", digits, this_length.get_mpf_t(),
                 mechanism.units.length.name.c_str());
    return std::string(buffer);
  };
  int digits = fewest;
  while (digits < most && text(first, digits) == text(second, digits)) ++digits;
  return {text(first, digits), text(second, digits)};
}

const std::string& point_name(const Mechanism& mechanism, PointIndex point) {
  return mechanism.points[static_cast<std::size_t>(point)].name;
}

[[noreturn]] void refuse(const Mechanism& mechanism, const Sampled& bent, const std::vector<SampledPosture>& postures) {
  const auto [least, greatest] = std::minmax_element(bent.lengths.begin(), bent.lengths.end());
  const Link& link = mechanism.links[static_cast<std::size_t>(bent.held.link)];
  const bool unnamed = mechanism.points[static_cast<std::size_t>(bent.held.second)].auxiliary;
  const auto [low, high] = lengths_in_file_units(mechanism, *least, *greatest);
  const auto where = [&](const std::string& length, auto found) {
    return length + " at " +
           words_of_pose(mechanism, postures[static_cast<std::size_t>(found - bent.lengths.begin())].pose);
  };
  throw core::InputError(
      link.where,
      "link " + link.name + " is not rigid: the distance between " + point_name(mechanism, bent.held.first) + " and " +
          (unnamed ? "its centre of mass" : point_name(mechanism, bent.held.second)) +
          " changes over the workspace, from " + where(low, least) + " to " + where(high, greatest),
      "list only points that move together, and write a com beside the pins as {on: [A, B], offset: [u, v]}");
}

double turn_of(const std::vector<PointIndex>& points, const PosturePoints& posture) {
  const auto at = [&](std::size_t i) { return posture[static_cast<std::size_t>(points[i])]; };
  const Vector a = minus(at(1), at(0)), b = minus(at(2), at(0));
  return points.size() == 3 ? cross(a, b)[2] : dot(cross(a, b), minus(at(3), at(0)));
}

/// Whether a sampled posture keeps the distances.
bool keeps(const std::vector<Sampled>& distances, std::size_t posture) {
  return std::all_of(distances.begin(), distances.end(), [&](const Sampled& sampled) {
    return !sampled.usual || abs(sampled.lengths[posture] - *sampled.usual) <= sampled.tolerance;
  });
}

std::size_t corners_of_turn(const Mechanism& mechanism) { return mechanism.space == Space::spatial ? 4 : 3; }

/// Points of a link of which one may come to stand on the other side of the others: none that stands in the frame of
/// two of them.
void add_turns(const Mechanism& mechanism, LinkIndex index, const std::vector<SampledPosture>& postures,
               const std::vector<bool>& kept, HeldByLinks& result) {
  constexpr double flat = 1e-6;  // of the link's size: of a triangle flatter than that no side is told
  const Construction construction(mechanism);
  const std::vector<PointIndex>& points = mechanism.links[static_cast<std::size_t>(index)].points;
  const std::size_t corners = corners_of_turn(mechanism);
  if (points.size() < corners || postures.empty()) return;
  const double size = size_of(points, postures);
  const double powers = static_cast<double>(corners) - 1;  // of a length in a turn
  const double least = std::pow(flat, powers - 1) * std::pow(size, powers);
  for (std::size_t i = corners - 1; i < points.size(); ++i) {
    std::vector<PointIndex> chosen(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(corners) - 1);
    chosen.push_back(points[i]);
    if (std::none_of(chosen.begin(), chosen.end(), [&](PointIndex p) { return construction.is_built_by_roots(p); }))
      continue;
    std::vector<double> sizes;
    for (std::size_t p = 0; p < postures.size(); ++p)
      if (kept[p]) sizes.push_back(turn_of(chosen, postures[p].points));
    if (sizes.empty()) continue;
    const auto usual = usual_value(sizes, bending * std::pow(size, powers));
    if (usual && std::abs(*usual) > least) result.turns.push_back({index, chosen, *usual});
  }
}

}  // namespace

std::string words_of_pose(const Mechanism& mechanism, const std::vector<double>& pose) {
  std::string text;
  for (std::size_t i = 0; i < pose.size() && i < mechanism.coordinates.size(); ++i)
    text += (i == 0 ? "" : ", ") + mechanism.coordinates[i].name + " = " +
            in_file_units(mechanism, pose[i], mechanism.coordinates[i].angle);
  return text;
}

HeldByLinks held_by_links(const Mechanism& mechanism) {
  HeldByLinks result;
  const Construction construction(mechanism);
  const auto may_bend = [&](const Link& link) {
    return link.points.size() > 1 && std::any_of(link.points.begin(), link.points.end(),
                                                 [&](PointIndex p) { return construction.is_built_by_roots(p); });
  };
  const bool any = std::any_of(mechanism.links.begin(), mechanism.links.end(), [&](const Link& link) {
    const std::vector<PointIndex> points = points_held(link);
    if (points.size() > 2) return may_bend(link);
    return points.size() == 2 && may_bend(link) && !construction.holds(points[0], points[1]);
  });
  if (!any) return result;
  const std::vector<HeldDistance> open = open_distances(mechanism, construction, true);
  const bool may_turn = std::any_of(mechanism.links.begin(), mechanism.links.end(), [&](const Link& link) {
    return link.points.size() >= corners_of_turn(mechanism) && may_bend(link);
  });
  if (open.empty() && !may_turn) return result;
  const Samples samples = samples_of(mechanism);
  const std::vector<SampledPosture>& postures = samples.postures;
  if (postures.size() < 2) return result;
  const std::vector<Sampled> distances = sampled_distances(mechanism, samples, open);
  for (const Sampled& sampled : distances)  // of points in one place there is no ratio, nor a side to be on
    if (sampled.usual && sampled.held.length > least_part * sampled.size) result.distances.push_back(sampled.held);
  std::vector<bool> kept;
  for (std::size_t p = 0; p < postures.size(); ++p) kept.push_back(keeps(distances, p));
  for (std::size_t l = 0; l < mechanism.links.size(); ++l)
    add_turns(mechanism, static_cast<LinkIndex>(l), postures, kept, result);
  return result;
}

void check_rigidity(const Mechanism& mechanism) {
  const std::vector<HeldDistance> open = open_distances(mechanism, Construction(mechanism), false);
  if (open.empty()) return;
  const Samples samples = samples_of(mechanism);
  if (samples.postures.size() < 2) return;
  for (const Sampled& sampled : sampled_distances(mechanism, samples, open)) {
    const auto [least, greatest] = std::minmax_element(sampled.lengths.begin(), sampled.lengths.end());
    if (!sampled.usual || (!sampled.held.by_sides && *greatest - *least > sampled.tolerance))
      refuse(mechanism, sampled, samples.postures);
  }
}

bool keeps(const HeldDistance& held, const PosturePoints& points) {
  const double now =
      distance(points[static_cast<std::size_t>(held.first)], points[static_cast<std::size_t>(held.second)]);
  return std::abs(now * now / (held.length * held.length) - 1) <= bending;
}

bool keeps(const HeldTurn& held, const PosturePoints& points) { return turn_of(held.points, points) / held.size > 0; }

bool keeps(const HeldByLinks& held, const PosturePoints& points) {
  const auto kept = [&](const auto& candidate) { return keeps(candidate, points); };
  return std::all_of(held.distances.begin(), held.distances.end(), kept) &&
         std::all_of(held.turns.begin(), held.turns.end(), kept);
}

std::string words_of(const Mechanism& mechanism, const HeldDistance& held) {
  const Point& second = mechanism.points[static_cast<std::size_t>(held.second)];
  return "distance " + point_name(mechanism, held.first) + "-" + (second.auxiliary ? "centre of mass" : second.name) +
         " of the rigid link " + mechanism.links[static_cast<std::size_t>(held.link)].name;
}

std::string words_of(const Mechanism& mechanism, const HeldTurn& held) {
  std::string names;
  for (std::size_t i = 0; i < held.points.size(); ++i)
    names += (i == 0 ? "" : i + 1 == held.points.size() ? " and " : ", ") + point_name(mechanism, held.points[i]);
  return "side of " + names + " in the rigid link " + mechanism.links[static_cast<std::size_t>(held.link)].name;
}

}  // namespace clearloci::mechanism
