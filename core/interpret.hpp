// What an expression means, from its leaves up: the one walk over core::Expression. Numbers, formulas, bounds, programs
// and printed texts are algebras of it. An algebra has its `Value` and
//     number(rational), symbol(name), pi(), negate(a), add(a, b), multiply(a, b),
//     divide(a, b, e), power(a, e), sqrt(a, e), cos(a, e), sin(a, e), atan(a, e)
// What is not defined everywhere is handed the whole expression e as well, to tell of it or to look at it once more; of
// a power the exponent, e.arguments()[1], is the algebra's to interpret: most want it as a number. Where an algebra has
//     known(e), an optional value,
// it is asked first, and where it answers, the parts of e are left alone: constants, or what it refuses.
// Arguments are interpreted from left to right; in an algebra with a type RightFirst from right to left.
#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "core/errors.hpp"
#include "core/expression.hpp"

namespace clearloci::inline core {

template <class Algebra>
typename std::remove_cvref_t<Algebra>::Value interpret(const Expression& e, Algebra&& algebra) {
  using Kind = Expression::Kind;
  using Value = typename std::remove_cvref_t<Algebra>::Value;
  if constexpr (requires { algebra.known(e); }) {
    if (std::optional<Value> value = algebra.known(e)) return *std::move(value);
  }
  const auto argument = [&](std::size_t i) { return interpret(e.arguments()[i], algebra); };
  const auto both = [&]() -> std::pair<Value, Value> {
    if constexpr (requires { typename std::remove_cvref_t<Algebra>::RightFirst; }) {
      Value b = argument(1);
      return {argument(0), std::move(b)};
    } else {
      Value a = argument(0);
      return {std::move(a), argument(1)};
    }
  };
  switch (e.kind()) {
    case Kind::number:
      return algebra.number(e.value());
    case Kind::symbol:
      return algebra.symbol(e.name());
    case Kind::pi:
      return algebra.pi();
    case Kind::negate:
      return algebra.negate(argument(0));
    case Kind::add: {
      const auto [a, b] = both();
      return algebra.add(a, b);
    }
    case Kind::multiply: {
      const auto [a, b] = both();
      return algebra.multiply(a, b);
    }
    case Kind::divide: {
      const auto [a, b] = both();
      return algebra.divide(a, b, e);
    }
    case Kind::power:
      return algebra.power(argument(0), e);
    case Kind::sqrt:
      return algebra.sqrt(argument(0), e);
    case Kind::cos:
      return algebra.cos(argument(0), e);
    case Kind::sin:
      return algebra.sin(argument(0), e);
    case Kind::atan:
      return algebra.atan(argument(0), e);
  }
  ensure(false, "an expression of a known kind");
  return interpret(Expression(), algebra);
}

}  // namespace clearloci::inline core
