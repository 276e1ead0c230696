// Which frame a mechanism is seen in (mechanism/frame.hpp).
#include <algorithm>
#include <cmath>
#include <set>

#include "mechanism/frame.hpp"
#include "mechanism/free_polynomial.hpp"

namespace clearloci::mechanism {
namespace {

/// A free length that is a coordinate of a place: of a point that the file puts at `offset` + the length.
struct Placing {
  std::size_t coordinate = 0;
  Rational offset;
};

/// 0 of 0.
std::size_t digits_of(const Rational& value) {
  if (value == 0) return 0;
  return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
}

Rational power_of_two(int exponent) {
  const Rational one = 1;
  return exponent < 0 ? Rational(one >> static_cast<unsigned>(-exponent))
                      : Rational(one << static_cast<unsigned>(exponent));
}

/// The k with 2^k <= value < 2^(k + 1), of a positive one.
int exponent_of(const Rational& value) {
  int k = static_cast<int>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
          static_cast<int>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
  if (power_of_two(k) > value) --k;
  return k;
}

/// The multiple of `step` next to a value.
Rational rounded(const Rational& value, const Rational& step) {
  const Rational ratio = value / step + Rational(1, 2);
  core::Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), ratio.get_num_mpz_t(), ratio.get_den_mpz_t());
  return Rational(whole) * step;
}

class Choice {
 public:
  explicit Choice(const Mechanism& mechanism) : mechanism_(mechanism), dimension_(dimension(mechanism)) {
    file_.from.resize(mechanism.coordinates.size());
    for (std::size_t p = 0; p < mechanism.points.size(); ++p) {
      const auto* const form = std::get_if<ExplicitPoint>(&mechanism.points[p].form);
      if (form == nullptr) continue;
      if (static_cast<PointIndex>(p) == mechanism.end_effector_point) end_effector_ = places_.size();
      std::vector<FreePolynomial>& place = places_.emplace_back();
      for (const Expression& coordinate : form->coordinates) place.push_back(polynomial(coordinate));
    }
    for (std::size_t i = 0; i < dimension_; ++i) placing_.push_back(placing_along(i));
  }

  Frame run() const {
    Frame frame = file_;
    const std::vector<Rational> origin = origin_of_few_digits();
    std::copy(origin.begin(), origin.end(), frame.origin.begin());
    const int exponent = size_exponent(origin);
    const Rational size = power_of_two(exponent);
    if (std::abs(exponent) > usual_exponents) frame.scale = size;
    for (std::size_t q = 0; q < mechanism_.coordinates.size(); ++q) {
      const Coordinate& coordinate = mechanism_.coordinates[q];
      if (coordinate.angle) continue;
      const auto found = std::find_if(placing_.begin(), placing_.end(),
                                      [&](const auto& placing) { return placing && placing->coordinate == q; });
      if (found != placing_.end()) {
        frame.from[q] = origin[static_cast<std::size_t>(found - placing_.begin())] - (*found)->offset;
        continue;
      }
      // Of a length along something: that of the file while it is not long.
      constexpr int long_sizes = 4;
      const Rational middle = (coordinate.lower + coordinate.upper) / 2;
      if (abs(middle) > long_sizes * size) frame.from[q] = rounded(middle, size);
    }
    return frame;
  }

  Rational size() const { return power_of_two(size_exponent(origin_of_few_digits())); }

  bool far() const {
    constexpr int near_sizes = 4;
    const Frame frame = run();
    const std::vector<Rational> origin(frame.origin.begin(), frame.origin.begin() + static_cast<long>(dimension_));
    const Rational size = power_of_two(size_exponent(origin));
    const auto beyond = [&](const Rational& way) { return abs(way) > near_sizes * size; };
    return frame.scale != 1 || std::any_of(origin.begin(), origin.end(), beyond) ||
           std::any_of(frame.from.begin(), frame.from.end(), beyond);
  }

 private:
  static constexpr int usual_exponents = 6;

  FreePolynomial polynomial(const Expression& expression) const {
    return free_polynomial(expression, mechanism_, file_, Parameters::valued);
  }

  /// A length that is what points have along axis i but for a constant: that of the end effector if it is one of them,
  /// else of the point from which the others differ by the fewest digits.
  std::optional<Placing> placing_along(std::size_t i) const {
    for (std::size_t q = 0; q < mechanism_.coordinates.size(); ++q) {
      if (mechanism_.coordinates[q].angle) continue;
      if (std::any_of(placing_.begin(), placing_.end(),
                      [&](const auto& other) { return other && other->coordinate == q; }))
        continue;
      const FreePolynomial length = FreePolynomial::atom(Expression::symbol(mechanism_.coordinates[q].name));
      std::set<Rational> offsets;
      for (std::size_t p = 0; p < places_.size(); ++p) {
        const Rational constant = places_[p][i].constant();
        if ((places_[p][i] + FreePolynomial(-constant)).terms() != length.terms()) continue;
        if (p == end_effector_) return Placing{q, constant};
        offsets.insert(constant);
      }
      const auto digits_from = [&](const Rational& one) {
        std::size_t sum = 0;
        for (const Rational& other : offsets) sum += digits_of(other - one);
        return sum;
      };
      if (offsets.empty()) continue;
      return Placing{q, *std::min_element(offsets.begin(), offsets.end(), [&](const Rational& a, const Rational& b) {
                       return digits_from(a) < digits_from(b);
                     })};
    }
    return std::nullopt;
  }

  Rational middle_along(std::size_t i) const {
    const Coordinate& coordinate = mechanism_.coordinates[placing_[i]->coordinate];
    return (coordinate.lower + coordinate.upper) / 2 + placing_[i]->offset;
  }

  /// Coordinates that the origin could have along an axis, ascending.
  std::vector<Rational> candidates(std::size_t i) const {
    constexpr std::size_t most = 8;
    std::set<Rational> values;
    for (const std::vector<FreePolynomial>& place : places_)
      if (place[i].is_constant()) values.insert(place[i].constant());
    if (placing_[i]) values.insert(middle_along(i));
    if (values.empty())
      for (const std::vector<FreePolynomial>& place : places_) values.insert(place[i].constant());
    std::vector<Rational> list(values.begin(), values.end());
    if (list.size() > most) list.resize(most);
    if (list.empty()) list.emplace_back(0);
    return list;
  }

  /// Of the fixed points' coordinates and of their squared distances from the origin, and of the box.
  std::size_t digits(const std::vector<Rational>& origin) const {
    std::size_t sum = 0;
    for (const std::vector<FreePolynomial>& place : places_) {
      Rational square = 0;
      for (std::size_t i = 0; i < dimension_; ++i) {
        if (!place[i].is_constant()) continue;
        const Rational way = place[i].constant() - origin[i];
        sum += digits_of(way);
        square += way * way;
      }
      sum += digits_of(square);
    }
    for (std::size_t i = 0; i < dimension_; ++i) {
      if (!placing_[i]) continue;
      const Coordinate& coordinate = mechanism_.coordinates[placing_[i]->coordinate];
      for (const Rational& side : {coordinate.lower, coordinate.upper})
        sum += digits_of(side + placing_[i]->offset - origin[i]);
    }
    return sum;
  }

  /// The first in the order of coordinates where several have the fewest.
  std::vector<Rational> origin_of_few_digits() const {
    std::vector<std::vector<Rational>> along;
    for (std::size_t i = 0; i < dimension_; ++i) along.push_back(candidates(i));
    std::vector<std::size_t> at(dimension_, 0);
    std::vector<Rational> best;
    std::size_t fewest = 0;
    for (bool more = true; more;) {
      std::vector<Rational> origin;
      for (std::size_t i = 0; i < dimension_; ++i) origin.push_back(along[i][at[i]]);
      const std::size_t origin_digits = digits(origin);
      if (best.empty() || origin_digits < fewest) {
        fewest = origin_digits;
        best = std::move(origin);
      }
      std::size_t i = dimension_;
      while (i > 0 && ++at[i - 1] == along[i - 1].size()) at[--i] = 0;
      more = i > 0;
    }
    return best;
  }

  /// Of the largest length; without lengths, of half the width of the box.
  int size_exponent(const std::vector<Rational>& origin) const {
    Rational largest = 0;
    const auto grow = [&](const Rational& length) { largest = std::max(largest, Rational(abs(length))); };
    const auto constant = [&](const Expression& length) { grow(polynomial(length).constant()); };
    for (const std::vector<FreePolynomial>& place : places_)
      for (std::size_t i = 0; i < dimension_; ++i)
        if (place[i].is_constant()) grow(place[i].constant() - origin[i]);
    for (const Point& point : mechanism_.points) {
      if (const auto* dyad = std::get_if<DyadPoint>(&point.form))
        constant(dyad->from_length), constant(dyad->to_length);
      if (const auto* offset = std::get_if<OffsetPoint>(&point.form)) constant(offset->along), constant(offset->left);
      if (const auto* slider = std::get_if<SliderPoint>(&point.form)) constant(slider->length);
    }
    for (const Group& group : mechanism_.groups)
      for (const Group::Distance& distance : group.distances) constant(distance.length);
    if (largest == 0)
      for (const Coordinate& coordinate : mechanism_.coordinates)
        if (!coordinate.angle) grow((coordinate.upper - coordinate.lower) / 2);
    return largest == 0 ? 0 : exponent_of(largest);
  }

  const Mechanism& mechanism_;
  std::size_t dimension_;
  Frame file_;                                       ///< that of the file
  std::vector<std::vector<FreePolynomial>> places_;  ///< of the explicit points
  std::optional<std::size_t> end_effector_;          ///< among them
  std::vector<std::optional<Placing>> placing_;      ///< one an axis
};

}  // namespace

Frame frame_of(const Mechanism& mechanism) {
  try {
    return Choice(mechanism).run();
  } catch (const NotPolynomial&) {
    Frame usual;
    usual.from.resize(mechanism.coordinates.size());
    return usual;
  }
}

Rational size_of(const Mechanism& mechanism) {
  try {
    return Choice(mechanism).size();
  } catch (const NotPolynomial&) {
    return 1;
  }
}

bool is_far(const Mechanism& mechanism) {
  try {
    return Choice(mechanism).far();
  } catch (const NotPolynomial&) {
    return false;
  }
}

}  // namespace clearloci::mechanism
