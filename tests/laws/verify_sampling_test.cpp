// What verify says of a task against dense sampling of all that it speaks of: poses of the task, its boundary and its
// margin, and loads between the ends of a range. A proof is contradicted by no sample, and the witness of a refutation
// fails by reactions that are solved another way. CLEARLOCI_DESIGNS=n in the environment tries n designs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "analysis/verification.hpp"
#include "core/errors.hpp"
#include "loci/task_region.hpp"
#include "mechanism/read_task.hpp"
#include "numeric/reactions.hpp"
#include "numeric/take_up.hpp"
#include "report/verification.hpp"
#include "tests/laws/task_designs.hpp"

namespace clearloci {
namespace {

using core::Point2;
using core::Quantity;
using core::Verdict;

/// Ends of a guide: N + T/h and N - T/h, twice what they bear.
struct GuideEnds {
  Eigen::Index normal = 0, tilt = 0;
  double half_length = 0;
  std::string joint;

  std::array<double, 2> of(const Eigen::VectorXd& w) const {
    return {w(normal) + w(tilt) / half_length, w(normal) - w(tilt) / half_length};
  }
};

std::vector<GuideEnds> guides_of(const numeric::NumericModel& model) {
  std::vector<GuideEnds> guides;
  const auto clearances = numeric::joint_clearances(model.mechanism);
  for (std::size_t j = 0; j < clearances.size(); ++j)
    if (clearances[j].half_length > 0)
      guides.push_back({numeric::column_of(model, static_cast<int>(j), Quantity::N),
                        numeric::column_of(model, static_cast<int>(j), Quantity::T), clearances[j].half_length,
                        model.mechanism.joints[j].name});
  return guides;
}

/// Reactions at poses and loads by LU of all equations: nothing that verify uses.
class Oracle {
 public:
  Oracle(const mechanism::Mechanism& mechanism, const core::Task& task)
      : mode_(mechanism::working_mode(mechanism)), task_(task) {
    if (!task.loads) models_.push_back(numeric::compile(mechanism));
    for (int end = 0; task.loads && end < 2; ++end) {
      mechanism::Mechanism loaded = mechanism;
      for (std::size_t c = 0; c < 2; ++c)
        loaded.loads.front().force[c] =
            core::Expression::number((end == 0 ? task.loads->first : task.loads->second)[c]);
      models_.push_back(numeric::compile(loaded));
    }
  }

  bool range() const { return models_.size() > 1; }
  const numeric::NumericModel& model() const { return models_.front(); }
  bool reachable(const Point2& at) const { return numeric::reachable(model(), at, mode_); }

  struct Solved {
    std::vector<Eigen::VectorXd> ends;
    double determinant = 0;
    Eigen::VectorXd at(double t) const { return (1 - t) * ends.front() + t * ends.back(); }
  };
  std::optional<Solved> solve(const Point2& at) const {
    Solved solved;
    for (const numeric::NumericModel& own : models_) {
      const numeric::Posture posture = numeric::posture(own, at, mode_);
      if (!posture.reachable()) return std::nullopt;
      const numeric::Reactions reactions = numeric::solve_reactions(own, posture);
      solved.ends.push_back(reactions.values);
      solved.determinant = reactions.determinant;
    }
    return solved;
  }

  int column(const std::string& joint, Quantity quantity) const {
    for (std::size_t j = 0; j < model().mechanism.joints.size(); ++j)
      if (model().mechanism.joints[j].name == joint) return numeric::column_of(model(), static_cast<int>(j), quantity);
    return -1;
  }
  double size(const Eigen::VectorXd& w, const core::Vanishing& reaction) const {
    for (const GuideEnds& guide : guides_of(model()))
      if (guide.joint == reaction.joint && core::is_guide_end(reaction.quantity))
        return std::abs(guide.of(w)[reaction.quantity == Quantity::end_ahead ? 0 : 1]) / 2;
    if (reaction.quantity != Quantity::f) return std::abs(w(column(reaction.joint, reaction.quantity)));
    return std::hypot(w(column(reaction.joint, Quantity::fx)), w(column(reaction.joint, Quantity::fy)));
  }
  double load_of(const Point2& load) const {
    const core::LoadRange& range = *task_.loads;
    const double fx = core::to_double(range.first[0]), fy = core::to_double(range.first[1]);
    const double dx = core::to_double(range.second[0]) - fx, dy = core::to_double(range.second[1]) - fy;
    const double length2 = dx * dx + dy * dy;
    return length2 > 0 ? ((load[0] - fx) * dx + (load[1] - fy) * dy) / length2 : 0;
  }

 private:
  std::vector<int> mode_;
  const core::Task& task_;
  std::vector<numeric::NumericModel> models_;
};

bool is_actuators(Quantity q) { return q == Quantity::M || q == Quantity::F; }

/// Columns of reactions that are zero whatever the pose and the load: not asked for.
std::vector<bool> never_loaded(const std::vector<Oracle::Solved>& samples) {
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

void expect_no_contradiction(std::mt19937& random, const Oracle& oracle, const core::Task& task,
                             const Verification& result, int poses) {
  const loci::TaskRegion region(task.shape);
  const core::Polyline outline = core::outline(task.shape);
  EXPECT_GE(result.margin, core::to_double(task.margin));
  std::vector<Oracle::Solved> solved;
  std::vector<Point2> places = region.samples();
  for (int s = 0; s < poses; ++s) places.push_back(pose_of(random, region, outline, result.margin));
  for (const Point2& at : places) {
    const auto own = oracle.solve(at);
    ASSERT_TRUE(own) << "out of reach at " << at[0] << " " << at[1];
    solved.push_back(*own);
  }
  const std::vector<bool> zero = never_loaded(solved);
  const double force = task.min_force ? core::to_double(*task.min_force) : 0;
  const double couple = task.min_couple ? core::to_double(*task.min_couple) : 0;
  const auto& unknowns = oracle.model().unknowns;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    SCOPED_TRACE(fmt::format("at {:.17g}, {:.17g}", places[i][0], places[i][1]));
    EXPECT_GT(solved[i].determinant * solved.front().determinant, 0);
    for (const GuideEnds& guide : guides_of(oracle.model())) {
      if (zero[static_cast<std::size_t>(guide.normal)] && zero[static_cast<std::size_t>(guide.tilt)]) continue;
      for (const auto& load : solved[i].ends)
        for (const std::size_t end : {0u, 1u}) {
          EXPECT_GT(guide.of(load)[end] * guide.of(solved.front().ends.front())[end], 0) << "end of " << guide.joint;
          EXPECT_GE(std::abs(guide.of(load)[end]) / 2, force * (1 - 1e-9)) << "end of " << guide.joint;
        }
    }
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      const Quantity q = unknowns[k].quantity;
      const std::string name = oracle.model().mechanism.joints[static_cast<std::size_t>(unknowns[k].joint)].name;
      if (is_actuators(q) && !zero[k])
        for (const auto& end : solved[i].ends) {
          EXPECT_GT(end(c) * solved.front().ends.front()(c), 0) << core::to_string(q) << " " << name;
          const double least = q == Quantity::M ? couple * (1 - 1e-9) : 0.0;
          EXPECT_GE(std::abs(end(c)), least) << name;
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
        EXPECT_GE(least, force * (1 - 1e-9)) << "f " << name;
        EXPECT_GT(least, 1e-12 * a.norm()) << "f " << name;
      }
    }
  }
  // A force that turns over between two close poses has vanished between them.
  for (std::size_t i = 0; result.margin > 0 && i < 60; ++i) {
    const Point2 base = region.closest(pose_of(random, region, outline, 0));
    const double angle = 0.1 * static_cast<double>(random() % 63);
    Point2 p = base, q = {base[0] + result.margin * (1 - 1e-9) * std::cos(angle),
                          base[1] + result.margin * (1 - 1e-9) * std::sin(angle)};
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      if (unknowns[k].quantity != Quantity::fx || (zero[k] && zero[k + 1])) continue;
      const auto c = static_cast<Eigen::Index>(k);
      Point2 from = p, to = q;
      bool turned = true;
      for (int step = 0; step < 34 && turned; ++step) {
        const Point2 middle = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
        const auto f = oracle.solve(from), m = oracle.solve(middle), t = oracle.solve(to);
        ASSERT_TRUE(f && m && t);
        const auto cosine = [&](const Oracle::Solved& u, const Oracle::Solved& v) {
          const Eigen::Vector2d a = u.ends.front().segment<2>(c), b = v.ends.front().segment<2>(c);
          return a.dot(b) / (a.norm() * b.norm());
        };
        turned = cosine(*f, *t) < -0.5;
        (cosine(*f, *m) < cosine(*m, *t) ? to : from) = middle;
      }
      EXPECT_FALSE(turned) << "f turns over at " << from[0] << " " << from[1];
    }
  }
}

void expect_confirmed(const Oracle& oracle, const core::Task& task, const TaskWitness& witness) {
  SCOPED_TRACE(
      fmt::format("witness ({:.17g}, {:.17g}): {}", witness.at[0], witness.at[1], report::witness_words(witness)));
  const loci::TaskRegion region(task.shape);
  EXPECT_LE(region.signed_distance(witness.at), std::max(core::to_double(task.margin), 1e-14));
  const auto around = [&](double step) {
    std::vector<Point2> list = {witness.at};
    for (int i = 0; i < 8; ++i)
      list.push_back({witness.at[0] + step * std::cos(i * M_PI / 4), witness.at[1] + step * std::sin(i * M_PI / 4)});
    return list;
  };
  const auto here = oracle.solve(witness.at);
  if (witness.vanishing.empty() && witness.too_small.empty()) {
    // Out of reach, or there is both within and out of reach; or |A| has both signs.
    int reached = 0, positive = 0;
    const std::vector<Point2> near = around(1e-8);
    for (const Point2& p : near) {
      const auto own = oracle.solve(p);
      if (own) ++reached, positive += own->determinant > 0 ? 1 : 0;
    }
    const int all = static_cast<int>(near.size());
    const bool nearly_singular = here && std::abs(here->determinant) < 1e-12;
    EXPECT_TRUE(!here || reached < all || (positive > 0 && positive < all) || nearly_singular);
    return;
  }
  ASSERT_TRUE(here);
  const double t = witness.load ? oracle.load_of(*witness.load) : 0;
  EXPECT_GE(t, -1e-12);
  EXPECT_LE(t, 1 + 1e-12);
  const Eigen::VectorXd w = here->at(t);
  for (const core::Vanishing& reaction : witness.too_small) {
    const auto& least = reaction.quantity == Quantity::M ? task.min_couple : task.min_force;
    ASSERT_TRUE(least);
    EXPECT_LT(oracle.size(w, reaction), core::to_double(*least));
  }
  for (const core::Vanishing& reaction : witness.vanishing) {
    double usual = w.cwiseAbs().maxCoeff();
    for (const auto& end : here->ends) usual = std::max(usual, end.cwiseAbs().maxCoeff());
    EXPECT_LE(oracle.size(w, reaction), 1e-9 * usual);
  }
}

TEST(VerifySampling, IsNeverContradicted) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = wanted != nullptr ? std::atoi(wanted) : 70;
  const char* seed = std::getenv("CLEARLOCI_SEED");
  const char* dump = std::getenv("CLEARLOCI_DUMP");  // a folder for the models and tasks
  std::map<Verdict, int> counts;
  std::vector<double> times;
  int refused = 0;
  for (int i = 0; i < designs; ++i) {
    std::mt19937 random((seed != nullptr ? static_cast<unsigned>(std::atoi(seed)) : 20110579U) +
                        static_cast<unsigned>(i));
    const int kind = i % test::task_design_kinds;
    const bool lattice = (i / test::task_design_kinds) % 2 == 0;
    const std::string text = test::random_design(random, kind, lattice);
    std::string own;
    mechanism::Mechanism mechanism;
    std::optional<core::Task> task;
    std::optional<Verification> result;
    SCOPED_TRACE(fmt::format("design {}\n{}", i, text));
    try {
      mechanism = mechanism::parse_mechanism(text, "random.yaml");
      const auto shape = test::random_shape(random, mechanism, lattice);
      if (!shape) {
        ++refused;
        continue;
      }
      own = "format: 1\n" + *shape;
      own += test::random_wishes(random, mechanism, mechanism::parse_task(own, "task.yaml", mechanism).shape, lattice);
      task = mechanism::parse_task(own, "task.yaml", mechanism);
      if (dump != nullptr) {
        std::ofstream(fmt::format("{}/{}.yaml", dump, i)) << text;
        std::ofstream(fmt::format("{}/{}_task.yaml", dump, i)) << own << "\n";
      }
      const auto start = std::chrono::steady_clock::now();
      result = decide_task(mechanism, *task, {});
      times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    } catch (const core::InputError&) {
      ++refused;  // a polygon that crosses itself, a mechanism that is singular in every pose
      continue;
    }
    SCOPED_TRACE(own);
    ++counts[result->verdict];
    if (wanted != nullptr)
      fmt::print("{} kind {} {} {} {:.2f} s{}\n", i, kind, lattice ? "lattice" : "general", to_string(result->verdict),
                 times.back(), result->witness ? " " + report::witness_words(*result->witness) : "");
    const Oracle oracle(mechanism, *task);
    EXPECT_EQ(result->witness.has_value(), result->verdict == Verdict::refuted);
    EXPECT_EQ(result->open.has_value(), result->verdict == Verdict::undecided);
    if (result->verified()) expect_no_contradiction(random, oracle, *task, *result, 300);
    if (result->witness) expect_confirmed(oracle, *task, *result->witness);
  }
  std::sort(times.begin(), times.end());
  if (!times.empty())
    fmt::print(
        "{} verified, {} refuted, {} undecided, {} refused; median {:.3f} s, 9 of 10 in {:.3f} s, longest {:.1f} s\n",
        counts[Verdict::verified], counts[Verdict::refuted], counts[Verdict::undecided], refused,
        times[times.size() / 2], times[times.size() * 9 / 10], times.back());
  EXPECT_GT(counts[Verdict::verified], designs / 10);
  EXPECT_GT(counts[Verdict::refuted], designs / 10);
  EXPECT_LT(5 * counts[Verdict::undecided], designs);
}

}  // namespace
}  // namespace clearloci
