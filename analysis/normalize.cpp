#include "clearloci/normalize.hpp"

#include "mechanism/read.hpp"
#include "mechanism/write_values.hpp"

namespace clearloci {

NormalizedFile normalize(const Model& model) {
  const std::string text = mechanism::with_values(model.text(), model.file(), model.values());
  mechanism::WrittenMechanism written = mechanism::constructed_text(text, model.file());
  return {std::move(written.text), std::move(written.notes)};
}

}  // namespace clearloci
