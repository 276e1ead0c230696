// How answers speak of joints that bear nothing in any pose.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace clearloci::inline core {

/// "S1, S2 bear nothing".
inline std::string words_of_idle(const std::vector<std::string>& joints) {
  std::string names;
  for (const std::string& joint : joints) names += (names.empty() ? "" : ", ") + joint;
  return names + (joints.size() == 1 ? " bears nothing" : " bear nothing");
}

inline constexpr const char* undefined_take_up_words = ", so the take-up is undefined";

/// Behind the name of a reaction.
inline constexpr const char* unloaded_words = " is zero in every pose under these loads";

/// "S1, S2 bear nothing in any pose under these loads, so the take-up is undefined".
inline std::string unloaded_note(const std::vector<std::string>& joints) {
  return words_of_idle(joints) + " in any pose under these loads" + undefined_take_up_words;
}

/// Behind a note, where a least size is asked for.
inline constexpr const char* no_least_size_words =
    "; no pose has the least size that is asked for there, which is left out";

/// The joints of such a note; none of another.
inline std::vector<std::string> joints_of_unloaded_note(const std::string& note) {
  std::vector<std::string> joints;
  const std::size_t end = note.find(" bear");
  if (end == std::string::npos || note.find(" nothing in any pose under these loads") == std::string::npos)
    return joints;
  for (std::size_t from = 0; from < end;) {
    const std::size_t to = std::min(note.find(", ", from), end);
    joints.push_back(note.substr(from, to - from));
    from = to + 2;
  }
  return joints;
}

}  // namespace clearloci::inline core
