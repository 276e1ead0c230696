#include "mechanism/notes.hpp"

#include "mechanism/idle.hpp"

namespace clearloci::mechanism {

std::vector<std::string> notes_of(const Mechanism& mechanism) {
  std::vector<std::string> notes = mechanism.notes;
  for (std::string& note : idle_notes(mechanism)) notes.push_back(std::move(note));
  return notes;
}

}  // namespace clearloci::mechanism
