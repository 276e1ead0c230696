#include "mechanism/point_order.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace clearloci::mechanism {
namespace {

using core::InputError;

/// Names that a point's form mentions, as far as it is written well enough to tell.
std::vector<Value> mentioned_points(const Value& value) {
  std::vector<Value> mentioned;
  if (!value.is_map()) return mentioned;
  for (const Entry& entry : entries(value)) {
    if (entry.key == "from" && entry.value.is_scalar()) mentioned.push_back(entry.value);
    if (entry.key != "dyad" && entry.key != "on" && entry.key != "mean" && entry.key != "slider") continue;
    if (!entry.value.is_sequence()) continue;
    const std::vector<Value> parts = elements(entry.value);
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i].is_scalar() && (entry.key != "slider" || i == 0)) mentioned.push_back(parts[i]);
  }
  return mentioned;
}

/// The points that an entry places: itself, or those of a group, which may use each other.
std::vector<std::string> placed_points(const Entry& entry) {
  if (!entry.value.is_map() || !entry.value.node.has("group")) return {entry.key};
  std::vector<std::string> placed;
  for (const Entry& part : entries(entry.value)) {
    if (part.key == "group" && part.value.is_sequence())
      for (const Value& point : elements(part.value))
        if (point.is_scalar()) placed.push_back(point.node.Scalar());
    if (part.key == "with" && part.value.is_map())
      for (const Entry& further : entries(part.value)) placed.push_back(further.key);
  }
  return placed;
}

/// A link as it is written, as far as it is written well enough to tell.
struct WrittenLink {
  std::string name;
  std::vector<std::string> points;

  std::string text() const { return name + " (" + join(points) + ")"; }
};

std::vector<WrittenLink> written_links(const std::optional<Value>& links) {
  std::vector<WrittenLink> all;
  if (!links || !links->is_map()) return all;
  for (const Entry& entry : entries(*links)) {
    if (!entry.value.is_map()) continue;
    WrittenLink link{entry.key, {}};
    for (const Entry& part : entries(entry.value)) {
      if (part.key != "points" || !part.value.is_sequence()) continue;
      for (const Value& point : elements(part.value))
        if (point.is_scalar()) link.points.push_back(point.node.Scalar());
    }
    all.push_back(std::move(link));
  }
  return all;
}

class OrderCheck {
 public:
  OrderCheck(const std::vector<Entry>& points, const std::optional<Value>& links)
      : points_(points), links_(links), state_(points.size(), State::unseen) {
    for (std::size_t i = 0; i < points.size(); ++i)
      for (const std::string& name : placed_points(points[i])) index_[name] = i;
    for (std::size_t i = 0; i < points.size(); ++i) visit(i);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const Value& used : mentioned_points(points[i].value)) {
        const auto found = index_.find(used.node.Scalar());
        if (found == index_.end() || found->second < i) continue;
        throw InputError(used.where,
                         "point " + points[i].key + " uses " + found->first + ", which is written below it in line " +
                             std::to_string(points[found->second].where.line),
                         "write " + found->first + " above " + points[i].key);
      }
    }
  }

 private:
  enum class State { unseen, open, done };

  void visit(std::size_t i) {
    if (state_[i] == State::done) return;
    if (state_[i] == State::open) refuse_cycle(i);
    state_[i] = State::open;
    path_.push_back(i);
    for (const Value& used : mentioned_points(points_[i].value)) {
      const auto found = index_.find(used.node.Scalar());
      if (found != index_.end()) visit(found->second);
    }
    path_.pop_back();
    state_[i] = State::done;
  }

  [[noreturn]] void refuse_cycle(std::size_t closing) const {
    const auto start = std::find(path_.begin(), path_.end(), closing);
    std::string cycle;
    std::set<std::string> members;
    for (auto i = start; i != path_.end(); ++i) {
      cycle += points_[*i].key + " -> ";
      members.insert(points_[*i].key);
    }
    cycle += points_[closing].key;
    std::vector<std::string> closed;
    std::string mend = "build one of them from points that are known without it";
    bool driven = false;
    for (const WrittenLink& link : written_links(links_)) {
      const auto through = std::find_if(link.points.begin(), link.points.end(),
                                        [&](const std::string& point) { return members.contains(point); });
      if (through == link.points.end()) continue;
      closed.push_back(link.text());
      const auto pivot = std::find_if(link.points.begin(), link.points.end(),
                                      [&](const std::string& point) { return is_coordinates(point); });
      if (driven || pivot == link.points.end()) continue;
      driven = true;
      mend = "make the angle of link " + link.name + " about " + *pivot + " the free coordinate, with " + *through +
             " written by its cos and sin, so that each dyad uses points above it; the motor may stay at its joint; or "
             "write the points as a group";
    }
    std::string together;
    if (closed.size() > 1)
      together = "; the links " + join(closed) + " have positions that follow only from common equations";
    throw InputError(points_[closing].where, "the points use each other in a cycle: " + cycle + together, mend);
  }

  /// A point that is written as its coordinates.
  bool is_coordinates(const std::string& point) const {
    const auto found = index_.find(point);
    return found != index_.end() && points_[found->second].value.is_sequence();
  }

  const std::vector<Entry>& points_;
  const std::optional<Value>& links_;
  std::map<std::string, std::size_t> index_;
  std::vector<State> state_;
  std::vector<std::size_t> path_;
};

}  // namespace

void check_order(const std::vector<Entry>& points, const std::optional<Value>& links) {
  (void)OrderCheck(points, links);
}

}  // namespace clearloci::mechanism
