// Random linkages of four to ten links, drawn on a lattice in a random posture and in a random order, against the same
// ones constructed by hand.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <map>
#include <random>
#include <set>

#include "tests/mechanism/assembly/assembly_text.hpp"

namespace clearloci::mechanism {
namespace {

/// Multiples of 1/4.
struct Quarters {
  long x = 0, y = 0;
};

std::string text_of(long quarters) { return std::to_string(quarters) + "/4"; }

long cross(const Quarters& o, const Quarters& p, const Quarters& q) {
  return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}
long dot(const Quarters& o, const Quarters& p, const Quarters& q) {
  return (p.x - o.x) * (q.x - o.x) + (p.y - o.y) * (q.y - o.y);
}
std::string distance(const Quarters& p, const Quarters& q) { return "sqrt(" + std::to_string(dot(p, q, q)) + ")/4"; }

class Linkage {
 public:
  explicit Linkage(unsigned seed) : random_(seed) {
    const int cranks = 1 + static_cast<int>(random_() % 2);
    for (int i = 0; i < cranks; ++i) add_crank(i);
    const std::size_t most = 4 + random_() % 7;
    while (links_.size() + 1 < most && tries_ < 400) add_dyad();
  }

  /// Links with the ground; fewer than four where no dyad found a place.
  std::size_t links() const { return links_.size() + 1; }

  std::string constructed() const { return file(false); }
  std::string drawn() { return file(true); }

 private:
  struct Point {
    std::string name, form;
    Quarters at;
    bool fixed = false;
  };
  struct Link {
    std::string name;
    std::vector<std::size_t> points;
  };

  std::size_t add_point(const std::string& name, const Quarters& at, const std::string& form, bool fixed = false) {
    points_.push_back({name, form, at, fixed});
    return points_.size() - 1;
  }
  std::size_t add_fixed(const Quarters& at) {
    return add_point("G" + std::to_string(points_.size()), at, "[" + text_of(at.x) + ", " + text_of(at.y) + "]", true);
  }
  Quarters anywhere() { return {static_cast<long>(random_() % 33) - 16, static_cast<long>(random_() % 33) - 16}; }

  void add_crank(int index) {
    // Posture angles of rational cosine and sine.
    static constexpr long pairs[4][3] = {{3, 4, 5}, {-4, 3, 5}, {-3, -4, 5}, {4, -3, 5}};
    const auto& [c, s, l] = pairs[random_() % 4];
    const Quarters at = {static_cast<long>(random_() % 9) - 4 + 20 * index, static_cast<long>(random_() % 9) - 4};
    const std::size_t foot = add_fixed(at);
    const std::string angle = "q" + std::to_string(index);
    const std::size_t pin = add_point("K" + std::to_string(index), {at.x + c, at.y + s},
                                      "['" + text_of(at.x) + " + " + text_of(l) + "*cos(" + angle + ")', '" +
                                          text_of(at.y) + " + " + text_of(l) + "*sin(" + angle + ")']");
    links_.push_back({"crank" + std::to_string(index), {foot, pin}});
    coordinates_.push_back({angle, links_.back().name});
    join("ground", links_.back().name, foot, ", actuated: true");
  }

  void join(const std::string& from, const std::string& to, std::size_t at, const std::string& more = "") {
    joints_ += "  J" + std::to_string(++joint_count_) + ": {revolute: [" + from + ", " + to +
               "], at: " + points_[at].name + more + "}\n";
  }
  void slide(const std::string& from, const std::string& to, std::size_t at, const std::string& axis) {
    joints_ += "  J" + std::to_string(++joint_count_) + ": {prismatic: [" + from + ", " + to +
               "], at: " + points_[at].name + ", axis: " + axis + "}\n";
  }

  std::set<std::string> carriers(std::size_t point) const {
    std::set<std::string> names;
    if (points_[point].fixed) names.insert("ground");
    for (const Link& link : links_)
      if (std::find(link.points.begin(), link.points.end(), point) != link.points.end()) names.insert(link.name);
    return names;
  }

  /// A moving point, and one of links that it shares none with, or a new one on the ground.
  void add_dyad() {
    ++tries_;
    std::size_t p = random_() % points_.size();
    if (points_[p].fixed) return;
    const unsigned kind = static_cast<unsigned>(random_() % 4);
    if (kind == 1) return add_slider(p);
    std::size_t q = random_() % points_.size();
    const Quarters ground = anywhere(), at = anywhere();
    const bool on_ground = random_() % 2 == 0;
    if (!on_ground) {
      std::set<std::string> both;
      const std::set<std::string> first = carriers(p), second = carriers(q);
      std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::inserter(both, both.end()));
      if (!both.empty() || p == q || points_[q].fixed) return;
    }
    const Quarters end = on_ground ? ground : points_[q].at;
    const Quarters start = points_[p].at;
    if (cross(start, end, at) == 0) return;  // stretched, or points in one place
    if (on_ground) q = add_fixed(ground);
    const std::string from = *carriers(p).begin(), to = *carriers(q).begin();
    const std::string k = std::to_string(links_.size());
    if (kind == 2) return add_swinging_block(p, q, at, from, to, k);
    const std::size_t r =
        add_point("R" + k, at,
                  "{dyad: [" + points_[p].name + ", " + points_[q].name + "], lengths: ['" + distance(start, at) +
                      "', '" + distance(end, at) + "'], side: " + (cross(start, end, at) > 0 ? "left" : "right") + "}");
    links_.push_back({"L" + k, {p, r}});
    links_.push_back({"M" + k, {q, r}});
    join(from, "L" + k, p);
    join("L" + k, "M" + k, r);
    join(to, "M" + k, q);
    if (random_() % 2 == 0) add_third_point(p, r, "L" + k, links_.size() - 2);
  }

  void add_third_point(std::size_t p, std::size_t r, const std::string& link, std::size_t index) {
    const Quarters at = anywhere(), &first = points_[p].at, &second = points_[r].at;
    if (dot(first, at, at) == 0 || dot(second, at, at) == 0) return;
    const std::string size = "(4*sqrt(" + std::to_string(dot(first, second, second)) + "))";
    const std::size_t e = add_point("E" + link, at,
                                    "{on: [" + points_[p].name + ", " + points_[r].name + "], offset: ['" +
                                        std::to_string(dot(first, second, at)) + "/" + size + "', '" +
                                        std::to_string(cross(first, second, at)) + "/" + size + "']}");
    links_[index].points.push_back(e);
  }

  /// A rod to a block on a rail of the ground.
  void add_slider(std::size_t p) {
    const Quarters at = anywhere(), u = {static_cast<long>(random_() % 5) - 2, static_cast<long>(random_() % 5) - 2};
    const Quarters start = points_[p].at;
    const long ahead = u.x * (at.x - start.x) + u.y * (at.y - start.y);
    if ((u.x == 0 && u.y == 0) || ahead == 0 || (at.x == start.x && at.y == start.y)) return;
    const std::string from = *carriers(p).begin(), k = std::to_string(links_.size());
    const std::size_t base = add_fixed({at.x - 8 * u.x, at.y - 8 * u.y});
    const std::string axis = "[" + std::to_string(u.x) + ", " + std::to_string(u.y) + "]";
    const std::size_t r =
        add_point("R" + k, at,
                  "{slider: [" + points_[base].name + ", " + axis + "], from: " + points_[p].name + ", length: '" +
                      distance(start, at) + "', side: " + (ahead > 0 ? "ahead" : "behind") + "}");
    links_.push_back({"L" + k, {p, r}});
    links_.push_back({"M" + k, {r}});
    join(from, "L" + k, p);
    join("L" + k, "M" + k, r);
    slide("ground", "M" + k, r, axis);
  }

  /// A lever on one pin, in a sleeve on another.
  void add_swinging_block(std::size_t p, std::size_t q, const Quarters& at, const std::string& from,
                          const std::string& to, const std::string& k) {
    const Quarters first = points_[p].at, second = points_[q].at;
    const std::string size = "(4*sqrt(" + std::to_string(dot(first, second, second)) + "))";
    const std::size_t e = add_point("R" + k, at,
                                    "{on: [" + points_[p].name + ", " + points_[q].name + "], offset: ['" +
                                        std::to_string(dot(first, second, at)) + "/" + size + "', '" +
                                        std::to_string(cross(first, second, at)) + "/" + size + "']}");
    links_.push_back({"L" + k, {p, e}});
    links_.push_back({"M" + k, {q}});
    join(from, "L" + k, p);
    slide("L" + k, "M" + k, q, "[" + points_[p].name + ", " + points_[q].name + "]");
    join(to, "M" + k, q);
  }

  std::string file(bool drawn) const {
    std::mt19937 shuffle(static_cast<unsigned>(links_.size() * 31 + points_.size()));
    std::string text = "format: 1\nname: linkage\nworkspace:\n";
    for (const auto& [name, link] : coordinates_)
      text += "  " + name + ": {angle: [0, 360 deg]" + (drawn ? ", of: " + link : "") + "}\n";
    std::vector<Point> points = points_;
    if (drawn) std::shuffle(points.begin(), points.end(), shuffle);
    text += drawn ? "drawn:\n" : "points:\n";
    for (const Point& point : points)
      text += "  " + point.name + ": " +
              (drawn ? "[" + text_of(point.at.x) + ", " + text_of(point.at.y) + "]" : point.form) + "\n";
    std::vector<Link> links = links_;
    if (drawn) std::shuffle(links.begin(), links.end(), shuffle);
    text += "links:\n";
    for (const Link& link : links) {
      std::string names;
      for (const std::size_t point : link.points) names += (names.empty() ? "" : ", ") + points_[point].name;
      text += "  " + link.name + ": {points: [" + names + "]}\n";
    }
    text += "joints:\n" + joints_ + "end_effector: {link: " + links_.back().name +
            ", at: " + points_[links_.back().points.front()].name + "}\n";
    return text;
  }

  std::mt19937 random_;
  std::vector<Point> points_;
  std::vector<Link> links_;
  std::vector<std::pair<std::string, std::string>> coordinates_;
  std::string joints_;
  int joint_count_ = 0, tries_ = 0;
};

/// The same in space: cranks about x, rods between balls, rockers about axes across the ground and blocks on its rails.
class LinkageInSpace {
 public:
  explicit LinkageInSpace(unsigned seed) : random_(seed), seed_(seed) {
    add_crank();
    const std::size_t most = 4 + random_() % 7;
    for (int tries = 0; links_.size() + 1 < most && tries < 400; ++tries) add_dyad();
  }

  std::size_t links() const { return links_.size() + 1; }

  std::string file(bool drawn) const {
    std::mt19937 order(seed_);
    std::string text = "format: 1\nspace: spatial\nname: linkage\nworkspace: {q: {angle: [0, 360 deg]";
    text += drawn ? ", of: crank}}\ndrawn:\n" : "}}\npoints:\n";
    std::vector<Point> points = points_;
    std::vector<std::string> links = links_;
    if (drawn) std::shuffle(points.begin(), points.end(), order), std::shuffle(links.begin(), links.end(), order);
    for (const Point& point : points)
      text += "  " + point.name + ": " + (drawn ? place_text(point.at) : point.form) + "\n";
    text += "links:\n";
    for (const std::string& link : links) text += "  " + link + "\n";
    return text + "joints:\n" + joints_ + "end_effector: {link: crank, at: K}\n";
  }

 private:
  using Place = std::array<long, 3>;  ///< multiples of 1/4
  struct Point {
    std::string name, form;
    Place at;
    bool moves = true;
  };

  static std::string place_text(const Place& at) {
    return "[" + text_of(at[0]) + ", " + text_of(at[1]) + ", " + text_of(at[2]) + "]";
  }
  static std::string axis_text(const Place& n) {
    return "[" + std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]) + "]";
  }
  static long dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  Place within(long size) {
    const auto one = [&] { return static_cast<long>(random_() % static_cast<unsigned>(2 * size + 1)) - size; };
    const long x = one(), y = one(), z = one();
    return {x, y, z};
  }

  void add_crank() {
    const Place at = within(4), arm = {static_cast<long>(random_() % 5), 3, 4};  // as drawn; it turns about x
    points_.push_back({"G", place_text(at), at, false});
    points_.push_back({"K",
                       "['" + text_of(at[0] + arm[0]) + "', '" + text_of(at[1]) + " + 3/4*cos(q) - sin(q)', '" +
                           text_of(at[2]) + " + 3/4*sin(q) + cos(q)']",
                       {at[0] + arm[0], at[1] + arm[1], at[2] + arm[2]}});
    links_.emplace_back("crank: {points: [G, K]}");
    joints_ += "  JG: {revolute: [ground, crank], at: G, axis: [1, 0, 0], actuated: true}\n";
    carrier_ = {{"K", "crank"}};
  }

  void add_dyad() {
    const Point from = points_[random_() % points_.size()];
    if (!from.moves) return;
    const Place at = within(16), n = within(2), foot = within(16);
    const Place rod = minus(at, from.at);
    if (dot(n, n) == 0 || dot(rod, rod) == 0) return;
    const std::string k = std::to_string(links_.size()), r = "R" + k, f = "F" + k,
                      length = "sqrt(" + std::to_string(dot(rod, rod)) + ")/4";
    std::string form, joint;
    Place base = foot;
    if (random_() % 3 == 0) {
      const long ahead = dot(rod, n);
      if (ahead == 0) return;
      base = {at[0] - 8 * n[0], at[1] - 8 * n[1], at[2] - 8 * n[2]};
      form = "{slider: [" + f + ", " + axis_text(n) + "], from: " + from.name + ", length: '" + length +
             "', side: " + (ahead > 0 ? "ahead" : "behind") + "}";
      links_.push_back("M" + k + ": {points: [" + r + "]}");
      joint = "prismatic: [ground, M" + k + "], at: " + r;
    } else {
      const Place arm = minus(at, foot), way = minus(from.at, foot);
      const long n2 = dot(n, n), along = dot(n, arm), radius2 = n2 * dot(arm, arm) - along * along,
                 turn = dot(n, cross(way, arm));
      if (radius2 == 0 || turn == 0) return;
      std::string centre;
      for (std::size_t i = 0; i < 3; ++i)
        centre += (i == 0 ? "[" : ", ") + std::to_string(n2 * foot[i] + along * n[i]) + "/" + std::to_string(4 * n2);
      form = "{dyad: [" + centre + "], " + from.name + "], lengths: ['sqrt(" + std::to_string(radius2) + "/" +
             std::to_string(n2) + ")/4', '" + length + "'], axis: " + axis_text(n) +
             ", side: " + (turn > 0 ? "left" : "right") + "}";
      links_.push_back("M" + k + ": {points: [" + f + ", " + r + "]}");
      joint = "revolute: [ground, M" + k + "], at: " + f;
    }
    links_.push_back("L" + k + ": {points: [" + from.name + ", " + r + "]}");
    points_.push_back({f, place_text(base), base, false});
    points_.push_back({r, form, at});
    joints_ += "  J" + f + ": {" + joint + ", axis: " + axis_text(n) + "}\n";
    joints_ += "  J" + r + ": {spherical: [M" + k + ", L" + k + "], at: " + r + "}\n";
    joints_ += "  JL" + k + ": {spherical: [" + carrier_.at(from.name) + ", L" + k + "], at: " + from.name + "}\n";
    carrier_[r] = "M" + k;
  }

  std::mt19937 random_;
  unsigned seed_;
  std::vector<Point> points_;
  std::vector<std::string> links_;
  std::map<std::string, std::string> carrier_;
  std::string joints_;
};

/// How many of some linkages were compared, and in how many poses.
struct Compared {
  int linkages = 0, poses = 0;
  std::set<std::size_t> sizes = {};
};

int wanted_linkages() {
  const char* const wanted = std::getenv("CLEARLOCI_DESIGNS");
  return wanted != nullptr ? std::atoi(wanted) : 60;
}

void compare(const std::string& constructed, const std::string& drawn, std::size_t links, Compared& so_far) {
  std::optional<Mechanism> hand;
  try {
    hand = parse_mechanism(constructed, "hand.yaml");
  } catch (const core::InputError&) {
    return;  // closes nowhere, or folds: not what this is about
  }
  try {
    so_far.poses += expect_same_places(*hand, parse_mechanism(drawn, "drawn.yaml"), 8, 1e-9);
  } catch (const core::InputError& error) {
    ADD_FAILURE() << error.what() << "\n" << drawn << constructed;
    return;
  }
  so_far.sizes.insert(links);
  ++so_far.linkages;
}

TEST(RandomLinkages, CloseAsThoseConstructedByHand) {
  const int designs = wanted_linkages();
  Compared all;
  std::vector<double> ten_links;  // ms of one processor
  for (unsigned seed = 1; all.linkages < designs && seed < 20U * static_cast<unsigned>(designs); ++seed) {
    Linkage linkage(seed);
    if (linkage.links() < 4) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = linkage.drawn();
    compare(linkage.constructed(), text, linkage.links(), all);
    if (linkage.links() == 10) {
      const std::clock_t start = std::clock();
      (void)constructed_text(text, "drawn.yaml");
      ten_links.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  }
  EXPECT_EQ(all.linkages, designs);
  EXPECT_GT(all.poses, all.linkages);
  EXPECT_TRUE(all.sizes.contains(4) && all.sizes.contains(10));
  std::sort(ten_links.begin(), ten_links.end());
  ASSERT_FALSE(ten_links.empty());
  EXPECT_LT(ten_links[ten_links.size() / 2], 10);
  RecordProperty("milliseconds_of_ten_links", std::to_string(ten_links[ten_links.size() / 2]));
  std::cout << "ten links: " << ten_links[ten_links.size() / 2] << " ms, at most " << ten_links.back() << " ms\n";
}

TEST(RandomLinkages, CloseInSpaceAsThoseConstructedByHand) {
  const int designs = wanted_linkages();
  Compared all;
  for (unsigned seed = 1; all.linkages < designs && seed < 20U * static_cast<unsigned>(designs); ++seed) {
    const LinkageInSpace linkage(seed);
    if (linkage.links() < 4) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    compare(linkage.file(false), linkage.file(true), linkage.links(), all);
  }
  EXPECT_EQ(all.linkages, designs);
  EXPECT_GT(all.poses, all.linkages / 2);
  EXPECT_TRUE(all.sizes.contains(4) && all.sizes.contains(10));
}

}  // namespace
}  // namespace clearloci::mechanism
