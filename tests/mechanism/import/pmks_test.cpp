// PMKS+: the codec, units, and what joints and links mean.
#include "tests/mechanism/import/imported.hpp"

namespace clearloci::mechanism {
namespace {

TEST(Pmks, ReadsMassesAndCentres) {
  const Imported file = imported("pmks/four_bar.txt");
  const auto links = section(file, "links");
  EXPECT_EQ(links.at("AB"), "{points: [A, B], mass: 1, inertia: 0.1}");
  EXPECT_EQ(links.at("BC"), "{points: [B, C], mass: 2, inertia: 0.2}");
  EXPECT_EQ(section(file, "joints").at("A"),
            "{revolute: [ground, AB], at: A, actuated: true, clearance: {radial: 20e-6 m}}  # turns at -10 rpm");
  EXPECT_NE(file.text.find("gravity: [0, -9.81]"), std::string::npos);
}

TEST(Pmks, ReadsAnAddressAsItsText) {
  const Imported address = imported("pmks/address.txt"), text = imported("pmks/four_bar.txt");
  EXPECT_EQ(address.text.substr(address.text.find("format:")), text.text.substr(text.text.find("format:")));
  std::string line = bytes_of(path_of("pmks/address.txt"));
  line.pop_back();
  const Imported direct = import_file(line);
  EXPECT_EQ(direct.text.substr(direct.text.find("format:")), text.text.substr(text.text.find("format:")));
}

/// 100 g and 10 kg cm^2 with lengths in cm.
TEST(Pmks, HasGramsWithCentimetres) {
  const Imported file = imported("pmks/centimetres.txt");
  EXPECT_NE(file.text.find("units: {length: cm}"), std::string::npos);
  EXPECT_EQ(section(file, "links").at("AB"), "{points: [A, B], mass: 0.1, inertia: 0.001}");
}

TEST(Pmks, PutsASliderOnTheGround) {
  const auto joints = section(imported("pmks/slider.txt"), "joints");
  EXPECT_EQ(joints.at("D"), "{prismatic: [ground, CD], at: C, axis: [1, 0]}");
  EXPECT_EQ(joints.at("C").substr(0, 26), "{revolute: [BC, CD], at: C");
}

/// The text has 1.571 rad, and means a right angle.
TEST(Pmks, RoundsTheDirectionOfAGuideToWhatWasMeant) {
  const Imported file = imported("pmks/inclined_slider.txt");
  EXPECT_EQ(section(file, "joints").at("D"), "{prismatic: [ground, CD], at: C, axis: [0, 1]}");
  EXPECT_TRUE(has_note(file, "joint D is taken at 90 deg"));
}

TEST(Pmks, PutsAPinIntoASlotOfALink) {
  const Imported file = imported("pmks/slot.txt");
  EXPECT_EQ(section(file, "joints").at("P"), "{prismatic: [DH, BP], at: B, axis: [D, H]}");
  const auto at = places(file);
  const auto &d = at.at("D"), &h = at.at("H"), &b = at.at("B");
  EXPECT_EQ((h[0] - d[0]) * (b[1] - d[1]) - (h[1] - d[1]) * (b[0] - d[0]), 0);
}

TEST(Pmks, MakesOneLinkOfWeldedOnes) {
  EXPECT_EQ(section(imported("pmks/plate_of_welded_links.txt"), "links").at("BC_CE"), "{points: [B, C, E]}  # BC-CE");
  const Imported file = imported("pmks/welded_joint.txt");
  EXPECT_EQ(section(file, "links").count("WE"), 0U);
  EXPECT_EQ(section(file, "links").at("BCW"), "{points: [B, C, E]}");
  EXPECT_TRUE(has_note(file, "welded: link WE"));
}

/// A force of 25 N along its arrow, inwards, that turns with link BC.
TEST(Pmks, KeepsAForceThatTurns) {
  const Imported file = imported("pmks/force_that_turns.txt");
  const std::string& load = file.text;
  EXPECT_NE(load.find("{link: BC, at: Q_F1, force: '"), std::string::npos) << load;
  const auto at = places(file);
  const auto &q = at.at("Q_F1"), &r = at.at("R_F1");
  EXPECT_NEAR(q[0], 0.075, 1e-12);
  EXPECT_NEAR(q[1], 0.065, 1e-12);
  EXPECT_NEAR(r[0], 0.075, 1e-12);
  EXPECT_LT(r[1], q[1]);
  const std::size_t start = load.find("force: '") + 8;
  EXPECT_NEAR(std::stod(load.substr(start)) * apart(q, r), 25, 1e-8);
}

TEST(Pmks, PinsThreeLinksAtOnePlace) {
  const Imported file = imported("pmks/triple_pin.txt");
  const auto joints = section(file, "joints");
  EXPECT_EQ(joints.at("C").substr(0, 26), "{revolute: [BC, CD], at: C");
  EXPECT_EQ(joints.at("C_2").substr(0, 26), "{revolute: [BC, CE], at: C");
  EXPECT_TRUE(has_note(file, "more than two links meet at C"));
}

/// Every address that was cut short is refused by its place, or is none that is known.
TEST(Pmks, RefusesWhatWasCutShort) {
  const std::string text(bytes_of(path_of("pmks/four_bar.txt")));
  const std::string whole = text.substr(0, text.size() - 1);
  int cut_short = 0;
  for (std::size_t length = 1; length < whole.size(); ++length) {
    const std::string part = whole.substr(0, length);
    if (import_format(part).empty()) continue;
    std::string why;
    try {
      // A length that fits by chance may leave a whole mechanism, without its last links.
      const Imported imported = import_text(part, "part");
      EXPECT_NE(imported.text, import_text(whole, "part").text);
    } catch (const core::InputError& error) {
      why = error.what();
      ++cut_short;
    }
    EXPECT_TRUE(why.empty() || why.find("part") != std::string::npos) << why;
  }
  EXPECT_GT(cut_short, 50);
}

TEST(Pmks, SaysWhereALetterIsNoDigit) {
  std::string text(bytes_of(path_of("pmks/four_bar.txt")));
  const std::size_t at = text.find("B,B,U,e");
  text[at + 4] = '!';
  const std::string why = refusal_of(text);
  EXPECT_NE(why.find("source:1:" + std::to_string(at + 5) + ": x of joint B '!'"), std::string::npos) << why;
}

TEST(Pmks, RefusesAnAddressWithoutAMechanism) {
  EXPECT_THROW((void)import_file("https://example.org/"), core::InputError);
}

}  // namespace
}  // namespace clearloci::mechanism
