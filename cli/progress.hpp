// A progress bar on standard error, where that is a terminal.
#pragma once

#include <string_view>

namespace clearloci::cli {

class Progress {
 public:
  /// Shows nothing if `quiet` or if standard error is no terminal.
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` in [0, 1].
  void show(double fraction, std::string_view stage);

  /// Takes the bar away, so that what follows starts on an empty line.
  void clear();

 private:
  bool enabled_;
  bool visible_ = false;
};

}  // namespace clearloci::cli
