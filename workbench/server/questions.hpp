// What a page may ask, and the answers as JSON: the questions of include/clearloci, each in one request that carries
// the whole mechanism. Between them the server keeps nothing but the loci of the last answers, to begin the next with.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "workbench/server/answered_loci.hpp"
#include "workbench/server/requests.hpp"

namespace clearloci::workbench {

/// How the work is watched while it is done.
struct Watch {
  std::chrono::steady_clock::time_point deadline;
  std::function<bool()> abandoned;
  std::function<void(double fraction, std::string_view stage)> progress;
  /// Where the page takes answers in parts: sends one ahead of the rest, and keeps loci for the next answer.
  std::function<void(const Json& part)> ahead = {};
  AnsweredLoci* answered = nullptr;  ///< null: nothing is kept or sent ahead
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(); }
};

using Question = Json (*)(const Json& body, const Watch& watch);

/// "model", "loci", "zones", "verify", "pose", "sweep", "cycle", "modes", "trajectory", "normalize", "import",
/// "export"; null for another name.
Question question_named(const std::string& name);

// By what they answer (questions_*.cpp). Each throws Refusal, InputError or LimitReached.
Json answer_model(const Json& body, const Watch& watch);
Json answer_loci(const Json& body, const Watch& watch);
Json answer_zones(const Json& body, const Watch& watch);
Json answer_verify(const Json& body, const Watch& watch);
Json answer_pose(const Json& body, const Watch& watch);
Json answer_sweep(const Json& body, const Watch& watch);
Json answer_cycle(const Json& body, const Watch& watch);
Json answer_modes(const Json& body, const Watch& watch);
Json answer_trajectory(const Json& body, const Watch& watch);
Json answer_normalize(const Json& body, const Watch& watch);
Json answer_import(const Json& body, const Watch& watch);
Json answer_export(const Json& body, const Watch& watch);

/// A request's loci under the watch: its deadline, and an end as soon as it is abandoned.
LociRequest watched(LociRequest request, const Watch& watch);

/// Throws where the work has become pointless or its time is over; for loops of our own.
void check(const Watch& watch);

}  // namespace clearloci::workbench
