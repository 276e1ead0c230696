// What is found of one design in one step of the law, told as it comes: the step runs in a process of its own
// (law_run.hpp), and what it told before it was ended counts.
#pragma once

#include <functional>
#include <sstream>
#include <string>

namespace clearloci::test {

/// User and system time of this process, s.
double cpu_seconds();

class Report {
 public:
  using Sink = std::function<void(const std::string& line)>;
  /// `patience`: s of CPU that each question of the program may take; then the process is ended.
  Report(Sink sink, int patience) : sink_(std::move(sink)), patience_(patience) {}

  /// Something that contradicts an answer.
  class Line {
   public:
    explicit Line(Report& report) : report_(report) { text_.precision(12); }
    ~Line() { report_.fault(text_.str()); }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;
    template <typename T>
    Line& operator<<(const T& value) {
      text_ << value;
      return *this;
    }

   private:
    Report& report_;
    std::ostringstream text_;
  };

  void fault(const std::string& what);
  void refused(const std::string& why) { tell("refused", why); }
  void uncertified(const std::string& what) { tell("uncertified", what); }
  void late() { tell("late", ""); }
  /// Things that were held, under their name.
  void held(const std::string& what, long count = 1);
  bool has_faults() const { return faults_ > 0; }

  /// Asks the program: ends this process where the answer takes more CPU than it may.
  template <class Question>
  auto in_patience(const Question& question) {
    const Limit limit(*this);
    return question();
  }

 private:
  class Limit {
   public:
    explicit Limit(Report& report);
    ~Limit();
    Limit(const Limit&) = delete;
    Limit& operator=(const Limit&) = delete;

   private:
    Report& report_;
    double began_;
  };
  void tell(const std::string& kind, std::string what);

  Sink sink_;
  int patience_ = 20, faults_ = 0;
};

}  // namespace clearloci::test
