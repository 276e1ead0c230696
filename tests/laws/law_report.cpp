#include "tests/laws/law_report.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

namespace clearloci::test {
namespace {

// Of these many of one design say no more.
constexpr int most_faults = 12;

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Of CPU from the start of the process; 0: none.
void set_limit(double seconds) {
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = seconds > 0 ? static_cast<rlim_t>(std::ceil(seconds)) : limit.rlim_max;
  setrlimit(RLIMIT_CPU, &limit);
}

}  // namespace

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

void Report::fault(const std::string& what) {
  if (++faults_ <= most_faults) tell("fault", what);
}

void Report::held(const std::string& what, long count) { tell("held", std::to_string(count) + " " + what); }

void Report::tell(const std::string& kind, std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  sink_(kind + " " + what);
}

Report::Limit::Limit(Report& report) : report_(report), began_(cpu_seconds()) { set_limit(began_ + report_.patience_); }

Report::Limit::~Limit() {
  set_limit(0);
  report_.tell("asked", std::to_string(cpu_seconds() - began_));
}

}  // namespace clearloci::test
