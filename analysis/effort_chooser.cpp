#include "analysis/effort_chooser.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/idle_efforts.hpp"
#include "analysis/verification.hpp"
#include "core/rational.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci {
namespace {

using core::Rational;
using loci::pose::EffortChoice;
using loci::pose::EffortColumns;
using loci::pose::EffortStatics;
using mechanism::JointIndex;
using mechanism::Mechanism;
using PoseAt = loci::pose::Pose;

/// Of few digits: what is chosen is proven anyhow.
Rational proposed(double value) {
  const double grain = std::exp2(std::ilogb(value == 0 || !std::isfinite(value) ? 1.0 : value) - 24);
  return Rational(std::round(value / grain) * grain);
}

/// What free tensions are looked for within.
std::vector<WantedEffort> wanted_tensions(const Mechanism& mechanism, const std::vector<WantedEffort>& motors) {
  std::vector<WantedEffort> wanted;
  for (const JointIndex j : mechanism::joints_without_preload(mechanism)) {
    const mechanism::Joint& joint = mechanism.joints[static_cast<std::size_t>(j)];
    const auto motor =
        std::find_if(motors.begin(), motors.end(), [&](const auto& each) { return each.joint == joint.name; });
    if (motor != motors.end()) {
      wanted.push_back(*motor);
      continue;
    }
    const auto& [least, most] = *joint.free_effort->within;
    wanted.push_back({joint.name, joint.free_effort->parameter, true, least, most, 1 / core::to_double(most)});
  }
  return wanted;
}

/// Loads around those of the balls: of each ball a polygon about its circle, or the ends of its axes farther out.
std::vector<std::vector<double>> loads_around(const EffortStatics& statics) {
  std::vector<std::vector<double>> loads = {std::vector<double>(statics.directions(), 0.0)};
  for (const core::LoadBall& ball : statics.balls) {
    std::vector<std::vector<double>> corners;
    if (ball.count == 2) {
      constexpr int sides = 8;
      const double reach = ball.radius / std::cos(M_PI / sides);
      for (int i = 0; i < sides; ++i)
        corners.push_back({reach * std::cos(2 * M_PI * i / sides), reach * std::sin(2 * M_PI * i / sides)});
    } else {
      for (std::size_t c = 0; c < ball.count; ++c)
        for (const int sign : {1, -1}) {
          corners.emplace_back(ball.count, 0.0);
          corners.back()[c] = sign * ball.radius * std::sqrt(static_cast<double>(ball.count));
        }
    }
    std::vector<std::vector<double>> all;
    for (const std::vector<double>& load : loads)
      for (const std::vector<double>& corner : corners) {
        all.push_back(load);
        for (std::size_t c = 0; c < ball.count; ++c) all.back()[ball.first + c] = corner[c];
      }
    loads = std::move(all);
  }
  return loads;
}

/// The linear program of some places: of efforts, or of efforts under each base load and what each direction adds.
struct Proposal {
  const EffortSystem& system;
  const EffortStatics& statics;
  const std::vector<EffortColumns>& designs;
  const SignPattern& signs;
  bool knows_load;
  double most;
  using Ways = std::vector<std::vector<double>>;  ///< one a demand
  std::vector<std::vector<double>> loads = knows_load ? loads_around(statics) : std::vector<std::vector<double>>();

  std::size_t efforts() const { return statics.efforts; }
  std::size_t variables() const { return knows_load ? (statics.bases + statics.directions()) * efforts() : efforts(); }
  double limit(std::size_t k) const { return std::min(system.largest(k), most / system.wanted()[k].size_of_one); }

  struct Program {
    EffortPolytope polytope;
    std::vector<Rational> widths;
    void add(double offset, const std::vector<double>& slope, double width) {
      EffortPolytope::Row& row = polytope.rows.emplace_back();
      row.offset = proposed(offset);
      for (const double component : slope) row.slope.push_back(proposed(component));
      widths.push_back(proposed(width));
    }
  };

  /// An effort k counts so much, under a base load and a load beside it.
  std::vector<double> slope_of(const std::vector<double>& of_efforts, std::size_t base,
                               const std::vector<double>& load) const {
    if (!knows_load) return of_efforts;
    std::vector<double> slope(variables(), 0.0);
    for (std::size_t k = 0; k < efforts(); ++k) {
      slope[base * efforts() + k] = of_efforts[k];
      for (std::size_t c = 0; c < load.size(); ++c)
        slope[(statics.bases + c) * efforts() + k] = load[c] * of_efforts[k];
    }
    return slope;
  }

  void add_demand(Program& program, const std::vector<double>& along, double least) const {
    std::vector<double> of_efforts(along.begin() + static_cast<std::ptrdiff_t>(statics.bases),
                                   along.begin() + static_cast<std::ptrdiff_t>(statics.bases + efforts()));
    const std::size_t first = statics.bases + efforts();
    double beside = 0;
    for (const core::LoadBall& ball : statics.balls) {
      double square = 0;
      for (std::size_t c = ball.first; c < ball.first + ball.count; ++c) square += along[first + c] * along[first + c];
      beside += ball.radius * std::sqrt(square);
    }
    for (std::size_t base = 0; base < statics.bases; ++base) {
      double width = std::abs(along[base]) + beside;
      for (std::size_t k = 0; k < efforts(); ++k) width += std::abs(of_efforts[k]) * limit(k);
      if (!(width > 0)) width = 1;
      if (!knows_load) {
        program.add(along[base] - beside - least, of_efforts, width);
        continue;
      }
      for (const std::vector<double>& load : loads) {
        double offset = along[base] - least;
        for (std::size_t c = 0; c < load.size(); ++c) offset += load[c] * along[first + c];
        program.add(offset, slope_of(of_efforts, base, load), width);
      }
    }
  }

  void add_efforts(Program& program) const {
    const std::vector<std::vector<double>> none = {{}};
    for (std::size_t k = 0; k < efforts(); ++k) {
      const WantedEffort& wanted = system.wanted()[k];
      const double low = std::max(core::to_double(wanted.lower), -limit(k)),
                   high = std::min(core::to_double(wanted.upper), limit(k)), width = high - low;
      std::vector<double> one(efforts(), 0.0);
      const auto found = signs.find((wanted.force ? "F_" : "M_") + wanted.joint);
      for (std::size_t base = 0; base < (knows_load ? statics.bases : 1); ++base)
        for (const std::vector<double>& load : knows_load ? loads : none) {
          const auto add = [&](double sign, double offset, double wide) {
            one.assign(efforts(), 0.0);
            one[k] = sign;
            program.add(offset, slope_of(one, base, load), wide);
          };
          add(1, -low, width);
          add(-1, high, width);
          if (system.own_least(k) && found != signs.end() && found->second != 0)
            add(found->second, -*system.own_least(k), std::max(width, 1e-3));
        }
    }
  }

  std::vector<double> along_way(const EffortColumns& columns, std::size_t d, const std::vector<double>& way) const {
    std::vector<double> along(statics.statics.loads, 0.0);
    for (std::size_t k = 0; k < way.size(); ++k)
      for (std::size_t c = 0; c < along.size(); ++c) along[c] += way[k] * columns[d][k][c];
    return along;
  }

  struct Found {
    EffortChoice choice;
    Rational depth;
  };

  std::optional<Found> solved(const std::vector<Ways>& ways) const {
    Program program;
    program.polytope.efforts = variables();
    add_efforts(program);
    for (std::size_t i = 0; i < designs.size(); ++i)
      for (std::size_t d = 0; d < ways[i].size(); ++d)
        if (!ways[i][d].empty()) add_demand(program, along_way(designs[i], d, ways[i][d]), statics.leasts[d]);
    const auto deepest = program.polytope.deepest(program.widths);
    if (!deepest || deepest->depth <= 0) return std::nullopt;
    Found found{{}, deepest->depth};
    EffortChoice& choice = found.choice;
    const auto part = [&](std::size_t from) {
      std::vector<double> solved;
      for (std::size_t k = 0; k < efforts(); ++k) solved.push_back(core::to_double(deepest->at[from + k]));
      return solved;
    };
    for (std::size_t base = 0; base < statics.bases; ++base)
      choice.efforts.push_back(part(knows_load ? base * efforts() : 0));
    for (std::size_t c = 0; knows_load && c < statics.directions(); ++c)
      choice.gains.push_back(part((statics.bases + c) * efforts()));
    return found;
  }

  /// The ways of demands of several components, as they are under a choice in some designs: those of the others have a
  /// sign.
  Ways ways_under(const EffortChoice* choice, std::size_t from, std::size_t to) const {
    Ways ways;
    for (std::size_t d = 0; d < statics.demands.size(); ++d) {
      std::vector<double>& way = ways.emplace_back();
      const std::size_t parts = statics.demands[d].components.size();
      if (const int sign = sign_of(statics.demands[d], signs); sign != 0) way = {static_cast<double>(sign)};
      if (choice == nullptr || parts == 1) continue;
      way.assign(parts, 0.0);
      for (std::size_t i = from; i < to; ++i)
        for (std::size_t k = 0; k < parts; ++k)
          for (std::size_t base = 0; base < statics.bases; ++base) {
            way[k] += designs[i][d][k][base];
            for (std::size_t j = 0; j < efforts(); ++j)
              way[k] += choice->efforts[base][j] * designs[i][d][k][statics.bases + j];
          }
      double square = 0;
      for (const double component : way) square += component * component;
      for (double& component : way) component = square > 0 ? component / std::sqrt(square) : 0;
      if (!(square > 0)) way.front() = 1;
    }
    return ways;
  }

  /// Of every design its own.
  std::vector<Ways> ways_of_each(const EffortChoice* choice) const {
    std::vector<Ways> all;
    for (std::size_t i = 0; i < designs.size(); ++i) all.push_back(ways_under(choice, i, i + 1));
    return all;
  }

  /// From a choice the ways of forces of several components, and from these another choice.
  std::optional<Found> from(const EffortChoice& begin) const {
    std::optional<Found> found;
    constexpr int rounds = 3;  // each turns the ways towards what it finds
    auto ways = ways_of_each(&begin);
    for (int i = 0; i < rounds; ++i) {
      auto next = solved(ways);
      if (!next) break;
      found = std::move(next);
      auto turned = ways_of_each(&found->choice);
      if (turned == ways) break;
      ways = std::move(turned);
    }
    return found;
  }

  /// Whether all forces of several components are well above their least at the places, along their ways there.
  bool is_clear_of_forces(const EffortChoice& choice) const {
    constexpr double well = 0.1;
    for (std::size_t i = 0; i < designs.size(); ++i) {
      const Ways ways = ways_under(&choice, i, i + 1);
      for (std::size_t d = 0; d < ways.size(); ++d) {
        if (ways[d].size() < 2) continue;
        const std::vector<double> along = along_way(designs[i], d, ways[d]);
        double beside = 0;
        for (const core::LoadBall& ball : statics.balls) {
          double square = 0;
          for (std::size_t c = ball.first; c < ball.first + ball.count; ++c) {
            double part = along[statics.bases + efforts() + c];
            for (std::size_t k = 0; k < efforts() && knows_load; ++k)
              part += choice.gains[c][k] * along[statics.bases + k];
            square += part * part;
          }
          beside += ball.radius * std::sqrt(square);
        }
        for (std::size_t base = 0; base < statics.bases; ++base) {
          double value = along[base];
          for (std::size_t k = 0; k < efforts(); ++k) value += choice.efforts[base][k] * along[statics.bases + k];
          if (!(value - beside - statics.leasts[d] > well * (beside + statics.leasts[d]))) return false;
        }
      }
    }
    return true;
  }

  /// `thorough`: forces have other ways from the ends of each effort, so that what is found from there may be deeper.
  std::optional<EffortChoice> best(bool thorough) const {
    const auto alone = solved(ways_of_each(nullptr));
    if (!alone) return std::nullopt;
    const bool all_signed = std::all_of(statics.demands.begin(), statics.demands.end(),
                                        [](const auto& demand) { return demand.components.size() == 1; });
    if (all_signed || (!thorough && is_clear_of_forces(alone->choice))) return alone->choice;
    std::optional<Found> best = from(alone->choice);
    EffortChoice begin = alone->choice;
    for (std::size_t k = 0; k < efforts(); ++k)
      for (const int sign : {1, -1}) {
        if (best && !thorough) return best->choice;
        begin.efforts.assign(statics.bases, std::vector<double>(efforts(), 0.0));
        for (std::vector<double>& effort : begin.efforts) effort[k] = sign * limit(k);
        auto found = from(begin);
        if (found && (!best || found->depth > best->depth)) best = std::move(found);
      }
    return best ? std::optional(best->choice) : std::nullopt;
  }
};

}  // namespace

std::optional<EffortChoice> deep_choice(const EffortSystem& system, const std::vector<EffortColumns>& places,
                                        const SignPattern& signs, bool knows_load, double most_size) {
  const Proposal proposal{system, system.statics(), places, signs, knows_load, most_size};
  auto choice = proposal.best(places.size() > 1);
  if (choice) choice->ways = proposal.ways_under(&*choice, 0, places.size());
  return choice;
}

EffortSystems::EffortSystems(const Mechanism& mechanism, const std::vector<WantedEffort>& wanted,
                             const core::Task& task, DyadSides sides, const LociRequest& request)
    : mechanism_(mechanism), wanted_(wanted), task_(task), sides_(std::move(sides)), request_(request) {}

EffortSystem* EffortSystems::at(const PoseAt& pose) {
  std::vector<JointIndex> free = mechanism::joints_without_preload(mechanism_);
  const bool cables = std::any_of(free.begin(), free.end(), [&](JointIndex j) {
    return mechanism::is_cable(mechanism_.joints[static_cast<std::size_t>(j)]);
  });
  // Under a load that is not known it matters which tensions are held: those that the mechanism says.
  const bool held = !task_.knows_load && (task_.loads || !task_.loads_within.empty() || !task_.tolerances.empty());
  if (cables && !held) {
    const auto best = mechanism::best_free_cables(mechanism_, pose);
    if (!best) return nullptr;
    free = *best;
  }
  std::unique_ptr<EffortSystem>& system = all_[free];
  if (system) return system.get();
  Mechanism chosen = mechanism_;
  if (cables) mechanism::set_free_cables(chosen, free);
  system = std::make_unique<EffortSystem>(chosen, wanted_tensions(chosen, wanted_), task_, sides_, request_);
  by_statics_[&system->statics()] = system.get();
  return system.get();
}

std::optional<core::TaskWitness> EffortSystems::unreachable(const PoseAt& pose) const {
  const Mechanism loaded = with_idle_efforts(mechanism_);
  const numeric::NumericModel model = numeric::compile(loaded);
  const numeric::TaskWitness check({{&model}, {}, {}}, sides_, {}, {pose},
                                   numeric::TaskWitness::Rounding::of_coordinates);
  const auto failure = check.failure(pose, false);
  if (!failure || failure->kind != numeric::TaskFailure::Kind::unreachable) return std::nullopt;
  return told_failure(loaded, model, pose, sides_, *failure);
}

const EffortStatics* PatternChooser::statics_at(const PoseAt& pose) {
  const EffortSystem* const system = systems_.at(pose);
  return system == nullptr ? nullptr : &system->statics();
}

std::optional<EffortChoice> PatternChooser::choose(const EffortStatics& statics,
                                                   const std::vector<EffortColumns>& designs) {
  return deep_choice(systems_.of(statics), designs, signs_, systems_.task().knows_load, most_);
}

EffortChoice PatternChooser::turned(const EffortStatics& statics, const std::vector<EffortColumns>& designs,
                                    const EffortChoice& choice) {
  const Proposal proposal{systems_.of(statics), statics, designs, signs_, systems_.task().knows_load, most_};
  EffortChoice effort_choice = choice;
  effort_choice.ways = proposal.ways_under(&choice, 0, designs.size());
  return effort_choice;
}

bool PatternChooser::is_refuted_by(const EffortSystem& system, const std::vector<EffortInequality>& rows) {
  if (auto excluded_rows = excluded(system, rows)) {
    exclusion = std::move(excluded_rows);
    excluding = &system;
    return true;
  }
  auto smallest = smallest_efforts(system, rows);
  if (smallest && smallest->size > needed) {
    needed = smallest->size;
    below_needed = std::move(smallest->below);
    needing = &system;
  }
  return needed > most_;
}

bool PatternChooser::refutes(const PoseAt& pose) {
  const EffortSystem* const system = systems_.at(pose);
  const std::vector<PoseAt> places = system == nullptr ? std::vector<PoseAt>() : system->places(pose);
  if (system == nullptr || !system->rows(places.front(), {})) {
    unreachable = systems_.unreachable(pose);
    return unreachable.has_value();
  }
  if (!systems_.task().knows_load) {
    const auto rows = all_rows(*system, places, signs_);
    return rows && is_refuted_by(*system, *rows);
  }
  for (const EffortSystem::OneLoad& load : system->extreme_loads(places.front(), signs_)) {
    const auto rows = all_rows(*system, places, signs_, load);
    if (rows && is_refuted_by(*system, *rows)) return true;
  }
  return false;
}

}  // namespace clearloci
