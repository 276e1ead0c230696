#include "tests/laws/task_oracle.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "loci/tasks/task_region.hpp"
#include "report/verification.hpp"

namespace clearloci::test {
namespace {

bool is_actuators(Quantity q) { return q == Quantity::M || q == Quantity::F; }

/// Columns of reactions that are not asked for: those that are zero whatever the pose and the load, and those of joints
/// without a clearance where others have one.
std::vector<bool> not_asked_for(const Oracle& oracle, const std::vector<Oracle::Solved>& samples) {
  std::vector<bool> zero;
  if (samples.empty()) return zero;
  double largest = 0;
  for (const auto& s : samples)
    for (const auto& end : s.ends) largest = std::max(largest, end.cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < samples.front().ends.front().size(); ++k)
    zero.push_back(std::all_of(samples.begin(), samples.end(), [&](const auto& s) {
      return std::all_of(s.ends.begin(), s.ends.end(),
                         [&](const auto& end) { return std::abs(end(k)) <= 1e-9 * largest; });
    }));
  const std::vector<mechanism::Joint>& joints = oracle.model().mechanism.joints;
  const bool any =
      std::any_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.clearance.has_value(); });
  const auto& unknowns = oracle.model().unknowns;
  for (std::size_t k = 0; k < zero.size(); ++k)
    zero[k] = zero[k] || (any && !joints[static_cast<std::size_t>(unknowns[k].joint)].clearance.has_value());
  return zero;
}

/// A pose of the region and a margin around it: inside, on its outline, on the margin's edge.
Point2 pose_of(std::mt19937& random, const loci::TaskRegion& region, const core::Polyline& outline, double margin) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  if (random() % 2 == 0) {
    const std::size_t i = random() % (outline.size() - 1);
    const double t = number(0, 1), angle = number(0, 6.2832),
                 far = margin * (1 - 1e-9) * (random() % 2 == 0 ? 1 : number(0, 1));
    const Point2 &a = outline[i], &b = outline[i + 1];
    return {a[0] + t * (b[0] - a[0]) + far * std::cos(angle), a[1] + t * (b[1] - a[1]) + far * std::sin(angle)};
  }
  for (int i = 0; i < 200; ++i) {
    const Point2 at = {number(region.lower()[0] - margin, region.upper()[0] + margin),
                       number(region.lower()[1] - margin, region.upper()[1] + margin)};
    if (region.signed_distance(at) <= margin * (1 - 1e-9)) return at;
  }
  return outline.front();
}

}  // namespace

void hold_verified(std::mt19937& random, const Oracle& oracle, const core::Task& task, const Verification& result,
                   int poses, const Say& say) {
  const loci::TaskRegion region(task.shape);
  const core::Polyline outline = core::outline(task.shape);
  say(result.margin >= core::to_double(task.margin), "a margin that is too small");
  std::vector<Oracle::Solved> solved;
  std::vector<Point2> places = region.samples();
  for (int s = 0; s < poses; ++s) places.push_back(pose_of(random, region, outline, result.margin.value_or(0)));
  for (const Point2& at : places) {
    const auto solve = oracle.solve(at);
    if (!solve) return say(false, fmt::format("out of reach at {:.17g}, {:.17g}", at[0], at[1]));
    solved.push_back(*solve);
  }
  const std::vector<bool> zero = not_asked_for(oracle, solved);
  const double force = task.min_force ? core::to_double(*task.min_force) : 0;
  const double couple = task.min_couple ? core::to_double(*task.min_couple) : 0;
  const auto& unknowns = oracle.model().unknowns;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    const std::string where = fmt::format(" at {:.17g}, {:.17g}", places[i][0], places[i][1]);
    say(solved[i].determinant * solved.front().determinant > 0, "|A| changes its sign" + where);
    for (const GuideEnds& guide : guides_of(oracle.model())) {
      if (zero[static_cast<std::size_t>(guide.normal)] && zero[static_cast<std::size_t>(guide.tilt)]) continue;
      for (const auto& load : solved[i].ends)
        for (const std::size_t end : {0u, 1u}) {
          say(guide.of(load)[end] * guide.of(solved.front().ends.front())[end] > 0, "an end of " + guide.joint + where);
          say(std::abs(guide.of(load)[end]) / 2 >= force * (1 - 1e-9),
              "an end bears too little of " + guide.joint + where);
        }
    }
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      const Quantity q = unknowns[k].quantity;
      const std::string name = oracle.model().mechanism.joints[static_cast<std::size_t>(unknowns[k].joint)].name;
      if (is_actuators(q) && !zero[k])
        for (const auto& end : solved[i].ends) {
          say(end(c) * solved.front().ends.front()(c) > 0,
              "another sign of " + core::to_string(q) + " of " + name + where);
          const double least = q == Quantity::M ? couple * (1 - 1e-9) : 0.0;
          say(std::abs(end(c)) >= least, "too small an effort of " + name + where);
        }
      if (q != Quantity::fx) continue;
      // The force between the loads: sampled, and where it is least.
      const Eigen::Vector2d a = solved[i].ends.front().segment<2>(c), b = solved[i].ends.back().segment<2>(c);
      double least = std::min(a.norm(), b.norm());
      for (int s = 0; oracle.range() && s <= 20; ++s)
        least = std::min(least, ((1 - s / 20.0) * a + s / 20.0 * b).norm());
      if ((b - a).norm() > 0)
        least = std::min(least, (a + std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) * (b - a)).norm());
      if (task.min_force || !(zero[k] && zero[k + 1])) {
        say(least >= force * (1 - 1e-9), "too small a force of " + name + where);
        say(least > 1e-12 * a.norm(), "no force of " + name + where);
      }
    }
  }
  // A force that turns over between two close poses has vanished between them.
  for (std::size_t i = 0; result.margin && *result.margin > 0 && i < 60; ++i) {
    const Point2 base = region.closest(pose_of(random, region, outline, 0));
    const double angle = 0.1 * static_cast<double>(random() % 63);
    Point2 p = base, q = {base[0] + *result.margin * (1 - 1e-9) * std::cos(angle),
                          base[1] + *result.margin * (1 - 1e-9) * std::sin(angle)};
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      if (unknowns[k].quantity != Quantity::fx || (zero[k] && zero[k + 1])) continue;
      const auto c = static_cast<Eigen::Index>(k);
      Point2 from = p, to = q;
      bool turned = true;
      for (int step = 0; step < 34 && turned; ++step) {
        const Point2 middle = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
        const auto f = oracle.solve(from), m = oracle.solve(middle), t = oracle.solve(to);
        if (!f || !m || !t) return say(false, "out of reach within the margin");
        const auto cosine = [&](const Oracle::Solved& u, const Oracle::Solved& v) {
          const Eigen::Vector2d a = u.ends.front().segment<2>(c), b = v.ends.front().segment<2>(c);
          return a.dot(b) / (a.norm() * b.norm());
        };
        turned = cosine(*f, *t) < -0.5;
        (cosine(*f, *m) < cosine(*m, *t) ? to : from) = middle;
      }
      say(!turned, fmt::format("a force turns over at {:.17g}, {:.17g}", from[0], from[1]));
    }
  }
}

void hold_refuted(const Oracle& oracle, const core::Task& task, const TaskWitness& witness, const Say& say) {
  const std::string where = fmt::format(" at the witness ({:.17g}, {:.17g}): {}", witness.at[0], witness.at[1],
                                        report::witness_words(witness));
  const loci::TaskRegion region(task.shape);
  // Poses are told to four spacings of doubles.
  const double spacing = 0x1p-52 * std::max(std::abs(witness.at[0]), std::abs(witness.at[1]));
  say(region.signed_distance(point_of(witness.at)) <= std::max(core::to_double(task.margin), 1e-14) + 4 * spacing,
      "farther than the margin" + where);
  const auto around = [&](double step) {
    std::vector<Point2> list = {point_of(witness.at)};
    for (int i = 0; i < 8; ++i)
      list.push_back({witness.at[0] + step * std::cos(i * M_PI / 4), witness.at[1] + step * std::sin(i * M_PI / 4)});
    return list;
  };
  const auto here = oracle.solve(point_of(witness.at));
  if (witness.vanishing.empty() && witness.too_small.empty()) {
    // Out of reach, or there is both within and out of reach; or |A| has both signs.
    int reached = 0, positive = 0;
    const std::vector<Point2> near = around(1e-8);
    for (const Point2& p : near) {
      const auto solve = oracle.solve(p);
      if (solve) ++reached, positive += solve->determinant > 0 ? 1 : 0;
    }
    const int all = static_cast<int>(near.size());
    const bool nearly_singular = here && std::abs(here->determinant) < 1e-12;
    say(!here || reached < all || (positive > 0 && positive < all) || nearly_singular, "not confirmed" + where);
    return;
  }
  if (!here) return say(false, "no pose" + where);
  const double t = witness.load.empty() ? 0 : oracle.load_of(point_of(witness.load));
  say(t >= -1e-12 && t <= 1 + 1e-12, "a load beyond the range" + where);
  const Eigen::VectorXd w = here->at(t);
  for (const core::Vanishing& reaction : witness.too_small) {
    const auto& least = reaction.quantity == Quantity::M ? task.min_couple : task.min_force;
    if (!least) return say(false, "nothing is asked" + where);
    say(oracle.size(w, reaction) < core::to_double(*least), reaction.joint + " bears enough" + where);
  }
  for (const core::Vanishing& reaction : witness.vanishing) {
    double usual = w.cwiseAbs().maxCoeff();
    for (const auto& end : here->ends) usual = std::max(usual, end.cwiseAbs().maxCoeff());
    say(oracle.size(w, reaction) <= 1e-9 * usual, reaction.joint + " bears something" + where);
  }
}

}  // namespace clearloci::test
