#include "analysis/pose_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/reduced.hpp"
#include "core/task.hpp"

namespace clearloci {
namespace {

using core::Rational;
using core::RationalPose;
using core::TaskShape;

/// Places that are looked at, for each of which a mesh has to be set up anew; those from which loci are searched, and
/// proofs that may be tried.
constexpr double most_places = 1000, most_triangles = 1e6;
constexpr std::size_t most_searched = 48, most_climbs = 4;
constexpr int most_proofs = 12, most_looks = 60;
/// Steps from a place that verifies towards the task: a thousandth of the way.
constexpr int halvings = 10;

class Placing {
 public:
  Placing(const mechanism::Mechanism& mechanism, const core::Task& task, const PoseJudge& judge)
      : mechanism_(mechanism), task_(task), judge_(judge) {
    bool any_length = false;
    for (const mechanism::Coordinate& c : mechanism.coordinates) any_length = any_length || !c.angle;
    for (const mechanism::Coordinate& c : mechanism.coordinates) {
      weights_.push_back(c.angle && task.angle_length ? *task.angle_length : Rational(1));
      moves_.push_back(!any_length || !c.angle);
    }
    bounds_ = core::bounds(task.shape, weights_);
  }

  std::optional<PlacedShape> nearest() const {
    const RationalPose none(moves_.size(), Rational(0));
    if (judge_.verified(task_.shape)) return PlacedShape{task_.shape, none, {}};
    std::vector<Place> places = good_places();
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.far < b.far; });
    // Many places beside a locus look good and are not: leaps that double come past them, and halves of the last one
    // back.
    std::size_t failed = 0, found = places.size();  // places below `failed` were passed over
    int proofs = 0;
    const auto good = [&](std::size_t i) { return judge_.verified(core::moved(task_.shape, places[i].by)); };
    const double margin = core::to_double(task_.margin);
    int looks = 0;
    for (std::size_t i = 0, leap = 1; i < places.size() && proofs < most_proofs && looks < most_looks;) {
      // Where a locus is met nearby no proof is tried.
      ++looks;
      const bool room = judge_.room(core::moved(task_.shape, places[i].by)) > margin;
      if (room && good(i)) {
        found = i;
        break;
      }
      failed = i + 1;
      if (room) ++proofs;
      i += leap;
      leap += looks % 4 == 0 ? leap : 0;
    }
    if (found == places.size()) return std::nullopt;
    while (failed < found && proofs < 2 * most_proofs) {
      const std::size_t middle = failed + (found - failed) / 2;
      ++proofs;
      if (good(middle))
        found = middle;
      else
        failed = middle + 1;
    }
    const Place& place = places[found];
    Rational part = 1, too_little = 0;
    for (int i = 0; i < halvings; ++i) {
      const Rational middle = (part + too_little) / 2;
      (judge_.verified(core::moved(task_.shape, times(middle, place.by))) ? part : too_little) = middle;
    }
    const RationalPose by = times(part, place.by);
    return PlacedShape{core::moved(task_.shape, by), by, {}};
  }

  std::optional<PlacedShape> best() const {
    const std::vector<Place> good = good_places();
    std::vector<Place> places;
    const std::size_t stride = (good.size() + most_searched - 1) / most_searched;
    for (std::size_t i = stride / 2; i < good.size(); i += stride) places.push_back(good[i]);
    for (Place& place : places) place.room = judge_.room(core::moved(task_.shape, place.by));
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.room > b.room; });
    if (places.size() > most_climbs) places.resize(most_climbs);
    for (Place& place : places) climb(place);
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.room > b.room; });
    for (const Place& place : places) {
      const TaskShape shape = core::moved(task_.shape, place.by);
      if (judge_.verified(shape)) return PlacedShape{shape, place.by, {}};
    }
    return std::nullopt;
  }

  std::optional<PlacedShape> largest() const {
    RationalPose middle;
    for (std::size_t c = 0; c < moves_.size(); ++c) middle.push_back((bounds_[0][c] + bounds_[1][c]) / 2);
    const auto shape_of = [&](const Rational& factor) { return core::placed(task_.shape, middle, factor, middle); };
    const auto good = [&](const Rational& factor) {
      const TaskShape shape = shape_of(factor);
      return fits(core::bounds(shape, weights_)) && judge_.verified(shape);
    };
    // Between a scale that verifies and one that does not, or leaves the box.
    constexpr int most_doublings = 10;
    Rational scale = 1, too_much = 1;
    if (good(scale)) {
      for (int i = 0; i < most_doublings && scale == too_much; ++i)
        if (good(too_much *= 2)) scale = too_much;
      if (scale == too_much) return PlacedShape{shape_of(scale), {}, scale};
    } else {
      int i = 0;
      for (scale /= 2; !good(scale); scale /= 2, ++i) {
        if (i == most_doublings) return std::nullopt;
        too_much = scale;
      }
    }
    while (too_much > scale * Rational(101, 100)) {
      const Rational between = (scale + too_much) / 2;
      (good(between) ? scale : too_much) = between;
    }
    return PlacedShape{shape_of(scale), {}, scale};
  }

 private:
  struct Place {
    RationalPose by;
    double far = 0, room = 0;
  };

  static RationalPose times(const Rational& factor, RationalPose pose) {
    for (Rational& value : pose) value *= factor;
    return pose;
  }

  bool fits(const std::array<RationalPose, 2>& bounds) const {
    for (std::size_t c = 0; c < moves_.size(); ++c) {
      const mechanism::Coordinate& coordinate = mechanism_.coordinates[c];
      if (bounds[0][c] < coordinate.lower || bounds[1][c] > coordinate.upper) return false;
    }
    return true;
  }

  bool fits(const RationalPose& by) const {
    std::array<RationalPose, 2> bounds = bounds_;
    for (RationalPose& corner : bounds)
      for (std::size_t c = 0; c < by.size(); ++c) corner[c] += by[c];
    return fits(bounds);
  }

  double far(const RationalPose& by) const {
    double square = 0;
    for (std::size_t c = 0; c < by.size(); ++c) square += std::pow(core::to_double(weights_[c] * by[c]), 2);
    return std::sqrt(square);
  }

  /// Evenly over the mechanism's box, where the task looks good at some poses.
  std::vector<Place> good_places() const {
    const auto dimensions = static_cast<double>(std::count(moves_.begin(), moves_.end(), true));
    double most = most_places;
    if (const auto* mesh = std::get_if<core::TaskMesh>(&task_.shape))
      most = std::min(most, most_triangles / static_cast<double>(mesh->triangles.size()));
    const auto steps = std::max(1, static_cast<int>(std::floor(std::pow(most, 1 / dimensions))));
    std::vector<Place> places;
    std::vector<int> at(moves_.size(), 0);
    for (;;) {
      RationalPose by(moves_.size(), Rational(0));
      for (std::size_t c = 0; c < at.size(); ++c) {
        const mechanism::Coordinate& coordinate = mechanism_.coordinates[c];
        const Rational least = coordinate.lower - bounds_[0][c], greatest = coordinate.upper - bounds_[1][c];
        if (moves_[c] && greatest > least)
          by[c] = short_of(least + (greatest - least) * core::reduced(2 * at[c] + 1, 2 * steps));
      }
      if (fits(by) && judge_.looks_good(core::moved(task_.shape, by))) places.push_back({by, far(by), 0});
      std::size_t c = 0;
      while (c < at.size() && (!moves_[c] || ++at[c] == steps)) at[c++] = 0;
      if (c == at.size()) return places;
    }
  }

  /// The nearest number of 20 binary digits behind the point.
  static Rational short_of(const Rational& value) {
    constexpr double digits = 0x1p20;
    return Rational(std::nearbyint(core::to_double(value) * digits) / digits);
  }

  /// Along the coordinates while there is more room, in steps that get smaller.
  void climb(Place& place) const {
    double size = 0;
    for (const mechanism::Coordinate& coordinate : mechanism_.coordinates)
      size = std::max(size, core::to_double(coordinate.upper - coordinate.lower));
    for (double part = 1.0 / 32; part > 1e-3; part /= 2) {
      bool better = true;
      for (int round = 0; better && round < 8; ++round) {
        better = false;
        for (std::size_t c = 0; c < moves_.size(); ++c)
          for (const int sign : {1, -1}) {
            if (!moves_[c]) continue;
            Place other = place;
            other.by[c] += short_of(Rational(sign * part * size));
            if (!fits(other.by)) continue;
            const TaskShape shape = core::moved(task_.shape, other.by);
            if (!judge_.looks_good(shape)) continue;
            other.room = judge_.room(shape);
            if (!(other.room > place.room)) continue;
            place = std::move(other);
            better = true;
          }
      }
    }
  }

  const mechanism::Mechanism& mechanism_;
  const core::Task& task_;
  const PoseJudge& judge_;
  std::vector<Rational> weights_;
  std::vector<bool> moves_;
  std::array<RationalPose, 2> bounds_;
};

}  // namespace

std::optional<PlacedShape> place_shape(const mechanism::Mechanism& mechanism, const core::Task& task, TaskFit goal,
                                       const PoseJudge& judge) {
  const Placing placing(mechanism, task, judge);
  switch (goal) {
    case TaskFit::nearest:
      return placing.nearest();
    case TaskFit::best:
      return placing.best();
    case TaskFit::largest:
      return placing.largest();
    case TaskFit::none:
      break;
  }
  return std::nullopt;
}

}  // namespace clearloci
