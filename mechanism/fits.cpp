#include "mechanism/fits.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/reduced.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::SourcePosition;

constexpr std::size_t ranges = 13;
using Row = std::array<int, ranges>;

/// Nominal sizes up to and including these, mm.
constexpr Row up_to = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};

/// Standard tolerances IT5 to IT11, µm.
constexpr int first_grade = 5, last_grade = 11;
constexpr std::array<Row, 7> tolerances = {{{4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27},
                                            {6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40},
                                            {10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63},
                                            {14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97},
                                            {25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155},
                                            {40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250},
                                            {60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400}}};

/// Fundamental deviations, µm: of a shaft its upper one is minus this, of a hole its lower one is this.
struct Letter {
  char name;
  Row deviation;
};
constexpr std::array<Letter, 5> letters = {{{'d', {20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230}},
                                            {'e', {14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135}},
                                            {'f', {6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68}},
                                            {'g', {2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20}},
                                            {'h', {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}};

/// A hole or a shaft: "H7", "g6".
struct Zone {
  const Letter* letter = nullptr;
  int grade = 0;
};

std::optional<Zone> zone_named(const std::string& text, bool hole) {
  if (text.size() < 2 || text.size() > 3) return std::nullopt;
  const char symbol = text.front();
  if ((symbol >= 'A' && symbol <= 'Z') != hole) return std::nullopt;
  const char small = hole ? static_cast<char>(symbol - 'A' + 'a') : symbol;
  const auto* const letter =
      std::find_if(letters.begin(), letters.end(), [&](const Letter& one) { return one.name == small; });
  const std::string digits = text.substr(1);
  const bool is_number = std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (letter == letters.end() || !is_number || digits.front() == '0') return std::nullopt;
  const int grade = std::stoi(digits);
  if (grade < first_grade || grade > last_grade) return std::nullopt;
  return Zone{letter, grade};
}

std::string micrometres(const Rational& metres) {
  const Rational half_micrometres = metres * 2000000;  // tables have whole ones of diameters
  const mpz_class whole = half_micrometres.get_num() / 2;
  return whole.get_str() + (half_micrometres.get_num() % 2 != 0 ? ".5" : "");
}

}  // namespace

DiametralClearance diametral_clearance(const std::string& fit, const Rational& diameter, const SourcePosition& where) {
  const std::size_t slash = fit.find('/');
  const auto hole = slash == std::string::npos ? std::nullopt : zone_named(fit.substr(0, slash), true);
  const auto shaft = slash == std::string::npos ? std::nullopt : zone_named(fit.substr(slash + 1), false);
  if (!hole || !shaft)
    throw InputError(where, "'" + fit + "' is not a known clearance fit",
                     "write one such as H7/g6: holes D, E, F, G, H, shafts d, e, f, g, h, grades 5 to 11");
  const Rational millimetres = diameter * 1000;
  const auto* const range = std::find_if(up_to.begin(), up_to.end(), [&](int upper) { return millimetres <= upper; });
  if (sgn(diameter) <= 0 || range == up_to.end())
    throw InputError(where, "the tables of fits are for diameters above 0 and up to 500 mm",
                     "write the clearance itself: radial: ...");
  const auto k = static_cast<std::size_t>(range - up_to.begin());
  const auto tolerance = [&](const Zone& zone) {
    return tolerances[static_cast<std::size_t>(zone.grade - first_grade)][k];
  };
  const int least = hole->letter->deviation[k] + shaft->letter->deviation[k];
  return {least, least + tolerance(*hole) + tolerance(*shaft)};
}

Fit read_fit(const Mechanism& mechanism, const Value& fit, const Value& diameter) {
  Fit result;
  result.name = text_of(fit);
  result.diameter = read_number(mechanism, diameter, Sign::positive).value;
  const DiametralClearance clearance = diametral_clearance(result.name, result.diameter, fit.where);
  result.least = core::reduced(clearance.least, 2000000);
  result.largest = core::reduced(clearance.largest, 2000000);
  return result;
}

std::vector<std::string> fit_notes(const Mechanism& mechanism) {
  std::vector<std::pair<std::string, std::string>> notes;  // joints, and what they are
  for (const Joint& joint : mechanism.joints) {
    if (!joint.clearance || !joint.clearance->fit) continue;
    const Fit& fit = *joint.clearance->fit;
    const Rational millimetres = fit.diameter * 1000;
    const std::string sentence = fit.name + " at " + core::to_string(millimetres) + " mm: a radial clearance of " +
                                 micrometres(fit.least) + " to " + micrometres(fit.largest) +
                                 " µm (ISO 286-1:2010), of which the largest is taken";
    const auto alike =
        std::find_if(notes.begin(), notes.end(), [&](const auto& note) { return note.second == sentence; });
    if (alike == notes.end())
      notes.emplace_back(joint.name, sentence);
    else
      alike->first += ", " + joint.name;
  }
  std::vector<std::string> sentences;
  for (const auto& [joints, note] : notes) {
    std::string sentence = joints;
    sentence += ": ";
    sentence += note;
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace clearloci::mechanism
