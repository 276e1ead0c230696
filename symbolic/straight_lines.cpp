#include "symbolic/straight_lines.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "core/powers_of_two.hpp"

namespace clearloci::symbolic {

using core::Polynomial;
using core::Rational;
using core::StraightLine;

StraightLines::StraightLines(const Geometry& geometry) : geometry_(&geometry) {
  // Free coordinates and roots are the tower's own variables, in its order.
  const std::vector<int> tower_variables = geometry.tower_variables();
  for (const TowerRoot& root : geometry.roots())
    for (const TowerRoot& below : geometry.roots()) is_nested_ = is_nested_ || root.square.depends_on(below.variable);
  for (std::size_t i = 0; i < tower_variables.size(); ++i)
    known_[tower_variables[i]] = builder_.variable(static_cast<int>(i));
}

void StraightLines::know(const std::vector<DeterminantForm>& forms) {
  forms_.insert(forms_.end(), forms.begin(), forms.end());
}

StraightLine StraightLines::of(const Poly& natural) { return builder_.line(scaled_value(natural, 0)); }

StraightLine StraightLines::of(const Poly& natural, mechanism::PointIndex dyad_point, const Rational& above) {
  const std::optional<Dyad> ends = dyad(dyad_point);
  if (!ends) return {};
  const int variable = geometry_->auxiliary();
  const auto before = known_.find(variable);
  const std::optional<int> kept = before == known_.end() ? std::nullopt : std::optional(before->second);
  known_[variable] = builder_.multiply(builder_.constant(above), builder_.inverse(ends->distance2));
  StraightLine line = of(natural);
  if (kept)
    known_[variable] = *kept;
  else
    known_.erase(variable);
  return line;
}

/// With coefficients in the range of doubles, times 2^exponent.
int StraightLines::scaled_value(const Poly& natural, long exponent) {
  const Polynomial plain = natural.plain();
  Polynomial scaled = core::scaled_for_doubles(plain);
  for (core::Term& term : scaled.terms) term.coefficient = core::times_power_of_two(term.coefficient, exponent);
  const auto form =
      std::find_if(forms_.begin(), forms_.end(), [&](const DeterminantForm& f) { return f.value == natural; });
  if (form == forms_.end()) return scaled_value_by_ways(natural, scaled);
  return determinant(*form, scaled.terms.front().coefficient / plain.terms.front().coefficient);
}

namespace {

/// Of the last rows, expanded along the first of them.
class Minors {
 public:
  Minors(core::StraightLineBuilder& builder, const std::vector<std::vector<int>>& rows)
      : builder_(builder), rows_(rows) {}

  int of(unsigned columns) {
    if (columns == 0) return builder_.constant(1);
    if (const auto found = known_.find(columns); found != known_.end()) return found->second;
    const std::vector<int>& row = rows_[rows_.size() - static_cast<std::size_t>(std::popcount(columns))];
    int sum = builder_.constant(0);
    bool plus = true;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if ((columns >> j & 1U) == 0) continue;
      if (row[j] != builder_.constant(0)) {
        const int product = builder_.multiply(row[j], of(columns & ~(1U << j)));
        sum = plus ? builder_.add(sum, product) : builder_.subtract(sum, product);
      }
      plus = !plus;
    }
    return known_[columns] = sum;
  }

 private:
  core::StraightLineBuilder& builder_;
  const std::vector<std::vector<int>>& rows_;
  std::map<unsigned, int> known_;
};

/// The power of two that takes the largest coefficient of some entries next to 1.
long exponent_of(const std::vector<Polynomial*>& entries) {
  Rational largest = 0;
  for (const Polynomial* entry : entries)
    for (const core::Term& term : entry->terms) largest = std::max(largest, Rational(abs(term.coefficient)));
  return largest == 0 ? 0 : core::binary_exponent(largest);
}

}  // namespace

/// scale · the form's value. Columns and rows are brought to the range of doubles first.
int StraightLines::determinant(const DeterminantForm& form, const Rational& scale) {
  const std::size_t size = form.rows.size();
  std::vector<std::vector<Polynomial>> entries(size);
  for (std::size_t i = 0; i < size; ++i)
    for (const Poly& entry : form.rows[i]) entries[i].push_back(entry.plain());
  long taken = 0;
  const auto take = [&taken](const std::vector<Polynomial*>& line) {
    const long exponent = exponent_of(line);
    for (Polynomial* entry : line)
      for (core::Term& term : entry->terms) term.coefficient = core::times_power_of_two(term.coefficient, -exponent);
    taken += exponent;
  };
  for (const bool columns : {true, false})
    for (std::size_t i = 0; i < size; ++i) {
      std::vector<Polynomial*> line;
      for (std::size_t j = 0; j < size; ++j) line.push_back(columns ? &entries[j][i] : &entries[i][j]);
      take(line);
    }
  std::vector<std::vector<int>> rows(size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) rows[i].push_back(scaled_value_by_ways(form.rows[i][j], entries[i][j]));
  const Rational constant = core::times_power_of_two(form.constant * scale, taken);
  return builder_.multiply(builder_.constant(constant), Minors(builder_, rows).of((1U << size) - 1));
}

StraightLine StraightLines::of(const Rational& constant, const std::vector<PolyFactor>& factors) {
  // Coefficients in the range of doubles, by powers of two that the constant takes back. What it would be beyond that
  // range by, the factors share: their values are as far beyond it the other way.
  Rational scale = constant;
  long count = 0;
  for (const PolyFactor& factor : factors) {
    const Polynomial plain = factor.poly.plain();
    const Rational gained = core::scaled_for_doubles(plain).terms.front().coefficient / plain.terms.front().coefficient;
    for (int i = 0; i < factor.multiplicity; ++i, ++count) scale /= gained;
  }
  constexpr long within_doubles = 256;
  const long exponent = scale == 0 ? 0 : core::binary_exponent(scale);
  const long share = count > 0 && std::abs(exponent) > within_doubles ? exponent / count : 0;
  scale = core::times_power_of_two(scale, -share * count);
  int product = builder_.constant(scale);
  for (const PolyFactor& factor : factors)
    product = builder_.multiply(product, builder_.power(scaled_value(factor.poly, share), factor.multiplicity));
  return builder_.line(product);
}

StraightLine StraightLines::over_roots(const Poly& sheet) {
  return builder_.line(value(core::scaled_for_doubles(sheet.plain())));
}

void StraightLines::let(int ring_variable, int root, const Poly& divisor) {
  const int below = value(divisor.plain());
  known_[ring_variable] = builder_.multiply(builder_.variable(root), builder_.inverse(below));
}

StraightLine StraightLines::square(const Rational& constant, const std::vector<Poly>& w, const Poly& divisor) {
  // The components take half of the constant's power of two, so that none is beyond the range of doubles.
  const Rational half = core::times_power_of_two(1, core::binary_exponent(constant) / 2);
  int sum = builder_.constant(0);
  for (const Poly& component : w)
    sum = builder_.add(sum, builder_.power(builder_.append(of(half, {{component, 1}})), 2));
  const int above = builder_.multiply(builder_.constant(constant / (half * half)), sum);
  return builder_.line(builder_.multiply(above, builder_.power(value(divisor.plain()), 2)));
}

namespace {

/// In the plane: numerators of a vector over the tower.
std::array<Poly, 2> way_over_tower(const Geometry& geometry, const mechanism::VectorExpression& vector) {
  const std::vector<GiNaC::ex> natural = geometry.vector(vector);
  std::array<Poly, 2> parts = {geometry.poly(natural[0]), geometry.poly(natural[1])};
  for (const Substitution& pair : geometry.substitutions()) {
    const int degree = std::max(Geometry::degree_in(parts[0], pair), Geometry::degree_in(parts[1], pair));
    for (Poly& part : parts)
      if (degree > 0) part = geometry.substituted(part, pair, degree);
  }
  return {geometry.reduce(parts[0]), geometry.reduce(parts[1])};
}

}  // namespace

core::RootTower StraightLines::tower() {
  core::RootTower tower = geometry_->plain_tower();
  for (std::size_t j = 0; j < tower.roots.size(); ++j) tower.roots[j].line = square(j);
  const std::vector<int> variables = geometry_->tower_variables();
  for (const Geometry::Way& dyad_way : geometry_->dyad_ways())
    if (auto lines = way(dyad_way.point))
      tower.bases.push_back(
          {dyad_way.x.plain(variables), dyad_way.y.plain(variables), std::move((*lines)[0]), std::move((*lines)[1])});
  if (geometry_->mechanism().space != mechanism::Space::planar) return tower;
  for (const mechanism::Joint& joint : geometry_->mechanism().joints)
    for (const mechanism::VectorExpression& axis : joint.axes) {
      const auto [x, y] = way_over_tower(*geometry_, axis);
      const core::DyadBase leg = {x.plain(variables), y.plain(variables), {}, {}};
      if (!leg.x.is_constant() || !leg.y.is_constant()) tower.bases.push_back(leg);
    }
  // A force along a way has no direction either where the way has no length. Along a leg |A| vanishes there, too.
  const auto is_leg = [&](const Polynomial& x, const Polynomial& y) {
    return std::any_of(tower.bases.begin(), tower.bases.end(),
                       [&](const core::DyadBase& base) { return base.x_line.empty() && base.x * y == base.y * x; });
  };
  for (const InverseLength& length : geometry_->inverse_lengths()) {
    if (length.root < 0 || geometry_->roots()[static_cast<std::size_t>(length.root)].value) continue;
    const auto [x, y] = way_over_tower(*geometry_, length.along);
    if (x.is_constant() || y.is_constant()) continue;  // its zeros, if any, are a curve
    Polynomial plain_x = x.plain(variables), plain_y = y.plain(variables);
    if (is_leg(plain_x, plain_y)) continue;
    const Place v = vector(length.along);
    tower.bases.push_back({std::move(plain_x), std::move(plain_y), builder_.line(v[0]), builder_.line(v[1])});
  }
  return tower;
}

StraightLine StraightLines::square(std::size_t root) {
  for (const InverseLength& length : geometry_->inverse_lengths())
    if (length.root == static_cast<int>(root)) return squared_length(length);
  for (const TorsionAngle& angle : geometry_->torsion_angles())
    if (angle.root == static_cast<int>(root)) return shifted_angle(angle);
  const std::optional<Dyad> dyad_steps = dyad(geometry_->roots()[root].point);
  const TowerRoot& tower_root = geometry_->roots()[root];
  if (!dyad_steps || tower_root.role != core::RootRole::working_mode || tower_root.value) return {};
  const int scale = builder_.power(dyad_steps->scale, 2);
  if (dyad_steps->axis) {
    const int k = excess(*dyad_steps), twice_a = builder_.add(dyad_steps->sum, dyad_steps->difference);
    const int reach = builder_.multiply(builder_.power(twice_a, 2), dyad_steps->axis->d);
    const int q = builder_.subtract(reach, builder_.multiply(dyad_steps->axis->n2, builder_.power(k, 2)));
    return builder_.line(builder_.multiply(scale, q));
  }
  const int outer = builder_.subtract(builder_.power(dyad_steps->sum, 2), dyad_steps->distance2);
  const int inner = builder_.subtract(dyad_steps->distance2, builder_.power(dyad_steps->difference, 2));
  return builder_.line(builder_.multiply(scale, builder_.multiply(outer, inner)));
}

std::optional<std::array<StraightLine, 2>> StraightLines::rims(mechanism::PointIndex point) {
  const std::optional<Dyad> dyad_steps = dyad(point);
  if (!dyad_steps || dyad_steps->axis) return std::nullopt;
  return std::array{builder_.line(builder_.subtract(builder_.power(dyad_steps->sum, 2), dyad_steps->distance2)),
                    builder_.line(builder_.subtract(dyad_steps->distance2, builder_.power(dyad_steps->difference, 2)))};
}

/// |v|^2 in the unit of the root.
StraightLine StraightLines::squared_length(const InverseLength& length) {
  const TowerRoot& root = geometry_->roots()[static_cast<std::size_t>(length.root)];
  if (root.value || root.is_cut) return {};
  const Place v = vector(length.along);
  const int scale = builder_.multiply(value(root.scale.plain()), builder_.inverse(value(root.scale_divisor.plain())));
  return builder_.line(builder_.multiply(builder_.power(scale, 2), dot(v, v)));
}

/// (4 + angle)^2.
StraightLine StraightLines::shifted_angle(const TorsionAngle& angle) {
  const auto part = [&](std::size_t i) { return value_by_ways(geometry_->poly(angle.way[i].expand()), 1); };
  const int x = part(0), turned = builder_.angle(part(1), x);
  return builder_.line(builder_.power(builder_.add(builder_.constant(core::angle_shift), turned), 2));
}

/// scale / (scale_divisor s).
int StraightLines::inverse_of(const InverseLength& length) {
  const TowerRoot& root = geometry_->roots()[static_cast<std::size_t>(length.root)];
  const int s = root.value ? value(root.value->plain()) : known_.at(root.variable);
  const int below = builder_.multiply(value(root.scale_divisor.plain()), s);
  return builder_.multiply(value(root.scale.plain()), builder_.inverse(below));
}

std::optional<std::array<StraightLine, 2>> StraightLines::way(mechanism::PointIndex point) {
  const std::optional<Dyad> dyad_steps = dyad(point);
  if (!dyad_steps || dyad_steps->axis) return std::nullopt;
  return std::array{builder_.line(dyad_steps->way[0]), builder_.line(dyad_steps->way[1])};
}

int StraightLines::value(const Polynomial& p) {
  std::vector<int> variables(static_cast<std::size_t>(p.variables), 0);
  for (int v = 0; v < p.variables; ++v)
    if (core::depends_on(p, v)) variables[static_cast<std::size_t>(v)] = variable(v);
  return builder_.polynomial(p, variables);
}

void StraightLines::know(const std::array<int, 3>& ring_variables, const Place& place) {
  for (std::size_t i = 0; i < 3; ++i)
    if (ring_variables[i] >= 0) known_[ring_variables[i]] = place[i];
}

int StraightLines::variable(int ring_variable) {
  if (const auto found = known_.find(ring_variable); found != known_.end()) return found->second;
  for (const ConstructedPoint& point : geometry_->constructed()) {
    if (point.x != ring_variable && point.y != ring_variable && point.z != ring_variable) continue;
    know({point.x, point.y, point.z}, constructed_place(point));
    return known_.at(ring_variable);
  }
  for (const InverseLength& length : geometry_->inverse_lengths())
    if (length.variable == ring_variable && length.root >= 0) return known_[ring_variable] = inverse_of(length);
  for (const Substitution& pair : geometry_->substitutions()) {
    if (pair.x != ring_variable && pair.y != ring_variable) continue;
    know({pair.x, pair.y, -1}, over_tower(pair.place));
  }
  return known_.at(ring_variable);
}

StraightLines::Place StraightLines::natural_place(mechanism::PointIndex point) {
  const auto& natural = geometry_->natural(point);
  const int x = value(geometry_->poly(natural[0]).plain()), y = value(geometry_->poly(natural[1]).plain());
  return {x, y, value(geometry_->poly(natural[2]).plain())};
}

StraightLines::Place StraightLines::way_between(mechanism::PointIndex from, mechanism::PointIndex to) {
  Place way{};
  if (!is_nested_) {
    const Place a = natural_place(from), p = natural_place(to);
    for (std::size_t i = 0; i < 3; ++i) way[i] = builder_.subtract(p[i], a[i]);
    return way;
  }
  const auto &a = geometry_->natural(from), &p = geometry_->natural(to);
  for (std::size_t i = 0; i < 3; ++i) {
    const Poly poly = geometry_->poly((p[i] - a[i]).expand());
    way[i] = poly.is_zero() ? builder_.constant(0) : value_by_ways(poly, 1);
  }
  return way;
}

StraightLines::Place StraightLines::over_tower(const TowerPoint& place) {
  const int w = builder_.inverse(value(place.w.plain()));
  const int x = builder_.multiply(value(place.x.plain()), w), y = builder_.multiply(value(place.y.plain()), w);
  return {x, y, builder_.multiply(value(place.z.plain()), w)};
}

StraightLines::Place StraightLines::vector(const mechanism::VectorExpression& vector) {
  Place place = {builder_.constant(0), builder_.constant(0), builder_.constant(0)};
  const std::vector<GiNaC::ex> natural = geometry_->vector(vector);
  for (std::size_t i = 0; i < natural.size(); ++i) place[i] = value(geometry_->poly(natural[i]).plain());
  return place;
}

int StraightLines::dot(const Place& a, const Place& b) {
  const int in_plane = builder_.add(builder_.multiply(a[0], b[0]), builder_.multiply(a[1], b[1]));
  return builder_.add(in_plane, builder_.multiply(a[2], b[2]));
}

/// k = a^2 - b^2 + |P - A|^2.
int StraightLines::excess(const Dyad& dyad) {
  return builder_.add(builder_.multiply(dyad.sum, dyad.difference), dyad.distance2);
}

std::optional<StraightLines::Dyad> StraightLines::dyad(mechanism::PointIndex point) {
  const mechanism::PointForm& form = geometry_->mechanism().points[static_cast<std::size_t>(point)].form;
  const auto* dyad_point = std::get_if<mechanism::DyadPoint>(&form);
  if (dyad_point == nullptr || dyad_point->right_angle) return std::nullopt;
  const Poly from_length = geometry_->poly(geometry_->expression(dyad_point->from_length).expand());
  const Poly to_length = geometry_->poly(geometry_->expression(dyad_point->to_length).expand());
  const auto root = std::find_if(geometry_->roots().begin(), geometry_->roots().end(),
                                 [&](const TowerRoot& r) { return r.point == point; });
  // Of what was cut only the quotients are regular on the fold.
  if (root == geometry_->roots().end() || root->is_cut) return std::nullopt;
  const Place way = way_between(dyad_point->from, dyad_point->to);
  const int from = value(from_length.plain()), to = value(to_length.plain());
  const int distance2 = dot(way, way);
  if (is_nested_)
    for (const Geometry::Way& over_tower : geometry_->dyad_ways())
      if (over_tower.point == point) know_divisors(over_tower, distance2);
  Dyad dyad{way, distance2, scale(*root), builder_.add(from, to), builder_.subtract(from, to)};
  if (!dyad_point->axis) return dyad;
  const Place n = vector(*dyad_point->axis);
  const int n2 = dot(n, n), h = dot(n, way);
  const int d = builder_.subtract(builder_.multiply(n2, dyad.distance2), builder_.power(h, 2));
  dyad.axis = {n, n2, h, d};
  return dyad;
}

int StraightLines::scale(const TowerRoot& root) {
  const auto part = [&](const Poly& p) {
    const std::optional<int> positive = is_nested_ ? positive_value(p) : std::nullopt;
    return positive ? *positive : value(p.plain());
  };
  const int above = part(root.scale);
  return builder_.multiply(above, builder_.inverse(part(root.scale_divisor)));
}

std::optional<int> StraightLines::positive_value(const Poly& p) {
  if (const std::optional<int> product = product_of_divisors(p)) return product;
  // What was divided by a common factor.
  Poly rest(p.ring());
  for (const auto& [whole, divisors] : divisors_)
    if (whole.divides(p, rest))
      if (const std::optional<int> below = product_of_divisors(rest))
        return builder_.multiply(divisors, builder_.inverse(*below));
  return std::nullopt;
}

std::optional<int> StraightLines::product_of_divisors(Poly p) {
  int product = builder_.constant(1);
  Poly rest(p.ring());
  for (auto found = divisors_.rbegin(); found != divisors_.rend() && !p.is_constant(); ++found)
    while (p.divides(found->first, rest)) {
      product = builder_.multiply(product, found->second);
      std::swap(p, rest);
    }
  if (!p.is_constant()) return std::nullopt;
  return builder_.multiply(builder_.constant(p.constant()), product);
}

void StraightLines::know_divisors(const Geometry::Way& way, int distance2) {
  const auto is = [&](const auto& candidate) { return candidate.first == way.twice_dw; };
  if (std::any_of(divisors_.begin(), divisors_.end(), is)) return;
  const std::optional<int> w = positive_value(way.w);
  if (!w) return;
  const std::optional<int> below = way.is_squared ? builder_.power(*w, 2) : positive_value(way.w2);
  if (!below) return;
  const int w2 = *below, d = builder_.multiply(distance2, w2);
  const auto add = [&](const Poly& p, int step) {
    if (!p.is_constant()) divisors_.emplace_back(p, step);
  };
  add(way.w2, w2);
  add(way.d, d);
  add(way.twice_dw, builder_.multiply(builder_.multiply(builder_.constant(2), d), *w));
}

std::array<StraightLines::Place, 2> StraightLines::steps_in_space(const Dyad& dyad, int s) {
  const auto& [n, n2, h, d] = *dyad.axis;
  const Place& w = dyad.way;
  const int half = builder_.constant(Rational(1, 2)), inverse = builder_.inverse(d);
  const int bend = builder_.multiply(n2, builder_.multiply(dyad.sum, dyad.difference));
  const int shift = builder_.multiply(builder_.multiply(half, builder_.add(bend, builder_.power(h, 2))), inverse);
  const int from = builder_.add(half, shift), to = builder_.subtract(shift, half);
  const int mu = builder_.multiply(builder_.multiply(half, s), inverse);
  const int rise = builder_.multiply(h, builder_.inverse(n2));
  std::array<Place, 2> steps{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const int v = builder_.multiply(rise, n[i]), in_plane = builder_.subtract(w[i], v);
    const int left = builder_.subtract(builder_.multiply(n[j], w[k]), builder_.multiply(n[k], w[j]));
    const int across = builder_.multiply(mu, left);
    steps[0][i] = builder_.add(builder_.multiply(from, in_plane), across);
    steps[1][i] = builder_.subtract(builder_.add(builder_.multiply(to, in_plane), across), v);
  }
  return steps;
}

std::array<StraightLines::Place, 2> StraightLines::steps_to(const Dyad& dyad, const TowerRoot& root) {
  const int root_step = root.value ? value(root.value->plain()) : known_.at(root.variable);
  const int s = builder_.multiply(root_step, builder_.inverse(dyad.scale));
  if (dyad.axis) return steps_in_space(dyad, s);
  const int half = builder_.constant(Rational(1, 2)), inverse = builder_.inverse(dyad.distance2);
  const int shift = builder_.multiply(builder_.multiply(half, builder_.multiply(dyad.sum, dyad.difference)), inverse);
  const int mu = builder_.multiply(builder_.multiply(half, s), inverse);
  const int u = dyad.way[0], v = dyad.way[1];
  const auto step = [&](int lambda) {
    return Place{builder_.subtract(builder_.multiply(lambda, u), builder_.multiply(mu, v)),
                 builder_.add(builder_.multiply(lambda, v), builder_.multiply(mu, u)), builder_.constant(0)};
  };
  return {step(builder_.add(half, shift)), step(builder_.subtract(shift, half))};
}

StraightLines::Place StraightLines::constructed_place(const ConstructedPoint& point) {
  const auto root = std::find_if(geometry_->roots().begin(), geometry_->roots().end(),
                                 [&](const TowerRoot& r) { return r.point == point.point; });
  const std::optional<Dyad> dyad_steps = dyad(point.point);
  if (!dyad_steps || root == geometry_->roots().end()) return over_tower(geometry_->tower(point.point));
  const auto& form =
      std::get<mechanism::DyadPoint>(geometry_->mechanism().points[static_cast<std::size_t>(point.point)].form);
  const Place a = natural_place(form.from), step = steps_to(*dyad_steps, *root)[0];
  return {builder_.add(a[0], step[0]), builder_.add(a[1], step[1]), builder_.add(a[2], step[2])};
}

}  // namespace clearloci::symbolic
