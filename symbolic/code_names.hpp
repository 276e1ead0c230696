// The names under which `equations` writes its symbols. What a file calls its parameters, points and coordinates may
// mean something else in the language of the output (`lambda` in Python, `y0` in C), or be the name of something that
// the equations derive (`DB1`). Such a name is written with underscores behind it, and a comment says so.
// Private to symbolic/.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/equation_sheet.hpp"

namespace clearloci::symbolic {

class CodeNames {
 public:
  explicit CodeNames(Language language) : language_(language) {}

  static constexpr const char* derived = "derived ";  ///< the kind of what belongs to a point

  /// The name for a symbol, the same whenever it is asked for again. `kind` tells symbols of one name apart: a
  /// parameter DB1 from the "derived " DB1, the squared distance of point B1. Those that are asked for first keep their
  /// names.
  const std::string& name(const std::string& kind, const std::string& wanted);

  /// The same as it stands in a formula: "x_{B1}" in LaTeX.
  std::string in_formula(const std::string& kind, const std::string& wanted);

  /// The names that had to change: as in the file, as written.
  const std::vector<std::pair<std::string, std::string>>& renamed() const { return renamed_; }

 private:
  bool is_free(const std::string& name) const;

  Language language_;
  std::map<std::pair<std::string, std::string>, std::string> names_;
  std::set<std::string> taken_;
  std::map<std::string, std::string> set_;  ///< how LaTeX sets names, and which
  std::vector<std::pair<std::string, std::string>> renamed_;
};

/// Text of a file inside a comment of the language: on one line, and unable to end the comment.
std::string comment_text(const std::string& text, Language language);

/// A name of a file as LaTeX sets it in mathematics: "\theta_{1}" of theta1, "l_{AB}", "\mathrm{mass}"; underscores
/// that no subscript stands for are escaped.
std::string latex_symbol(const std::string& name);

/// What is derived of a point: "x_{B1}".
std::string latex_derived(const std::string& name);

/// Underscores escaped.
std::string latex_text(const std::string& name);

}  // namespace clearloci::symbolic
