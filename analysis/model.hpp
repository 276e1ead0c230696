// What a Model keeps (clearloci/mechanism.hpp).
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/mechanism.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/read.hpp"
#include "symbolic/locus_problem.hpp"

namespace clearloci {

/// What the members of a family of designs have in common: the file, and its equations, derived when first asked for in
/// the frame of the first member, as every member is analysed in its own. They serve members whose equations they are
/// with values put in, which is looked at entry by entry; others are derived alone.
class SharedDesign {
 public:
  SharedDesign(std::string text, std::string file, std::vector<std::string> notes, mechanism::Mechanism first);

  const std::string& text() const { return text_; }
  const std::string& file() const { return file_; }
  const std::vector<std::string>& notes() const { return notes_; }  ///< of the import of another program's file
  /// With values put in for parameters; throws core::InputError for wrong ones.
  mechanism::Mechanism read(const std::vector<Model::Value>& values) const;
  /// Throws core::InputError where the equations themselves are wrong.
  const symbolic::LocusFamily& family() const;

 private:
  std::string text_, file_;
  std::vector<std::string> notes_;
  mechanism::Mechanism first_;
  mutable std::mutex mutex_;
  mutable mechanism::MechanismReader reader_;  // once it is asked for, as below
  mutable std::optional<symbolic::LocusFamily> family_;
};

struct Model::Content {
  std::shared_ptr<const SharedDesign> shared;
  std::vector<Value> values;
  mechanism::Mechanism mechanism;
  /// One of several members: made by Model::with. What they share is worth deriving then; for a single design its own
  /// numbers are quicker.
  bool member = false;

  static Model of(mechanism::Mechanism mechanism);
};

/// A mechanism that was made otherwise than from a file, as a model without a text.
inline Model model_of(mechanism::Mechanism mechanism) { return Model::Content::of(std::move(mechanism)); }

}  // namespace clearloci
