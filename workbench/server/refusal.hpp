// A request that is not answered: the status and the one sentence that says why.
#pragma once

#include <stdexcept>
#include <string>

namespace clearloci::workbench {

class Refusal : public std::runtime_error {
 public:
  Refusal(int status, const std::string& sentence) : std::runtime_error(sentence), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

}  // namespace clearloci::workbench
