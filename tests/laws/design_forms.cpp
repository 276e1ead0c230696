#include "tests/laws/design_forms.hpp"

#include <algorithm>

namespace clearloci::test {
namespace {

using core::Rational;

std::string sum_of(const std::string& first, const Rational& second) {
  return first + (second < 0 ? " - " : " + ") + text_of(Rational(abs(second)));
}

/// Writes forms into the sections of one design, by random numbers of its own.
class FormWriter {
 public:
  FormWriter(std::mt19937& random, bool on_lattice, DesignParts& parts, LawDesign& design)
      : random_(random), on_lattice_(on_lattice), parts_(parts), design_(design) {}

  /// False: a design of this family cannot have it.
  bool write(Form form) {
    switch (form) {
      case Form::weights:
        return !parts_.gravity.empty();
      case Form::shifted:
      case Form::units:
        return true;  // in its numbers
      case Form::frame:
        return in_a_frame();
      case Form::repeat:
        return springs_by_repeat();
      case Form::parameters:
        return with_parameters();
      case Form::irrational:
        return with_roots();
      case Form::spring:
        return spring_to_ground(", free_length: 0");
      case Form::spring_length:
        return spring_to_ground(", free_length: " + length(1, 3));
      case Form::spring_between:
        return spring_between();
      case Form::constant_pull:
        return constant_pull();
      case Form::torsion:
        return torsion_spring();
      case Form::effort:
        return known_effort();
      case Form::limit_distance:
        return limit_of_distance();
      case Form::limit_angle:
        return limit_of_angle();
      case Form::pose_load:
        return load_of_pose();
      case Form::vector_load:
        return load_along_vector();
      case Form::arctangent_load:
        return load_that_levels_off();
      case Form::couple:
        return add_load(", couple: " + number(-12, 12));
      case Form::point_masses:
        return point_masses();
      case Form::fit:
        return by_fit();
      case Form::no_guide_ends:
        return drop("gap") && drop("half_length");
      case Form::no_clearance:
        return drop_clearance();
      case Form::relative_to:
        return relative();
      case Form::driven_pins:
        return drive_pins();
      default:
        return write_option(form);
    }
  }

 private:
  int in(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return in(1, n) == 1; }
  /// Between two quarters.
  Rational quarter(int low, int high) {
    Rational value = on_lattice_ ? Rational(in(low, high), 4) : Rational(in(25 * low, 25 * high), 100);
    value.canonicalize();
    return value;
  }
  std::string number(int low, int high) { return text_of(quarter(4 * low, 4 * high)); }
  std::string length(int low, int high) { return text_of(Rational(parts_.size * quarter(low, high))); }
  /// Its unit of force over its unit of length, for something of the design's size.
  Rational per_length(int force) { return force / parts_.size; }
  /// N/m in every file.
  std::string stiffness() { return text_of(Rational(in(2, 40) * 10 * parts_.unit / parts_.size)); }
  template <class List>
  auto& one_of(List& list) {
    return list[static_cast<std::size_t>(in(0, static_cast<int>(list.size()) - 1))];
  }
  Place around() {
    return {parts_.origin.x + parts_.size * quarter(-4, 4), parts_.origin.y + parts_.size * quarter(-4, 4)};
  }

  bool moves(const std::string& point) const {
    return std::any_of(parts_.points.begin(), parts_.points.end(),
                       [&](const PointText& text) { return text.name == point && !text.fixed; });
  }
  struct End {
    std::string link, point;
  };
  /// Points of links that move.
  std::vector<End> ends() const {
    std::vector<End> list;
    for (const LinkText& link : parts_.links)
      for (const std::string& point : link.points)
        if (moves(point)) list.push_back({link.name, point});
    return list;
  }
  /// Those that no other point is written about.
  std::vector<PointText*> bases() {
    std::vector<PointText*> list;
    if (parts_.coordinates.back() == "psi") return list;
    for (PointText& point : parts_.points)
      if (point.fixed) list.push_back(&point);
    return list;
  }
  std::string ground_point() {
    const std::string name = "H" + std::to_string(++ground_points_);
    parts_.points.push_back({name, text_of(around())});
    return name;
  }

  bool in_a_frame() {
    if (!parts_.lengths) return false;
    static const std::array<const char*, 4> round = {"90 deg", "0", "45 deg", "180 deg"};
    const std::string turned = on_lattice_ ? one_of(round) : std::to_string(in(-170, 170)) + " deg";
    parts_.frames = "  base: {at: O, turned: " + turned + "}\n";
    for (PointText* base : bases()) {
      base->form =
          "{in: base, place: " + text_of(Place{base->fixed->x - parts_.origin.x, base->fixed->y - parts_.origin.y}) +
          "}";
      base->fixed.reset();
    }
    parts_.points.insert(parts_.points.begin(), {"O", text_of(parts_.origin)});
    return true;
  }

  bool springs_by_repeat() {
    const std::vector<End> all = ends();
    if (all.empty()) return false;
    const End end = all[static_cast<std::size_t>(in(0, static_cast<int>(all.size()) - 1))];
    const Place a = around(), b = around();
    parts_.repeat =
        "repeat:\n  i: [1, 2]\n  table: {hx: [" + text_of(a.x) + ", " + text_of(b.x) + "], hy: [" + text_of(a.y) +
        ", " + text_of(b.y) + "]}\n  points: {'K{i}': ['hx{i}', 'hy{i}']}\n  springs:\n    - {links: [" + end.link +
        ", ground], at: [" + end.point + ", 'K{i}'], stiffness: '" + stiffness() + "/{i}', free_length: 0}\n";
    return true;
  }

  /// The place of a base, and what the tool bears.
  bool with_parameters() {
    const std::vector<PointText*> list = bases();
    if (list.empty() || parts_.loads.empty()) return false;
    PointText& base = *list.back();
    const Rational d = base.fixed->x;
    base.form = "[d, " + text_of(base.fixed->y) + "]";
    base.fixed.reset();
    parts_.parameters = "d: " + text_of(d) + ", push: 1";
    design_.values = {{"d", d}, {"push", Rational(1)}};
    std::string& load = parts_.loads.front();
    const std::size_t from = load.find("force: [") + 8, comma = load.find(", ", from), to = load.find(']', comma);
    load = load.substr(0, from) + load.substr(from, comma - from) + "*push, " + load.substr(comma + 2, to - comma - 2) +
           "*push" + load.substr(to);
    return true;
  }

  bool with_roots() {
    const std::vector<PointText*> list = bases();
    if (list.empty()) return false;
    PointText& base = *list.back();
    const std::string size = text_of(Rational(parts_.size / 8));
    base.form = "[" + sum_of(size + "*sqrt(" + std::to_string(one_in(2) ? 2 : 3) + ")", base.fixed->x) + ", " +
                (one_in(2) ? text_of(base.fixed->y)
                           : sum_of(size + "*cos(" + std::to_string(in(1, 17) * 10) + " deg)", base.fixed->y)) +
                "]";
    base.fixed.reset();
    return true;
  }

  bool spring_to_ground(const std::string& more) {
    const std::vector<End> all = ends();
    if (all.empty()) return false;
    const End end = all[static_cast<std::size_t>(in(0, static_cast<int>(all.size()) - 1))];
    parts_.springs.push_back("{links: [" + end.link + ", ground], at: [" + end.point + ", " + ground_point() +
                             "], stiffness: " + stiffness() + more + "}");
    return true;
  }

  std::optional<std::pair<End, End>> two_ends() {
    const std::vector<End> all = ends();
    std::vector<std::pair<End, End>> pairs;
    for (const End& a : all)
      for (const End& b : all)
        if (a.link < b.link && a.point != b.point) pairs.emplace_back(a, b);
    if (pairs.empty()) return std::nullopt;
    return one_of(pairs);
  }
  bool spring_between() {
    const auto pair = two_ends();
    if (!pair) return false;
    parts_.springs.push_back("{links: [" + pair->first.link + ", " + pair->second.link + "], at: [" +
                             pair->first.point + ", " + pair->second.point + "], stiffness: " + stiffness() +
                             ", free_length: 0}");
    return true;
  }
  bool constant_pull() {
    const std::vector<End> all = ends();
    if (all.empty()) return false;
    const End end = all[static_cast<std::size_t>(in(0, static_cast<int>(all.size()) - 1))];
    parts_.springs.push_back("{links: [" + end.link + ", ground], at: [" + end.point + ", " + ground_point() +
                             "], force: " + std::to_string(in(1, 8) * (one_in(3) ? -10 : 10)) + "}");
    return true;
  }

  bool has_direction(const std::string& link) const {
    return link == "ground" || std::any_of(parts_.links.begin(), parts_.links.end(), [&](const LinkText& text) {
             return text.name == link && text.points.size() > 1;
           });
  }
  bool torsion_spring() {
    std::vector<std::string> list;
    for (const JointText& joint : parts_.joints)
      if (joint.type == "revolute" && has_direction(joint.from) && has_direction(joint.to)) list.push_back(joint.name);
    if (list.empty()) return false;
    parts_.springs.push_back("{joint: " + one_of(list) + ", stiffness: " + std::to_string(in(1, 20)) +
                             ", rest: " + std::to_string(on_lattice_ ? 45 * in(-3, 4) : in(-170, 170)) + " deg}");
    return true;
  }

  bool known_effort() {
    std::vector<JointText*> list;
    for (JointText& joint : parts_.joints)
      if (!joint.actuated && joint.effort.empty()) list.push_back(&joint);
    if (list.empty()) return false;
    one_of(list)->effort = number(-12, 12);
    return true;
  }

  bool limit_of_distance() {
    const std::vector<End> all = ends();
    const std::vector<PointText*> list = bases();
    if (all.empty() || list.empty()) return false;
    const std::string least = one_in(3) ? "0" : length(1, 3);
    parts_.limits.push_back("{distance: [" + one_of(list)->name + ", " + one_of(all).point + "], within: [" + least +
                            ", " + length(4, 9) + "]}");
    return true;
  }
  bool limit_of_angle() {
    std::vector<std::array<std::string, 3>> corners;
    for (const LinkText& first : parts_.links)
      for (const LinkText& second : parts_.links)
        if (first.points.size() > 1 && second.points.size() > 1 && first.points[1] == second.points[0])
          corners.push_back({first.points[0], first.points[1], second.points[1]});
    if (corners.empty()) return false;
    const std::array<std::string, 3> corner = one_of(corners);
    parts_.limits.push_back("{angle: [" + corner[0] + ", " + corner[1] + ", " + corner[2] + "], within: [" +
                            std::to_string(5 * in(0, 8)) + " deg, " + std::to_string(5 * in(20, 36)) + " deg]}");
    return true;
  }

  bool add_load(const std::string& more) {
    parts_.loads.push_back("{link: " + parts_.end_link + ", at: " + parts_.end_point + ", force: [" +
                           std::to_string(in(-9, 9) * 10) + ", " + std::to_string(in(-9, 9) * 10) + "]" + more + "}");
    return true;
  }
  void add_forces(const std::string& x, const std::string& y) {
    parts_.loads.push_back("{link: " + parts_.end_link + ", at: " + parts_.end_point + ", force: [" + x + ", " + y +
                           "]}");
  }
  /// A coordinate of the box's middle, about, for loads that turn their sign there.
  std::string off_middle(const std::string& coordinate) {
    const Rational at = (coordinate == "y" ? parts_.origin.y : parts_.origin.x) + parts_.size * quarter(-2, 2);
    return at == 0 ? coordinate : sum_of(coordinate, Rational(-at));
  }
  bool load_of_pose() {
    const std::string& coordinate = one_of(parts_.coordinates);
    const bool length = coordinate == "x" || coordinate == "y";
    const std::string factor = std::to_string(in(1, 9) * 10);
    const std::string term = length ? "-" + text_of(per_length(in(2, 9) * 10)) + "*(" + off_middle(coordinate) + ")"
                                    : factor + "*" + (one_in(2) ? "cos(" : "sin(") + coordinate + ")";
    one_in(2) ? add_forces(term, std::to_string(in(-9, 9) * 10)) : add_forces(std::to_string(in(-9, 9) * 10), term);
    return true;
  }
  bool load_along_vector() {
    const std::vector<PointText*> list = bases();
    if (list.empty()) return false;
    parts_.loads.push_back("{link: " + parts_.end_link + ", at: " + parts_.end_point + ", force: '" +
                           text_of(per_length(in(1, 6) * 10)) + "*(" + one_of(list)->name + " - " + parts_.end_point +
                           ")'}");
    return true;
  }
  bool load_that_levels_off() {
    if (!parts_.lengths) return false;
    add_forces(
        "-" + std::to_string(in(2, 8) * 5) + "*atan(" + text_of(per_length(in(2, 8))) + "*(" + off_middle("x") + "))",
        "0");
    return true;
  }

  bool point_masses() {
    if (parts_.gravity.empty()) return false;
    for (LinkText& link : parts_.links)
      if (moves(link.points.back()) && link.more.find("masses") == std::string::npos) {
        link.more += ", masses: [{at: " + link.points.back() + ", mass: " + text_of(quarter(1, 6)) + "}]";
        return true;
      }
    return false;
  }

  bool by_fit() {
    std::vector<std::string*> list;
    for (JointText& joint : parts_.joints)
      for (std::string& clearance : joint.clearance)
        if (clearance.starts_with("radial")) list.push_back(&clearance);
    if (list.empty()) return false;
    static const std::array<const char*, 3> fits = {"H7/g6", "H8/f7", "H7/h6"};
    *one_of(list) = "fit: " + std::string(one_of(fits)) + ", diameter: " + micrometres(1000 * in(4, 40), parts_.unit);
    return true;
  }
  bool drop(const std::string& key) {
    bool found = false;
    for (JointText& joint : parts_.joints)
      found = std::erase_if(joint.clearance, [&](const auto& candidate) { return candidate.starts_with(key); }) > 0 ||
              found;
    return found;
  }
  /// The motors of telescopic legs in their bases' pins: rods slide freely, and press with the ends of their guides.
  bool drive_pins() {
    bool found = false;
    for (JointText& slide : parts_.joints) {
      if (slide.type != "prismatic" || !slide.from.starts_with("cylinder") || !slide.actuated) continue;
      for (JointText& pin : parts_.joints) {
        if (pin.from != "ground" || pin.to != slide.from) continue;
        slide.actuated = false, pin.actuated = true, found = true;
        std::erase_if(slide.clearance, [](const std::string& candidate) { return candidate.starts_with("axial"); });
        if (!pin.clearance.empty()) pin.clearance.emplace_back("angular: 0.5e-3 rad");
      }
    }
    return found;
  }

  bool drop_clearance() {
    std::vector<JointText*> list;
    for (JointText& joint : parts_.joints)
      if (!joint.clearance.empty()) list.push_back(&joint);
    if (list.size() < 2) return false;
    one_of(list)->clearance.clear();
    return true;
  }
  bool relative() {
    for (const LinkText& link : parts_.links)
      if (link.name != parts_.end_link && link.points.size() > 1) {
        parts_.relative_to = link.name;
        return true;
      }
    return false;
  }

  bool write_option(Form form) {
    using core::Quantity;
    switch (form) {
      case Form::min_force:
        design_.min_force = Rational(on_lattice_ ? 10 * in(1, 6) : in(3, 90));
        return parts_.lengths;
      case Form::min_couple:
        design_.min_couple = parts_.size / parts_.unit * Rational(in(1, 20));
        return parts_.lengths;
      case Form::quantity: {
        static const std::array<std::vector<Quantity>, 6> lists = {
            std::vector{Quantity::fx},          {Quantity::fx, Quantity::fy, Quantity::M},
            {Quantity::f, Quantity::fy},        {Quantity::f, Quantity::N, Quantity::T, Quantity::F},
            {Quantity::end_ahead, Quantity::M}, {Quantity::M}};
        design_.quantities = one_of(lists);
        return true;
      }
      case Form::joint:
        for (const JointText& joint : parts_.joints)
          if (!joint.clearance.empty() && one_in(2)) design_.joints.push_back(joint.name);
        return !design_.joints.empty();
      case Form::other_mode:
        for (const auto& words : parts_.sides) {
          design_.sides.push_back(one_in(2) ? 1 : -1);
          design_.side_names +=
              (design_.side_names.empty() ? "" : ",") + std::string(words[design_.sides.back() > 0 ? 0 : 1]);
        }
        return !parts_.sides.empty();
      case Form::all_modes:
        design_.all_modes = !parts_.sides.empty();
        design_.sides.clear();
        return design_.all_modes;
      case Form::task_tolerances:
        return parts_.lengths && !design_.values.empty();
      default:
        return parts_.lengths;
    }
  }

  std::mt19937& random_;
  bool on_lattice_;
  DesignParts& parts_;
  LawDesign& design_;
  int ground_points_ = 0;
};

struct UnitChoice {
  const char* text;
  Rational per_metre;
};

}  // namespace

namespace {

/// `at_home`: where the family stands by itself, wherever it is drawn to stand.
LawDesign drawn_design(int seed, Family family, int index, const FormSet& allowed, bool at_home) {
  LawDesign design;
  design.seed = seed, design.index = index, design.family = family, design.lattice = index % 2 == 0;
  std::seed_seq base{seed, static_cast<int>(family), index};
  std::mt19937 random(base);
  std::seed_seq more{seed, static_cast<int>(family), index, 1};
  std::mt19937 form_random(more);
  const auto in = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(form_random); };
  // A form that was thought of later is drawn apart: designs without it stay as they were.
  std::seed_seq later{seed, static_cast<int>(family), index, 2};
  std::mt19937 later_random(later);
  FormSet drawn;
  for (const FormRow& row : form_table) {
    const bool wanted = row.form == Form::driven_pins
                            ? std::uniform_int_distribution<int>(1, row.one_in)(later_random) == 1
                            : in(1, row.one_in) == 1;
    drawn.set(static_cast<std::size_t>(row.form), wanted && allowed.test(static_cast<std::size_t>(row.form)));
  }
  const bool weights = has(drawn, Form::weights);
  Standing standing;
  static const std::array<UnitChoice, 4> units = {
      UnitChoice{"{length: mm, angle: deg}", Rational(1000)}, UnitChoice{"{length: cm}", Rational(100)},
      UnitChoice{"{length: mm, force: N, mass: kg}", Rational(1000)}, UnitChoice{"{angle: deg}", Rational(1)}};
  const UnitChoice& unit = units[static_cast<std::size_t>(in(0, 3))];
  if (has(drawn, Form::units)) standing.unit = unit.per_metre;
  if (has(drawn, Form::shifted)) {
    static const std::array<long, 6> sizes = {3, 5, 17, 40, 1000, 1000000};
    const Rational far = sizes[static_cast<std::size_t>(in(0, 5))];
    Rational x(in(-8, 8), design.lattice ? 4 : 7), y(in(-8, 8), design.lattice ? 4 : 9);
    x.canonicalize(), y.canonicalize();
    standing.shift = {far * x, far * y};
    if (at_home) standing.shift = {};
  }
  DesignParts parts = design_parts(random, family, design.lattice, weights, standing);
  if (has(drawn, Form::units)) parts.units = unit.text;
  design.unit = standing.unit;
  FormWriter writer(form_random, design.lattice, parts, design);
  for (const FormRow& row : form_table)
    if (drawn.test(static_cast<std::size_t>(row.form)))
      design.forms.set(static_cast<std::size_t>(row.form), writer.write(row.form));
  if (!has(design.forms, Form::min_force)) design.min_force.reset();
  if (!has(design.forms, Form::min_couple)) design.min_couple.reset();
  design.text = text_of(parts);
  for (const std::string& coordinate : parts.coordinates) {
    const Rational at = coordinate == "x" ? parts.origin.x : coordinate == "y" ? parts.origin.y : Rational(0);
    design.shift.push_back(core::to_double(Rational(at / parts.unit)));
  }
  return design;
}

}  // namespace

LawDesign law_design(int seed, Family family, int index, const FormSet& allowed) {
  LawDesign design = drawn_design(seed, family, index, allowed, false);
  design.home_text = drawn_design(seed, family, index, allowed, true).text;
  return design;
}

std::string arguments_of(const LawDesign& design) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  if (design.all_modes) add("--working-mode all");
  if (!design.sides.empty()) add("--working-mode " + design.side_names);
  if (design.min_force) add("--min-force " + text_of(*design.min_force));
  if (design.min_couple) add("--min-couple " + text_of(*design.min_couple));
  std::string quantities;
  for (const core::Quantity quantity : design.quantities)
    quantities += (quantities.empty() ? "" : ",") + core::to_string(quantity);
  if (!quantities.empty()) add("--quantity " + quantities);
  for (const std::string& joint : design.joints) add("--joint " + joint);
  return text;
}

}  // namespace clearloci::test
