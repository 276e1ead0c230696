// Vectors: [ux, uy], [ux, uy, uz], two points [A, B] for B - A, or an expression over points such as
// cross([1, 0, 0], B - A):
//     sum     := ('-')? product (('+' | '-') product)*
//     product := factor (('*' | '/') factor)*        one factor is a vector, the others are numbers
//     factor  := point | '[' numbers ']' | 'cross(' sum ',' sum ')' | '(' sum ')' | number
#include <algorithm>
#include <cctype>

#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using Kind = VectorExpression::Kind;

constexpr int deepest_nesting = 50;

std::string trimmed(const std::string& text) {
  const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), is_space).base();
  return {first, last};
}

/// A piece of a text and the separator before it.
struct Piece {
  char before = 0;
  std::string text;
};

struct Signed {
  bool negative = false;
  std::string text;
};

/// "-3*B" as 3*B, negative.
Signed without_signs(std::string text) {
  Signed term;
  for (; !text.empty() && (text.front() == '+' || text.front() == '-'); text = trimmed(text.substr(1)))
    term.negative = term.negative != (text.front() == '-');
  term.text = std::move(text);
  return term;
}

/// Whether a + or - after this text is a sign: at its beginning and after * or /.
bool sign_follows(const std::string& text) {
  const std::string before = trimmed(text);
  return before.empty() || std::string_view("+-*/").find(before.back()) != std::string_view::npos;
}

/// Whether a + or - after this text is that of an exponent: "0.2e".
bool exponent_follows(const std::string& text) {
  if (text.empty() || (text.back() != 'e' && text.back() != 'E')) return false;
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; };
  const auto begin = std::find_if_not(text.rbegin(), text.rend(), in_word).base();
  return std::isdigit(static_cast<unsigned char>(*begin)) != 0;
}

VectorExpression negated(VectorExpression v) { return {Kind::negate, {}, 0, {std::move(v)}}; }

class VectorReader {
 public:
  VectorReader(const Mechanism& mechanism, const Value& value, Scope scope)
      : mechanism_(mechanism), value_(value), scope_(scope) {}

  VectorExpression sum(const std::string& text, int depth = 0) const {
    if (depth > deepest_nesting) refuse("it is nested too deeply", "write it in fewer steps");
    const std::vector<Piece> terms = split(text, "+-");
    VectorExpression result;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Signed signed_term = without_signs(terms[i].text);
      VectorExpression term = product(signed_term.text, depth);
      if (signed_term.negative != (terms[i].before == '-')) term = negated(std::move(term));
      result = i == 0 ? std::move(term) : VectorExpression{Kind::add, {}, 0, {std::move(result), std::move(term)}};
    }
    return result;
  }

  VectorExpression components(const std::vector<std::string>& texts) const {
    if (texts.size() != dimension(mechanism_))
      refuse("it has " + std::to_string(texts.size()) + " components",
             dimension(mechanism_) == 2 ? "write [ux, uy]" : "write [ux, uy, uz]");
    VectorExpression result;
    for (const std::string& text : texts) result.numbers.push_back(number(text));
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& mend) const {
    throw InputError(value_.where, value_.what + ": " + problem, mend);
  }

  Expression number(const std::string& text) const { return number(text, value_.field); }

  /// `field`: what it measures (mechanism/units.hpp).
  Expression number(const std::string& text, const std::string& field) const {
    Value part = value_;
    part.node = Node(text);
    part.field = field;
    return scope_ == Scope::parameters ? read_number(mechanism_, part, Sign::any).expression
                                       : read_varying(mechanism_, part);
  }

  /// Cut at any of the separators outside parentheses; a sign at the beginning or after an operator belongs to what
  /// follows it.
  std::vector<Piece> split(const std::string& text, const std::string& separators) const {
    std::vector<Piece> pieces(1);
    int depth = 0;
    for (const char c : text) {
      if (c == '(' || c == '[') ++depth;
      if (c == ')' || c == ']') --depth;
      if (depth < 0) break;
      const std::string& before = pieces.back().text;
      const bool sign = (c == '+' || c == '-') && (sign_follows(before) || exponent_follows(before));
      if (depth == 0 && !sign && separators.find(c) != std::string::npos) {
        pieces.push_back({c, ""});
      } else {
        pieces.back().text += c;
      }
    }
    if (depth != 0) refuse("the parentheses of '" + text + "' do not match", "close each one that is opened");
    for (Piece& piece : pieces) piece.text = trimmed(piece.text);
    return pieces;
  }

  /// The units of a number belong to it: 5 N/mm is one factor.
  std::vector<Piece> with_units(const std::vector<Piece>& pieces) const {
    std::vector<Piece> joined;
    for (const Piece& piece : pieces) {
      const std::string name = piece.text.substr(0, piece.text.find('^'));
      const auto is_named = [&](const auto& one) { return one.name == name; };
      const bool is_name = std::any_of(mechanism_.parameters.begin(), mechanism_.parameters.end(), is_named) ||
                           std::any_of(mechanism_.coordinates.begin(), mechanism_.coordinates.end(), is_named);
      if (!joined.empty() && is_unit(name) && !is_name && !is_vector(joined.back().text))
        joined.back().text += piece.before + piece.text;
      else
        joined.push_back(piece);
    }
    return joined;
  }

  /// Whether a vector is a way between points as it stands.
  static bool is_way(const VectorExpression& v) {
    if (v.kind == Kind::components || v.kind == Kind::scale || v.kind == Kind::cross) return false;
    return std::all_of(v.arguments.begin(), v.arguments.end(), is_way);
  }

  /// Of the factor of a vector: where forces are asked for, one over a length before ways, a pure number before forces.
  std::string field_of_factor(const VectorExpression& v) const {
    return value_.field == "force" && is_way(v) ? "force_over_length" : "";
  }

  bool is_point(const std::string& text) const {
    return std::any_of(mechanism_.points.begin(), mechanism_.points.end(),
                       [&](const Point& point) { return !point.auxiliary && point.name == text; });
  }

  bool is_vector(const std::string& text) const {
    if (text.find('[') != std::string::npos || text.rfind("cross", 0) == 0) return true;
    std::string word;
    for (const char c : text + " ") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
        word += c;
      } else {
        if (is_point(word)) return true;
        word.clear();
      }
    }
    return false;
  }

  VectorExpression product(const std::string& text, int depth) const {
    const std::vector<Piece> factors = with_units(split(text, "*/"));
    std::string scale;
    std::optional<VectorExpression> vector;
    for (const Piece& factor : factors) {
      if (is_vector(factor.text)) {
        if (vector) refuse("'" + text + "' multiplies two vectors", "write cross(a, b) for their cross product");
        if (factor.before == '/') refuse("'" + text + "' divides by a vector", "divide by a number");
        vector = this->factor(factor.text, depth);
      } else {
        const bool first = scale.empty();
        if (factor.before == '/')
          scale += (first ? "1/(" : "/(") + factor.text + ")";
        else
          scale += (first ? "(" : "*(") + factor.text + ")";
      }
    }
    if (!vector) {
      const bool empty = text.empty();
      refuse(empty ? "a vector is missing" : "'" + text + "' is no vector",
             "write such as B - A, [1, 0" + std::string(dimension(mechanism_) == 3 ? ", 0" : "") +
                 "] or two points [A, B]");
    }
    if (scale.empty()) return *vector;
    return {Kind::scale, {number(scale, field_of_factor(*vector))}, 0, {*vector}};
  }

  VectorExpression factor(const std::string& text, int depth) const {
    if (Signed term = without_signs(text); term.text != text) {
      VectorExpression vector = factor(term.text, depth);
      return term.negative ? negated(std::move(vector)) : vector;
    }
    const auto inside = [&](std::size_t start) { return text.substr(start, text.size() - start - 1); };
    if (text.front() == '[' && text.back() == ']') {
      std::vector<std::string> parts;
      for (const Piece& piece : split(inside(1), ",")) parts.push_back(piece.text);
      return components(parts);
    }
    if (text.front() == '(' && text.back() == ')') return sum(inside(1), depth + 1);
    const std::size_t open = text.find('(');
    if (open != std::string::npos && trimmed(text.substr(0, open)) == "cross" && text.back() == ')') {
      if (dimension(mechanism_) == 2) refuse("there is no cross product in the plane", "write [ux, uy] or B - A");
      const std::vector<Piece> parts = split(inside(open + 1), ",");
      if (parts.size() != 2) refuse("'" + text + "' needs two vectors", "write cross(a, b)");
      return {Kind::cross, {}, 0, {sum(parts[0].text, depth + 1), sum(parts[1].text, depth + 1)}};
    }
    if (!is_point(text)) refuse("'" + text + "' is no vector", "name a point, or write such as B - A");
    VectorExpression result;
    result.kind = Kind::point;
    Value part = value_;
    part.node = Node(text);
    result.point = read_point_name(mechanism_, part);
    return result;
  }

  const Mechanism& mechanism_;
  const Value& value_;
  Scope scope_;
};

}  // namespace

std::vector<Value> components(const Mechanism& mechanism, const Value& value) {
  constexpr std::size_t spatial = 3;
  if (mechanism.space == Space::planar && value.is_sequence() && value.node.size() == spatial)
    throw InputError(value.where, value.what + " has three components, but the mechanism is planar",
                     "write space: spatial at the top of the file, or two components");
  return elements(value, static_cast<int>(dimension(mechanism)));
}

VectorExpression read_vector_expression(const Mechanism& mechanism, const Value& value, Scope scope) {
  const VectorReader reader(mechanism, value, scope);
  constexpr std::size_t longest_text = 5000;
  if (!value.is_sequence() && text_of(value).size() > longest_text)
    throw InputError(value.where, value.what + " has more than 5000 characters", "write it in fewer steps");
  if (!value.is_sequence()) return reader.sum(text_of(value));
  std::vector<std::string> parts;
  for (const Value& part : elements(value)) parts.push_back(text_of(part));
  const auto is_point = [&](const std::string& name) {
    return std::any_of(mechanism.points.begin(), mechanism.points.end(),
                       [&](const Point& point) { return !point.auxiliary && point.name == name; });
  };
  if (parts.size() == 2 && std::any_of(parts.begin(), parts.end(), is_point)) {
    if (parts[0] == parts[1])
      throw InputError(value.where, value.what + " names the point " + parts[0] + " twice",
                       "name two different points");
    return reader.sum(parts[1] + " - " + parts[0]);
  }
  return reader.components(parts);
}

std::set<PointIndex> points_of(const VectorExpression& vector) {
  std::set<PointIndex> found;
  if (vector.kind == Kind::point) found.insert(vector.point);
  for (const VectorExpression& argument : vector.arguments) found.merge(points_of(argument));
  return found;
}

}  // namespace clearloci::mechanism
