#include "loci/tasks/pose_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "core/task.hpp"

namespace clearloci::loci::pose {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Doubles place the task to rounding; a hair more covers it. As a part of its size.
constexpr double hair_of_size = 1e-12;
/// Sums and roots of distances are known to this part.
constexpr double below = 1 - 1e-12;
constexpr std::size_t most_corners = 64, more_samples = 96;

/// From an interval to another, 0 where they meet.
double gap(double low, double high, double from, double to) { return std::max({0.0, from - high, low - to}); }

/// The i-th number of the sequence of van der Corput in a base.
double spread(std::size_t i, std::size_t base) {
  double value = 0, part = 1;
  for (; i > 0; i /= base) {
    part /= static_cast<double>(base);
    value += part * static_cast<double>(i % base);
  }
  return value;
}

Solid::Point point_of(const Pose& pose) { return {pose[0], pose[1], pose[2]}; }
Pose pose_of(const Solid::Point& point) { return {point.begin(), point.end()}; }

/// Poses in a solid, the one nearest to its middle first, and corners of its surface.
std::vector<Pose> samples_in(const Solid& solid) {
  constexpr std::size_t most_tried = 2048;
  constexpr std::array<std::size_t, 3> bases = {2, 3, 5};
  const auto& [low, high] = solid.bounds();
  std::vector<Pose> inside;
  std::vector<double> off;
  for (std::size_t i = 1; i <= most_tried && inside.size() < more_samples; ++i) {
    Solid::Point at{};
    double from_middle = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double part = spread(i, bases[c]);
      at[c] = low[c] + part * (high[c] - low[c]);
      from_middle += (part - 0.5) * (part - 0.5);
    }
    if (!solid.holds(at)) continue;
    inside.push_back(pose_of(at));
    off.push_back(from_middle);
  }
  if (!inside.empty())
    std::swap(inside.front(), inside[static_cast<std::size_t>(std::min_element(off.begin(), off.end()) - off.begin())]);
  const std::size_t corners = solid.corners().size(), stride = (corners + most_corners - 1) / most_corners;
  for (std::size_t i = 0; i < corners; i += stride) inside.push_back(pose_of(solid.corners()[i]));
  return inside;
}

}  // namespace

PoseRegion::PoseRegion(const core::TaskShape& shape, PoseMetric metric, PoseBeside beside)
    : metric_(std::move(metric)), shaped_(metric_.weights.size() - beside.lower.size()), beside_(std::move(beside)) {
  if (const auto* box = std::get_if<core::TaskBox>(&shape)) {
    lower_ = core::rounded(box->lower);
    upper_ = core::rounded(box->upper);
  } else if (const auto* ball = std::get_if<core::TaskBall>(&shape)) {
    kind_ = Kind::ball;
    centre_ = core::rounded(ball->centre);
    radius_ = core::to_double(ball->radius);
    for (std::size_t c = 0; c < centre_.size(); ++c) {
      lower_.push_back(centre_[c] - radius_ / metric_.weights[c]);
      upper_.push_back(centre_[c] + radius_ / metric_.weights[c]);
    }
  } else if (const auto* mesh = std::get_if<core::TaskMesh>(&shape)) {
    kind_ = Kind::mesh;
    solid_ = std::make_shared<const Solid>(*mesh);
    lower_.assign(solid_->bounds().lower.begin(), solid_->bounds().lower.end());
    upper_.assign(solid_->bounds().upper.begin(), solid_->bounds().upper.end());
    points_ = samples_in(*solid_);
  } else if (const auto* polygon = std::get_if<core::TaskPolygon>(&shape)) {
    kind_ = Kind::polygon;
    across_ = polygon->across;
    const auto [low, high] = core::bounds(shape);
    lower_ = core::rounded(low);
    upper_ = core::rounded(high);
    core::TaskPolygon alone;
    for (const core::RationalPose& corner : polygon->corners)
      alone.corners.push_back({corner[across_[0]], corner[across_[1]]});
    plane_.emplace(core::TaskShape(std::move(alone)));
    for (const core::Point2& at : plane_->samples()) {
      Pose pose = lower_;
      for (std::size_t c = 0; c < pose.size(); ++c) {
        const std::size_t k = points_.size();  // the middle, then corners and what lies between them in turn
        const double part = k == 0 ? 0.5 : k % 2 == 1 ? static_cast<double>(k / 2 >> c & 1) : spread(k, 2 + c);
        pose[c] += part * (upper_[c] - lower_[c]);
      }
      for (std::size_t i = 0; i < 2; ++i) pose[across_[i]] = at[i];
      points_.push_back(std::move(pose));
    }
  } else {
    kind_ = Kind::path;
    for (const core::RationalPose& point : std::get<core::TaskPath>(shape).points)
      points_.push_back(core::rounded(point));
    lower_ = upper_ = points_.front();
    for (const Pose& point : points_)
      for (std::size_t c = 0; c < point.size(); ++c) {
        lower_[c] = std::min(lower_[c], point[c]);
        upper_[c] = std::max(upper_[c], point[c]);
      }
  }
  lower_.insert(lower_.end(), beside_.lower.begin(), beside_.lower.end());
  upper_.insert(upper_.end(), beside_.upper.begin(), beside_.upper.end());
  for (std::size_t i = 0; i < points_.size() && !beside_.lower.empty(); ++i) points_[i] = with_beside(points_[i], i);
  for (std::size_t c = 0; c < lower_.size(); ++c)
    hair_ = std::max(hair_, hair_of_size * (std::abs(lower_[c]) + std::abs(upper_[c])));
}

void PoseRegion::clamp_beside(Pose& pose) const {
  if (pose.size() == shaped_) return;  // of the shape alone
  for (std::size_t c = shaped_; c < pose.size(); ++c) pose[c] = std::clamp(pose[c], lower_[c], upper_[c]);
  for (const core::LoadBall& ball : beside_.balls) {
    double square = 0;
    const auto each = [&](const auto& act) {
      for (std::size_t c = shaped_ + ball.first; c < shaped_ + ball.first + ball.count; ++c)
        act(pose[c], 0.5 * (lower_[c] + upper_[c]));
    };
    each([&](double value, double middle) { square += (value - middle) * (value - middle); });
    const double far = std::sqrt(square);
    if (far > ball.radius)
      each([&](double& value, double middle) { value = middle + (value - middle) * (ball.radius / far); });
  }
}

bool PoseRegion::is_beyond_ball(const PoseBox& box, std::size_t offset) const {
  for (const core::LoadBall& ball : beside_.balls) {
    double square = 0;
    for (std::size_t k = ball.first; k < ball.first + ball.count; ++k) {
      const double middle = 0.5 * (lower_[shaped_ + k] + upper_[shaped_ + k]);
      const double off = gap(box[offset + k][0], box[offset + k][1], middle, middle);
      square += off * off;
    }
    if (below * std::sqrt(square) > ball.radius + hair_) return true;
  }
  return false;
}

Pose PoseRegion::with_beside(Pose pose, std::size_t number) const {
  constexpr std::array<std::size_t, 6> bases = {2, 3, 5, 7, 11, 13};
  pose.resize(shaped_);
  for (std::size_t k = 0; k < beside_.lower.size(); ++k) {
    const bool corner = number % 2 == 1;
    const double part = number == 0 ? 0.5
                        : corner    ? static_cast<double>(number / 2 >> (k % 16) & 1)
                                    : spread(number, bases[k % bases.size()]);
    pose.push_back(beside_.lower[k] + part * (beside_.upper[k] - beside_.lower[k]));
  }
  clamp_beside(pose);
  return pose;
}

std::vector<PosePiece> PoseRegion::pieces(double margin) const {
  const std::size_t n = coordinates();
  const auto reach = [&](std::size_t c) { return hair_ + (metric_.grows[c] ? margin / metric_.weights[c] : 0.0); };
  std::vector<PosePiece> all;
  if (kind_ != Kind::path) {
    PosePiece& piece = all.emplace_back();
    piece.chart.base.assign(n, 0.0);
    for (std::size_t c = 0; c < n; ++c) {
      Pose way(n, 0.0);
      way[c] = 1;
      piece.chart.ways.push_back(std::move(way));
      piece.box.push_back({lower_[c] - reach(c), upper_[c] + reach(c)});
    }
    return all;
  }
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    PosePiece& piece = all.emplace_back();
    piece.segment = static_cast<int>(i);
    piece.chart.base = points_[i];
    Pose along(n);
    for (std::size_t c = 0; c < n; ++c) along[c] = points_[i + 1][c] - points_[i][c];
    piece.chart.ways.push_back(std::move(along));
    piece.box.push_back({0, 1});
    // The hair is of the path's own rounding: it has no thickness where nothing is asked around it.
    for (std::size_t c = 0; c < n; ++c) {
      if (c < shaped_ && (!metric_.grows[c] || !(margin > 0))) continue;
      Pose way(n, 0.0);
      way[c] = 1;
      piece.chart.ways.push_back(std::move(way));
      if (c < shaped_) {
        piece.box.push_back({-reach(c), reach(c)});
        continue;
      }
      piece.chart.base[c] = 0;
      piece.chart.ways.front()[c] = 0;
      piece.box.push_back({lower_[c] - hair_, upper_[c] + hair_});
    }
  }
  return all;
}

double PoseRegion::distance(const PosePiece& piece, const PoseBox& box) const {
  double square = 0;
  if (is_beyond_ball(box, box.size() - beside_.lower.size())) return infinite;
  if (kind_ == Kind::path) {
    for (std::size_t j = 1; j < box.size() - beside_.lower.size(); ++j) {
      const Pose& way = piece.chart.ways[j];
      const auto c = static_cast<std::size_t>(std::find(way.begin(), way.end(), 1.0) - way.begin());
      const double off = metric_.weights[c] * gap(box[j][0], box[j][1], 0, 0);
      square += off * off;
    }
    return below * std::sqrt(square);
  }
  if (kind_ == Kind::mesh)
    return below * solid_->distance({{box[0][0], box[1][0], box[2][0]}, {box[0][1], box[1][1], box[2][1]}});
  if (kind_ == Kind::polygon) {
    const auto& [i, j] = across_;
    const double off = plane_->distance({box[i][0], box[i][1]}, {box[j][0], box[j][1]});
    square = off * off;
    for (std::size_t c = 0; c < shaped_; ++c) {
      if (c == i || c == j || !metric_.grows[c]) continue;
      square += std::pow(metric_.weights[c] * gap(box[c][0], box[c][1], lower_[c], upper_[c]), 2);
    }
    return below * std::sqrt(square);
  }
  for (std::size_t c = 0; c < shaped_; ++c) {
    const double off = metric_.weights[c] * (kind_ == Kind::box ? gap(box[c][0], box[c][1], lower_[c], upper_[c])
                                                                : gap(box[c][0], box[c][1], centre_[c], centre_[c]));
    if (kind_ == Kind::box && !metric_.grows[c]) continue;
    square += off * off;
  }
  return std::max(0.0, below * std::sqrt(square) - radius_);
}

double PoseRegion::apart(const Pose& a, const Pose& b) const {
  double square = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const double off = metric_.weights[c] * (a[c] - b[c]);
    // Off a held coordinate there is nothing but the hair.
    if (is_held(c) && std::abs(a[c] - b[c]) > 2 * hair_) return infinite;
    if (!is_held(c)) square += off * off;
  }
  return std::sqrt(square);
}

Pose PoseRegion::on_segment(std::size_t segment, double t) const {
  Pose pose = points_[segment];
  for (std::size_t c = 0; c < pose.size(); ++c) pose[c] += t * (points_[segment + 1][c] - points_[segment][c]);
  return pose;
}

std::pair<std::size_t, double> PoseRegion::foot(const Pose& pose) const {
  std::pair<std::size_t, double> best{0, 0.0};
  double least = infinite;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    double along = 0, length2 = 0;
    for (std::size_t c = 0; c < shaped_; ++c) {
      const double w2 = metric_.weights[c] * metric_.weights[c], way = points_[i + 1][c] - points_[i][c];
      along += w2 * way * (pose[c] - points_[i][c]);
      length2 += w2 * way * way;
    }
    const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
    const Pose at = on_segment(i, t);
    double square = 0;
    for (std::size_t c = 0; c < shaped_; ++c) square += std::pow(metric_.weights[c] * (pose[c] - at[c]), 2);
    if (square < least) {
      least = square;
      best = {i, t};
    }
  }
  return best;
}

Pose PoseRegion::closest(const Pose& pose) const {
  if (kind_ == Kind::path) {
    const auto [segment, t] = foot(pose);
    Pose candidate = on_segment(segment, t);
    std::copy(pose.begin() + static_cast<std::ptrdiff_t>(shaped_), pose.end(),
              candidate.begin() + static_cast<std::ptrdiff_t>(shaped_));
    clamp_beside(candidate);
    return candidate;
  }
  if (kind_ == Kind::mesh) return nearest_in_solid(pose);
  Pose candidate = pose;
  clamp_beside(candidate);
  if (kind_ == Kind::box || kind_ == Kind::polygon) {
    for (std::size_t c = 0; c < shaped_; ++c) candidate[c] = std::clamp(candidate[c], lower_[c], upper_[c]);
    if (kind_ == Kind::box) return candidate;
    const core::Point2 at = plane_->closest(in_plane(pose));
    for (std::size_t i = 0; i < 2; ++i) candidate[across_[i]] = at[i];
    return candidate;
  }
  double square = 0;
  for (std::size_t c = 0; c < shaped_; ++c) square += std::pow(metric_.weights[c] * (candidate[c] - centre_[c]), 2);
  const double far = std::sqrt(square);
  if (far > radius_)
    for (std::size_t c = 0; c < shaped_; ++c) candidate[c] = centre_[c] + (candidate[c] - centre_[c]) * (radius_ / far);
  return candidate;
}

Pose PoseRegion::farthest_along(std::size_t coordinate, double way) const {
  if (points_.empty()) {
    Pose pose = lower_;
    for (std::size_t c = 0; c < pose.size(); ++c)
      pose[c] = kind_ == Kind::ball && c < shaped_ ? centre_[c] : pose[c] + 0.5 * (upper_[c] - pose[c]);
    pose[coordinate] = way > 0 ? upper_[coordinate] : lower_[coordinate];
    return pose;
  }
  return *std::max_element(points_.begin(), points_.end(),
                           [&](const Pose& a, const Pose& b) { return way * a[coordinate] < way * b[coordinate]; });
}

double PoseRegion::distance(const Pose& pose) const { return apart(pose, closest(pose)); }

Pose PoseRegion::nearest_in_solid(const Pose& pose) const {
  Pose candidate = pose;
  clamp_beside(candidate);
  if (solid_->holds(point_of(pose))) return candidate;
  const Solid::Point at = solid_->nearest_of_surface(point_of(pose));
  std::copy(at.begin(), at.end(), candidate.begin());
  return candidate;
}

bool PoseRegion::seems_inside(const Pose& from, const Pose& to) const {
  constexpr int looks = 24;
  for (int i = 1; i < looks; ++i) {
    Pose at = from;
    for (std::size_t c = 0; c < at.size(); ++c) at[c] += (to[c] - from[c]) * i / looks;
    if (!solid_->holds(point_of(at))) return false;
  }
  return true;
}

bool PoseRegion::holds_way(const Pose& from, const Pose& to, double margin) const {
  if (kind_ != Kind::mesh && kind_ != Kind::polygon) return true;  // the others are convex, or a way of theirs is
  double square = 0;
  for (std::size_t c = 0; c < from.size(); ++c) square += (to[c] - from[c]) * (to[c] - from[c]);
  const double length = std::sqrt(square), off = distance(from);
  if (off + length <= margin + hair_) return true;
  // A ball around `from` that no triangle meets lies in the solid as a whole.
  if (off > 0) return false;
  if (kind_ == Kind::polygon) return length <= -below * plane_->signed_distance(in_plane(from));
  const Solid::Point rim = solid_->nearest_of_surface(point_of(from));
  return length <= below * std::sqrt(std::pow(from[0] - rim[0], 2) + std::pow(from[1] - rim[1], 2) +
                                     std::pow(from[2] - rim[2], 2));
}

std::vector<Pose> PoseRegion::way(const Pose& from, const Pose& to) const {
  if (kind_ == Kind::mesh) return way_in_solid(from, to);
  if (kind_ == Kind::polygon) return way_in_polygon(from, to);
  if (kind_ != Kind::path) return {from, to};
  const auto [first, s] = foot(from);
  const auto [last, t] = foot(to);
  std::vector<Pose> way = {from, on_segment(first, s)};
  for (std::size_t i = first; i < last; ++i) way.push_back(points_[i + 1]);
  for (std::size_t i = first; i > last; --i) way.push_back(points_[i]);
  way.push_back(on_segment(last, t));
  for (std::size_t i = 1; i < way.size(); ++i)
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(shaped_), from.end(),
              way[i].begin() + static_cast<std::ptrdiff_t>(shaped_));
  way.push_back(to);
  return way;
}

/// Straight where that looks inside, else along the outline, with the other values on the way between.
std::vector<Pose> PoseRegion::way_in_polygon(const Pose& from, const Pose& to) const {
  const core::Polyline line = plane_->way(in_plane(from), in_plane(to), hair_);
  std::vector<Pose> way;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(line.size() - 1);
    Pose pose = from;
    for (std::size_t c = 0; c < pose.size(); ++c) pose[c] += part * (to[c] - from[c]);
    for (std::size_t k = 0; k < 2; ++k) pose[across_[k]] = line[i][k];
    way.push_back(std::move(pose));
  }
  return way;
}

/// From sample to sample that see one another, by as few as can be.
std::vector<Pose> PoseRegion::way_in_solid(const Pose& from, const Pose& to) const {
  const Pose first = nearest_in_solid(from), last = nearest_in_solid(to);
  if (seems_inside(first, last)) return {from, first, last, to};
  const std::size_t none = points_.size();
  std::vector<std::size_t> before(points_.size(), none + 1), met;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (seems_inside(first, points_[i])) {
      before[i] = none;
      met.push_back(i);
    }
  for (std::size_t next = 0; next < met.size(); ++next) {
    const std::size_t at = met[next];
    if (seems_inside(points_[at], last)) {
      std::vector<Pose> way = {to, last};
      for (std::size_t i = at; i != none; i = before[i]) way.push_back(points_[i]);
      way.push_back(first);
      way.push_back(from);
      std::reverse(way.begin(), way.end());
      return way;
    }
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (before[i] > none && seems_inside(points_[at], points_[i])) {
        before[i] = at;
        met.push_back(i);
      }
  }
  return {};
}

std::vector<Pose> PoseRegion::samples() const {
  if (kind_ == Kind::mesh || kind_ == Kind::polygon) return points_;
  std::vector<Pose> all;
  const std::size_t n = shaped_;
  const auto told = [&] {
    for (std::size_t i = 0; i < all.size() && !beside_.lower.empty(); ++i) all[i] = with_beside(all[i], i);
    return all;
  };
  if (kind_ == Kind::path) {
    constexpr std::size_t looks = 16;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
      for (std::size_t k = 0; k < looks; ++k) all.push_back(on_segment(i, static_cast<double>(k) / looks));
    all.push_back(points_.back());
    return told();
  }
  const auto inside = [&](const std::vector<double>& part) {
    Pose pose(n);
    for (std::size_t c = 0; c < n; ++c) pose[c] = lower_[c] + part[c] * (upper_[c] - lower_[c]);
    return kind_ == Kind::ball ? closest(pose) : pose;
  };
  all.push_back(inside(std::vector<double>(n, 0.5)));
  for (std::size_t corner = 0; corner < std::min(std::size_t{1} << n, most_corners); ++corner) {
    std::vector<double> part(n);
    for (std::size_t c = 0; c < n; ++c) part[c] = static_cast<double>(corner >> c & 1);
    all.push_back(inside(part));
  }
  constexpr std::array<std::size_t, 6> bases = {2, 3, 5, 7, 11, 13};
  for (std::size_t i = 1; i <= more_samples; ++i) {
    std::vector<double> part(n);
    for (std::size_t c = 0; c < n; ++c) part[c] = spread(i, bases[c]);
    all.push_back(inside(part));
  }
  return told();
}

}  // namespace clearloci::loci::pose
