// The one registry of export formats: a line a format, with how it writes each answer that it holds. What the commands
// offer, and clearloci/export.hpp, is read off it; a new format is a file that makes its bytes and a line in
// formats.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <future>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/validate.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "report/answers.hpp"
#include "report/files.hpp"

namespace clearloci::report {

/// The files that a format makes of an answer.
template <class Answer>
using Maker = Files (*)(const Answer&);

class Format {
 public:
  /// `holds`: loci over so many free ones. `own`: a maker for each answer that the format holds.
  template <class... Answers>
  Format(std::string_view called, bool (*holds)(std::size_t), Maker<Answers>... answers)
      : name(called), holds_coordinates(holds) {
    ((std::get<Maker<Answers>>(makers_) = answers), ...);
  }

  std::string_view name;
  bool (*holds_coordinates)(std::size_t count);

  /// Null where the format does not hold the answer.
  template <class Answer>
  Maker<Answer> maker() const {
    return std::get<Maker<Answer>>(makers_);
  }

 private:
  std::tuple<Maker<LociSheet>, Maker<core::Zones>, Maker<core::Verification>, Maker<ErrorSheet>,
             Maker<core::TrajectoryResult>, Maker<core::Pose>, Maker<core::PoseInModes>, Maker<core::Validation>>
      makers_ = {};
};

/// In the order in which files are written; json is the first.
const std::vector<Format>& formats();

/// The names of the formats that an answer can be written in.
template <class Answer>
std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format& format : formats())
    if (format.maker<Answer>() != nullptr) names.emplace_back(format.name);
  return names;
}

/// Whether loci over so many free coordinates can be written so: dxf and geojson hold curves, stl and obj surfaces.
bool can_hold(std::string_view format, std::size_t coordinates);

/// What the formats named make of an answer.
template <class Answer>
Files files_of(const Answer& answer, const std::set<std::string>& names) {
  Files files;
  for (const Format& format : formats())
    if (format.maker<Answer>() != nullptr && names.contains(std::string(format.name)))
      for (File& file : format.maker<Answer>()(answer)) files.push_back(std::move(file));
  return files;
}

/// Adds the files, and their paths to `paths`. Throws core::InputError where the directory cannot be written.
void stage_files(StagedFiles& staged, const Files& files, const std::filesystem::path& directory,
                 std::vector<std::filesystem::path>& paths);

/// Adds what the formats that `wanted` picks make of an answer, json first: they are made side by side, for they know
/// nothing of one another, and written one after the other, each as soon as it is made, or made when its turn comes
/// where no thread is to be had. `written`: the part of them that is.
template <class Answer, class Wanted>
std::vector<std::filesystem::path> stage_wanted(StagedFiles& staged, const Answer& answer,
                                                const std::filesystem::path& directory, Wanted wanted,
                                                const std::function<void(double part)>& written = {}) {
  std::vector<std::filesystem::path> paths;
  std::vector<std::future<Files>> made;
  for (const Format& format : formats())
    if (const Maker<Answer> maker = format.maker<Answer>(); maker != nullptr && wanted(format))
      made.push_back(std::async(maker, std::cref(answer)));
  double count = 0;
  for (std::future<Files>& files : made) {
    stage_files(staged, files.get(), directory, paths);
    if (written) written(++count / static_cast<double>(made.size()));
  }
  return paths;
}

/// Loads the letters that pictures are written in, in a thread of its own, where there is a picture among the formats
/// named: what reads and traces need not wait for that. The future waits for its end.
std::future<void> prepare_pictures(const std::set<std::string>& names);

/// Adds the answer in the formats named, and as json always, and returns the files in the order written:
/// `zones.json`, `error.csv`, ..., each for all modes; pictures one a mode: `zones.svg`, or `zones-left-right.svg`, ...
/// where there are several; of error maps one a field besides, `error-dx.png`; over a single coordinate also
/// `take-up.png`, ... Throws core::InputError where the directory cannot be
/// written. Names that the answer has no format for are passed over.
template <class Answer>
std::vector<std::filesystem::path> stage_answer(StagedFiles& staged, const Answer& answer,
                                                const std::filesystem::path& directory,
                                                const std::set<std::string>& names = {}) {
  return stage_wanted(staged, answer, directory, [&](const Format& format) {
    return format.name == "json" || names.contains(std::string(format.name));
  });
}

/// All of them or none.
template <class Answer>
std::vector<std::filesystem::path> write_answer(const Answer& answer, const std::filesystem::path& directory,
                                                const std::set<std::string>& names = {}) {
  StagedFiles staged;
  std::vector<std::filesystem::path> paths = stage_answer(staged, answer, directory, names);
  staged.commit();
  return paths;
}

/// Likewise; of surfaces also `loci.obj`, which holds the triangles that `loci.json` speaks of. stl is a file a
/// surface, `loci-s1-contact-loss.stl`.
std::vector<std::filesystem::path> stage_loci(StagedFiles& staged, const LociSheet& loci,
                                              const std::filesystem::path& directory,
                                              const std::set<std::string>& names);
std::vector<std::filesystem::path> write_loci(const LociSheet& loci, const std::filesystem::path& directory,
                                              const std::set<std::string>& names);
/// Likewise; `progress`: from 0.5 on.
std::vector<std::filesystem::path> stage_trajectory(
    StagedFiles& staged, const core::TrajectoryResult& result, const std::filesystem::path& directory,
    const std::set<std::string>& names,
    const std::function<void(double fraction, std::string_view stage)>& progress = {});

}  // namespace clearloci::report
