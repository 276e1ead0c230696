#include "mechanism/precise_posture.hpp"

#include <mpfr.h>

#include <map>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/thread_end.hpp"
#include "mechanism/placement.hpp"

namespace clearloci::mechanism {
namespace {

/// A number of MPFR; no number where a root or a quotient has no value.
class Precise {
 public:
  Precise() { mpfr_init2(value_, precise_bits); }
  Precise(const Precise& other) : Precise() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Precise(Precise&& other) noexcept : Precise() { mpfr_swap(value_, other.value_); }
  Precise& operator=(Precise other) noexcept {
    mpfr_swap(value_, other.value_);
    return *this;
  }
  ~Precise() { mpfr_clear(value_); }

  mpfr_ptr get() { return value_; }
  mpfr_srcptr get() const { return value_; }
  bool operator==(const Precise& other) const { return mpfr_equal_p(value_, other.value_) != 0; }

 private:
  mpfr_t value_;
};

using OneArgument = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using TwoArguments = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

Precise of(OneArgument function, const Precise& a) {
  Precise result;
  function(result.get(), a.get(), MPFR_RNDN);
  return result;
}

Precise of(TwoArguments function, const Precise& a, const Precise& b) {
  Precise result;
  function(result.get(), a.get(), b.get(), MPFR_RNDN);
  return result;
}

/// An algebra (mechanism/placement.hpp) of such numbers.
struct PreciseNumbers {
  using Value = Precise;
  const std::map<std::string, Precise>& values;

  Precise number(const Rational& value) const {
    Precise result;
    mpfr_set_q(result.get(), value.get_mpq_t(), MPFR_RNDN);
    return result;
  }
  Precise unknown(std::size_t, std::size_t) const {
    core::ensure(false, "a mechanism without groups");
    return {};
  }
  void close(std::size_t, const std::vector<Precise>&) const {}
  Precise symbol(const std::string& name) const { return values.at(name); }
  Precise pi() const {
    Precise result;
    mpfr_const_pi(result.get(), MPFR_RNDN);
    return result;
  }
  Precise negate(const Precise& a) const { return of(mpfr_neg, a); }
  Precise add(const Precise& a, const Precise& b) const { return of(mpfr_add, a, b); }
  Precise subtract(const Precise& a, const Precise& b) const { return of(mpfr_sub, a, b); }
  Precise multiply(const Precise& a, const Precise& b) const { return of(mpfr_mul, a, b); }
  Precise square(const Precise& a) const { return of(mpfr_sqr, a); }
  Precise inverse(const Precise& a) const { return of(mpfr_div, number(1), a); }
  Precise square_root(const Precise& a) const { return of(mpfr_sqrt, a); }
  Precise divide(const Precise& a, const Precise& b, const Expression&) const { return of(mpfr_div, a, b); }
  Precise power(const Precise& a, const Expression& e) const {
    return of(mpfr_pow, a, core::interpret(e.arguments()[1], *this));
  }
  Precise sqrt(const Precise& a, const Expression&) const { return of(mpfr_sqrt, a); }
  Precise cos(const Precise& a, const Expression&) const { return of(mpfr_cos, a); }
  Precise sin(const Precise& a, const Expression&) const { return of(mpfr_sin, a); }
  Precise atan(const Precise& a, const Expression&) const { return of(mpfr_atan, a); }
};

}  // namespace

std::optional<PrecisePoints> precise_posture(const Mechanism& mechanism, const std::vector<double>& pose,
                                             const std::vector<int>& sides) {
  core::ensure(mechanism.groups.empty(), "a mechanism without groups");
  core::call_at_thread_end<mpfr_free_cache>();
  std::map<std::string, Precise> values;
  for (const Parameter& parameter : mechanism.parameters)
    mpfr_set_q(values[parameter.name].get(), parameter.value.get_mpq_t(), MPFR_RNDN);
  for (std::size_t i = 0; i < pose.size(); ++i)
    mpfr_set_d(values[mechanism.coordinates[i].name].get(), pose[i], MPFR_RNDN);
  const Placement<PreciseNumbers> placed(mechanism, sides, {values});
  PrecisePoints points;
  for (const auto& point : placed.points()) {
    std::array<mpf_class, 3>& place = points.emplace_back();
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (mpfr_number_p(point[i].get()) == 0) return std::nullopt;
      place[i].set_prec(precise_bits);
      mpfr_get_f(place[i].get_mpf_t(), point[i].get(), MPFR_RNDN);
    }
  }
  return points;
}

}  // namespace clearloci::mechanism
