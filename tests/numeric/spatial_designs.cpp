#include "tests/numeric/spatial_designs.hpp"

#include <array>
#include <cmath>

namespace clearloci::test {

namespace {

class Numbers {
 public:
  explicit Numbers(std::mt19937& random) : random_(random) {}

  int in(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  /// A multiple of 1/200 within `spread` of `about`.
  std::string near(double about, double spread) {
    const int least = static_cast<int>(std::lround((about - spread) * 200));
    const int most = static_cast<int>(std::lround((about + spread) * 200));
    return std::to_string(in(least, most)) + "/200";
  }

 private:
  std::mt19937& random_;
};

std::string head(const std::string& name, const std::string& z) {
  return "format: 1\nname: " + name + "\nspace: spatial\nparameters: {z: " + z +
         "}\nworkspace:\n  x: [-2/5, 2/5]\n  y: [-2/5, 2/5]\npoints:\n  P: [x, y, z]\n";
}

std::string triple(const std::string& x, const std::string& y, const std::string& z) {
  return "[" + x + ", " + y + ", " + z + "]";
}

std::string load(Numbers& n) {
  const auto component = [&] { return std::to_string(n.in(-20, 20) * 10); };
  const std::string x = component(), y = component();
  std::string text = "loads:\n  - {link: platform, at: P, force: " + triple(x, y, std::to_string(-n.in(5, 30) * 10));
  if (n.in(0, 1) == 0)
    text += ", couple: [" + std::to_string(n.in(-9, 9)) + ", " + std::to_string(n.in(-9, 9)) + ", 2]";
  return text + "}\nend_effector: {link: platform, at: P}\n";
}

std::string platform_points(int legs) {
  std::string text = "  platform: {points: [P";
  for (int i = 1; i <= legs; ++i) text += ", B" + std::to_string(i);
  return text + "]";
}

}  // namespace

std::string random_gough_stewart(std::mt19937& random, bool with_weights) {
  Numbers n(random);
  std::string text = head("random 6-UPS", n.near(0.6, 0.15)), links, joints;
  const std::array<double, 6> angles = {0.2, 0.85, 1.95, 2.85, 4.07, 5.22};
  // A small turn about x and y, a larger one about z: what is left of it is a shear, but the points are what counts.
  const double tilt_x = n.in(-30, 30) / 100.0, tilt_y = n.in(-30, 30) / 100.0, turn = n.in(-60, 60) / 100.0;
  for (int i = 0; i < 6; ++i) {
    const std::string k = std::to_string(i + 1);
    const double a = angles[static_cast<std::size_t>(i)], b = a + turn;
    text += "  A" + k + ": " +
            triple(n.near(0.5 * std::cos(a), 0.06), n.near(0.5 * std::sin(a), 0.06),
                   n.in(0, 2) == 0 ? n.near(0, 0.04) : "0") +
            "\n";
    const double x = 0.24 * std::cos(b + (i % 2 == 0 ? 0.25 : -0.25)), y = 0.24 * std::sin(b);
    text += "  B" + k + ": " +
            triple("x + " + n.near(x, 0.03), "y + " + n.near(y, 0.03), "z + " + n.near(tilt_x * x + tilt_y * y, 0.02)) +
            "\n";
    const std::string rod = with_weights ? ", mass: 2, com: B" + k + ", inertia: 0" : "";
    const std::string cylinder =
        with_weights && i == 0 ? ", mass: 3, com: {on: [A1, B1], offset: [1/5]}, inertia: 0" : "";
    links += "  cylinder" + k + ": {points: [A" + k + "]" + cylinder + "}\n  rod" + k + ": {points: [B" + k + "]" +
             rod + "}\n";
    const std::string axis = n.in(0, 1) == 0 ? "[1, 0, 0]" : "[0, 1, 0]";
    joints += "  U" + k + ": {universal: [ground, cylinder" + k + "], at: A" + k + ", axes: [" + axis + ", 'cross(" +
              axis + ", B" + k + " - A" + k + ")'], clearance: {radial: 20e-6}}\n  S" + k + ": {prismatic: [cylinder" +
              k + ", rod" + k + "], at: B" + k + ", axis: B" + k + " - A" + k +
              ", actuated: true, clearance: {axial: 5e-6}}\n  B" + k + ": {spherical: [rod" + k + ", platform], at: B" +
              k + ", clearance: {radial: 10e-6}}\n";
  }
  text += "links:\n" + platform_points(6) + (with_weights ? ", mass: 8, com: P, inertia: 0" : "") + "}\n" + links +
          "joints:\n" + joints + load(n);
  if (with_weights) text += "gravity: [0, 0, -9.81]\n";
  return text;
}

std::string random_three_upu(std::mt19937& random) {
  Numbers n(random);
  std::string text = head("random 3-UPU", n.near(0.6, 0.15)), links, joints;
  const std::array<double, 3> angles = {0, 2.1, 4.2};
  for (int i = 0; i < 3; ++i) {
    const std::string k = std::to_string(i + 1);
    const double a = angles[static_cast<std::size_t>(i)];
    text += "  A" + k + ": " + triple(n.near(0.5 * std::cos(a), 0.1), n.near(0.5 * std::sin(a), 0.1), "0") + "\n";
    text += "  B" + k + ": " +
            triple("x + " + n.near(0.2 * std::cos(a), 0.04), "y + " + n.near(0.2 * std::sin(a), 0.04),
                   "z + " + n.near(0, 0.02)) +
            "\n";
    links += "  cylinder" + k + ": {points: [A" + k + "]}\n  rod" + k + ": {points: [B" + k + "]}\n";
    // A direction of the ground, the same on the platform: legs then keep its orientation.
    const std::string u = triple(n.near(-std::sin(a), 0.2), n.near(std::cos(a), 0.2), "0");
    const std::string v = "'cross(" + u + ", B" + k + " - A" + k + ")'";
    joints += "  U" + k + ": {universal: [ground, cylinder" + k + "], at: A" + k + ", axes: [" + u + ", " + v +
              "], clearance: {radial: 20e-6}}\n  S" + k + ": {prismatic: [cylinder" + k + ", rod" + k + "], at: B" + k +
              ", axis: B" + k + " - A" + k + ", actuated: true, clearance: {axial: 5e-6}}\n  V" + k +
              ": {universal: [rod" + k + ", platform], at: B" + k + ", axes: [" + v + ", " + u +
              "], clearance: {radial: 10e-6}}\n";
  }
  return text + "links:\n" + platform_points(3) + "}\n" + links + "joints:\n" + joints + load(n);
}

std::string random_three_leg(std::mt19937& random) {
  Numbers n(random);
  const bool cylinders = n.in(0, 1) == 0;
  // The legs turn about parallel axes, and their ends move in planes across these: cosine and sine of how those lie.
  constexpr std::array<std::array<const char*, 2>, 3> turns = {{{"1", "0"}, {"4/5", "3/5"}, {"12/13", "-5/13"}}};
  const auto [c, s] = turns[static_cast<std::size_t>(n.in(0, 2))];
  const auto turned = [c = c, s = s](const std::string& x, const std::string& y, const std::string& z) {
    const std::string cosine = c, sine = s;
    return triple(x, cosine + "*(" + y + ") - " + sine + "*(" + z + ")",
                  sine + "*(" + y + ") + " + cosine + "*(" + z + ")");
  };
  std::string text =
      "format: 1\nname: random " + std::string(cylinders ? "3-RCU" : "3-RPS") +
      "\nspace: spatial\nparameters: {z: " + n.near(0.5, 0.1) +
      ", th: 0}\nworkspace:\n  x: [-2/5, 2/5]\n  y: [-2/5, 2/5]\npoints:\n  P: " + turned("x", "y", "z") + "\n";
  std::string links, joints, loads;
  const std::string u = turned("0", "0", "1");
  const std::array<double, 3> angles = {0.1, 2.2, 4.3};
  for (int i = 0; i < 3; ++i) {
    const std::string k = std::to_string(i + 1);
    const double a = angles[static_cast<std::size_t>(i)];
    const std::string x = n.near(1.1 * std::cos(a), 0.1), y = n.near(1.1 * std::sin(a), 0.1), up = n.near(0, 0.04);
    text += "  A" + k + ": " + turned(x, y, n.near(0, 0.1)) + "\n  D" + k + ": " + turned(x, y, "z + " + up) + "\n";
    const std::string bx = n.near(0.2 * std::cos(a), 0.04), by = n.near(0.2 * std::sin(a), 0.04);
    text += "  B" + k + ": " +
            turned("x + " + bx + "*cos(th) - " + by + "*sin(th)", "y + " + bx + "*sin(th) + " + by + "*cos(th)",
                   "z + " + up) +
            "\n";
    links += "  crank" + k + ": {points: [A" + k + ", D" + k + "]}\n  rod" + k + ": {points: [B" + k + "]}\n";
    joints += "  R" + k + ": {revolute: [ground, crank" + k + "], at: A" + k + ", axis: " + u + ", " +
              (cylinders ? "actuated: true, clearance: {radial: 20e-6, angular: 1e-4}" : "clearance: {radial: 20e-6}") +
              "}\n  C" + k + ": {" + (cylinders ? "cylindrical" : "prismatic") + ": [crank" + k + ", rod" + k +
              "], at: B" + k + ", axis: B" + k + " - D" + k +
              (cylinders ? ", clearance: {radial: 15e-6}" : ", actuated: true, clearance: {axial: 5e-6}") + "}\n";
    // Across the cylinder: along it the rod would be free to turn.
    const std::string px = n.near(-std::sin(a), 0.2), py = n.near(std::cos(a), 0.2);
    joints +=
        cylinders
            ? "  V" + k + ": {universal: [rod" + k + ", platform], at: B" + k + ", axes: [" + u + ", " +
                  turned(px + "*cos(th) - " + py + "*sin(th)", px + "*sin(th) + " + py + "*cos(th)", n.near(0, 0.2)) +
                  "], clearance: {radial: 10e-6}}\n"
            : "  V" + k + ": {spherical: [rod" + k + ", platform], at: B" + k + ", clearance: {radial: 10e-6}}\n";
    const auto component = [&] { return std::to_string(n.in(-10, 10) * 10); };
    const std::string fx = component(), fy = component();
    loads += "  - {link: crank" + k + ", at: A" + k + ", force: " + triple(fx, fy, component()) + "}\n";
    // Else nothing would turn a rod about its cylinder.
    if (cylinders) {
      const auto couple = [&] { return std::to_string(n.in(-9, 9)); };
      const std::string mx = couple(), my = couple();
      loads += "  - {link: rod" + k + ", couple: " + triple(mx, my, couple()) + "}\n";
    }
  }
  std::string of_platform = load(n);
  const std::size_t end = of_platform.find("end_effector");
  of_platform.insert(end, loads);
  return text + "links:\n" + platform_points(3) + "}\n" + links + "joints:\n" + joints + of_platform;
}

std::string random_delta(std::mt19937& random, bool sliders, bool with_weights) {
  Numbers n(random);
  std::string text = head(sliders ? "random 3-PUU" : "random 3-RUU", n.near(-0.6, 0.05)), links, joints;
  const std::array<double, 3> angles = {0.1, 2.2, 4.3};
  for (int i = 0; i < 3; ++i) {
    const std::string k = std::to_string(i + 1);
    const double a = angles[static_cast<std::size_t>(i)];
    text += "  A" + k + ": " +
            triple(n.near(0.25 * std::cos(a), 0.04), n.near(0.25 * std::sin(a), 0.04), n.near(0, 0.03)) + "\n";
    text += "  C" + k + ": " +
            triple("x + " + n.near(0.06 * std::cos(a), 0.02), "y + " + n.near(0.06 * std::sin(a), 0.02),
                   "z + " + n.near(0, 0.02)) +
            "\n";
    // The direction about which both universal joints turn, roughly along the base's rim.
    const std::string u = triple(n.near(-std::sin(a), 0.15), n.near(std::cos(a), 0.15), n.near(0, 0.1));
    const std::string along = triple(n.near(0.4 * std::cos(a), 0.1), n.near(0.4 * std::sin(a), 0.1), "1");
    const std::string v = "'cross(" + u + ", C" + k + " - B" + k + ")'";
    text += "  B" + k + ": " +
            (sliders ? "{slider: [A" + k + ", " + along + "], from: C" + k + ", length: " + n.near(0.7, 0.05) +
                           ", side: ahead}"
                     : "{dyad: [A" + k + ", C" + k + "], lengths: [" + n.near(0.27, 0.03) + ", " + n.near(0.65, 0.05) +
                           "], axis: " + u + ", side: " + (n.in(0, 3) == 0 ? "left" : "right") + "}") +
            "\n";
    links += "  crank" + k + ": {points: [" + (sliders ? "" : "A" + k + ", ") + "B" + k + "]}\n  forearm" + k +
             ": {points: [B" + k + ", C" + k + "]" + (with_weights ? ", mass: 1/2" : "") + "}\n";
    joints += "  A" + k + (sliders ? ": {prismatic" : ": {revolute") + ": [ground, crank" + k +
              "], at: " + (sliders ? "B" + k + ", axis: " + along : "A" + k + ", axis: " + u) +
              ", actuated: true, clearance: " + (sliders ? "{axial: 5e-6}" : "{radial: 10e-6, angular: 1e-4}") +
              "}\n  B" + k + ": {universal: [crank" + k + ", forearm" + k + "], at: B" + k + ", axes: [" + u + ", " +
              v + "], clearance: {radial: 10e-6}}\n  C" + k + ": {universal: [forearm" + k + ", platform], at: C" + k +
              ", axes: [" + v + ", " + u + "], clearance: {radial: 10e-6}}\n";
  }
  text += "links:\n  platform: {points: [P, C1, C2, C3]" +
          std::string(with_weights ? ", mass: 1, com: P, inertia: 0" : "") + "}\n" + links + "joints:\n" + joints +
          load(n);
  if (with_weights) text += "gravity: [0, 0, -9.81]\n";
  return text;
}

}  // namespace clearloci::test
