// Recursive descent over the grammar of mechanism-file.md:
//     sum     := product (('+' | '-') product)*
//     product := signed (('*' | '/') signed | units)*         30 deg = 30*(pi/180), the only multiplication left unsaid
//     units   := unit ('^' whole)? (('*' | '/')? unit ('^' whole)?)*      of mechanism/units.hpp: 5 N/mm, 2 kg*m^2
//     signed  := ('+' | '-') signed | power
//     power   := primary ('^' signed)?                        right-associative; -a^2 = -(a^2)
//     primary := number | name | 'pi' | 'deg' | function '(' sum ')' | '(' sum ')'
#include <cctype>
#include <optional>
#include <stdexcept>

#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using Kind = Expression::Kind;

// Deeper nesting is no expression a person wrote; the bounds keep the recursion within the stack.
constexpr int deepest_nesting = 200;
constexpr std::size_t longest_text = 5000;

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<Kind> function_named(const std::string& name) {
  if (name == "sqrt") return Kind::sqrt;
  if (name == "cos") return Kind::cos;
  if (name == "sin") return Kind::sin;
  if (name == "atan") return Kind::atan;
  return std::nullopt;
}

class Parser {
 public:
  Parser(const std::string& text, const core::SourcePosition& where, const std::set<std::string>& names)
      : text_(text), where_(where), names_(names) {}

  Expression parse() {
    if (text_.size() > longest_text) fail(0, "an expression of more than 5000 characters", "break it into parameters");
    skip_space();
    if (at_end()) fail(0, "an empty expression", "write a number or an expression such as 2*L");
    Expression result = sum();
    if (!at_end()) refuse_rest();
    return result;
  }

 private:
  [[noreturn]] void fail(std::size_t offset, const std::string& problem, const std::string& mend) const {
    core::SourcePosition place = where_;
    if (place.line > 0 && place.column > 0) place.column += static_cast<int>(offset);
    throw InputError(place, problem, mend);
  }

  /// What stands at the current place, for a message: a name, a number, or one character (all bytes of it).
  std::string here() const {
    std::size_t end = at_;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '.')) ++end;
    if (end == at_) {
      ++end;
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
    }
    return text_.substr(at_, end - at_);
  }

  [[noreturn]] void refuse_rest() const {
    const std::string found = here();
    const std::string problem = "unexpected '" + found + "' in the expression '" + text_ + "'";
    if (found == ")") fail(at_, problem, "remove it or open a parenthesis before it");
    if (found == ",") fail(at_, problem, "decimals are written with a point: 0.5");
    if (found == "°") fail(at_, problem, "write deg");
    if (found.front() == '.') fail(at_, problem, "a number has one decimal point");
    if (is_letter(found.front()) || is_digit(found.front()) || found == "(")
      fail(at_, problem, "write an operator before it; a product needs *, as in 2*L");
    fail(at_, problem, "expressions have + - * / ^ ( ) sqrt cos sin atan pi deg");
  }

  bool at_end() const { return at_ >= text_.size(); }
  void skip_space() {
    while (!at_end() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    if (at_end() || text_[at_] != c) return false;
    ++at_;
    skip_space();
    return true;
  }

  std::string peek_name() const {
    std::size_t end = at_;
    if (end < text_.size() && is_letter(text_[end]))
      while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(at_, end - at_);
  }
  void skip(std::size_t count) {
    at_ += count;
    skip_space();
  }

  Expression sum() {
    Expression left = product();
    for (;;) {
      if (take('+')) {
        left = Expression::apply(Kind::add, {left, product()});
      } else if (take('-')) {
        left = Expression::apply(Kind::add, {left, Expression::apply(Kind::negate, {product()})});
      } else {
        return left;
      }
    }
  }

  /// A unit at the current place, with its power.
  Expression unit() {
    const std::string name = peek_name();
    skip(name.size());
    Expression result = unit_symbol(name);
    if (!take('^')) return result;
    const bool negative = take('-');
    const std::size_t start = at_;
    if (at_end() || !is_digit(text_[at_])) fail(at_, "a unit has no power here", "write such as m^2");
    const Expression exponent = number();
    if (exponent.value().get_den() != 1 || exponent.value() > largest_unit_power)
      fail(start, "a unit to this power", "write a whole one up to 4");
    return Expression::apply(Kind::power,
                             {result, Expression::number(negative ? -exponent.value() : exponent.value())});
  }

  /// After a unit: whether `*` or `/` is followed by another one, and not by a name of the file.
  bool unit_follows(char separator) const {
    if (at_end() || text_[at_] != separator) return false;
    std::size_t at = at_ + 1;
    while (at < text_.size() && std::isspace(static_cast<unsigned char>(text_[at]))) ++at;
    std::size_t end = at;
    while (end < text_.size() && (is_letter(text_[end]) || (end > at && is_digit(text_[end])))) ++end;
    const std::string name = text_.substr(at, end - at);
    return is_unit(name) && !names_.contains(name);
  }

  /// What stands in front of its units, with them.
  Expression with_units(Expression left) {
    left = Expression::apply(Kind::multiply, {left, unit()});
    for (;;) {
      const bool divides = unit_follows('/');
      if (divides || unit_follows('*')) {
        skip(1);
        left = Expression::apply(divides ? Kind::divide : Kind::multiply, {left, unit()});
      } else if (is_unit(peek_name())) {
        left = Expression::apply(Kind::multiply, {left, unit()});
      } else {
        return left;
      }
    }
  }

  Expression product() {
    Expression left = signed_power();
    for (;;) {
      if (take('*')) {
        left = Expression::apply(Kind::multiply, {left, signed_power()});
      } else if (take('/')) {
        left = Expression::apply(Kind::divide, {left, signed_power()});
      } else if (is_unit(peek_name())) {
        left = with_units(left);
      } else {
        return left;
      }
    }
  }

  Expression signed_power() {
    const Nesting nesting(*this);
    if (take('+')) return signed_power();
    if (take('-')) return Expression::apply(Kind::negate, {signed_power()});
    Expression base = primary();
    if (take('^')) return Expression::apply(Kind::power, {base, signed_power()});
    return base;
  }

  Expression primary() {
    if (at_end()) fail(at_, "the expression '" + text_ + "' ends too early", "write what is missing at its end");
    if (take('(')) return parenthesis_rest(at_ - 1);
    if (is_digit(text_[at_]) || text_[at_] == '.') return number();
    const std::string name = peek_name();
    if (name.empty()) refuse_rest();
    const std::size_t start = at_;
    skip(name.size());
    if (const auto function = function_named(name)) {
      if (!take('(')) fail(at_, "'" + name + "' without its argument", "write " + name + "( ... )");
      return Expression::apply(*function, {parenthesis_rest(start)});
    }
    if (!at_end() && text_[at_] == '(')
      fail(start, "unknown function '" + name + "'",
           "known are sqrt, cos, sin, atan; a product needs *, as in L*(a + b)");
    if (name == "pi") return Expression::pi();
    if (name == "deg") return unit_symbol(name);
    return Expression::symbol(name);
  }

  Expression parenthesis_rest(std::size_t opened) {
    Expression inner = sum();
    if (!take(')')) {
      if (!at_end()) refuse_rest();
      fail(opened, "a parenthesis of '" + text_ + "' is not closed", "write ) where it ends");
    }
    return inner;
  }

  Expression number() {
    const std::size_t start = at_;
    std::size_t end = at_;
    const auto digits = [&] {
      while (end < text_.size() && is_digit(text_[end])) ++end;
    };
    digits();
    if (end < text_.size() && text_[end] == '.') {
      ++end;
      digits();
    }
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      std::size_t exponent = end + 1;
      if (exponent < text_.size() && (text_[exponent] == '+' || text_[exponent] == '-')) ++exponent;
      if (exponent < text_.size() && is_digit(text_[exponent])) {
        end = exponent;
        digits();
      }
    }
    const std::string literal = text_.substr(start, end - start);
    try {
      Expression result = Expression::number(core::rational_from_decimal(literal));
      skip(end - start);
      return result;
    } catch (const std::invalid_argument& error) {
      fail(start, error.what(), "numbers are written 0.5, 10e-6 or 1/3");
    }
  }

  /// Counts how deep the recursion is.
  class Nesting {
   public:
    explicit Nesting(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > deepest_nesting)
        parser_.fail(parser_.at_, "an expression nested more than 200 deep", "break it into parameters");
    }
    ~Nesting() { --parser_.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

   private:
    Parser& parser_;
  };

  const std::string& text_;
  const core::SourcePosition& where_;
  const std::set<std::string>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Expression parse_expression(const std::string& text, const core::SourcePosition& where) {
  return with_si_units(Parser(text, where, {}).parse());
}

Expression parse_with_units(const std::string& text, const core::SourcePosition& where,
                            const std::set<std::string>& names) {
  return Parser(text, where, names).parse();
}

}  // namespace clearloci::mechanism
