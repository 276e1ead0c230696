// A mechanism, of which every question is asked: what its file says (mechanism-file.md), with values of parameters
// put in. Copies share what was derived; a model may be used from several threads.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Model longer = model.with({{"L", "0.45"}});  // derived once, asked again
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/errors.hpp"
#include "clearloci/loci.hpp"
#include "clearloci/units.hpp"

namespace clearloci {

class Model {
 public:
  /// A parameter's name and its new value as an expression: {"L", "0.45"}, {"alpha", "30 deg"}.
  using Value = std::pair<std::string, std::string>;

  struct Parameter {
    std::string name;
    std::string exact;  ///< "1/2"; an expression where the value is irrational
    double value = 0;   ///< SI units
  };
  struct Coordinate {
    std::string name;
    bool angle = false;           ///< in rad, else m
    double lower = 0, upper = 0;  ///< the range that is searched
  };
  struct Joint {
    std::string name, type;  ///< "revolute", "prismatic", ...
    bool actuated = false, clearance = false;
    std::string from, to;  ///< its links, or "ground"
    std::string at;        ///< its point
  };
  struct Link {
    std::string name;
    std::vector<std::string> points;
  };
  struct EndEffector {
    std::string link, at;  ///< its point
  };
  struct Dyad {
    std::string point;
    std::string left, right;  ///< what its sides are called: of a slider "ahead", "behind"
    int side = 1;             ///< the file's: +1 left, -1 right
  };

  /// Throws InputError, with file, line, column, what is wrong and how to mend it.
  static Model read(const std::string& path, const std::vector<Value>& values = {});
  /// The same for a text; `file` is the name that errors show.
  static Model parse(std::string text, std::string file = "model", const std::vector<Value>& values = {});

  /// The same mechanism with other values; what does not depend on them is not derived again. Parameters that are not
  /// named keep the values that they have here.
  Model with(const std::vector<Value>& values) const;

  const std::string& name() const;
  const std::string& file() const;
  const std::string& text() const;           ///< of the file
  const std::vector<Value>& values() const;  ///< put in so far
  bool spatial() const;
  const Units& units() const;  ///< of the file: what its tables and pictures speak in
  std::vector<Parameter> parameters() const;
  std::vector<Coordinate> coordinates() const;  ///< the free ones
  std::vector<Joint> joints() const;
  std::vector<Link> links() const;
  EndEffector end_effector() const;
  std::vector<Dyad> dyads() const;  ///< points with two places each: what a working mode chooses

  struct Content;  ///< for the library's own sources (analysis/model.hpp)
  const Content& content() const { return *content_; }

 private:
  explicit Model(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  std::shared_ptr<const Content> content_;
};

}  // namespace clearloci
