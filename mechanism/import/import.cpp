#include "mechanism/import/import.hpp"

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

const imports::Format* format_of(std::string_view text) {
  for (const imports::Format& format : imports::formats())
    if (format.recognises(text)) return &format;
  return nullptr;
}

/// "20e-6" as "20e-6 m"; what has its unit stays.
std::string clearance_of(const ImportOptions& options) {
  std::string given(imports::trimmed(options.clearance));
  double value = 0;
  if (given.empty()) return "20e-6 m";
  if (imports::number_of(given, value)) {
    if (!(value >= 0)) throw InputError({}, "--clearance is " + given, "write a length of 0 or more, such as 20e-6");
    return given + " m";
  }
  const bool plain = std::all_of(given.begin(), given.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("+-*/. ^").find(c) != std::string_view::npos;
  });
  if (!plain) throw InputError({}, "--clearance is '" + given + "'", "write a length such as 20e-6 or 20 um");
  return given;
}

/// Freedoms are counted, and postures closed, in matrices as wide as there are links.
void check_size(const imports::Source& source, const std::string& file, std::size_t most) {
  const auto links = static_cast<std::size_t>(
      std::count_if(source.links.begin(), source.links.end(), [](const auto& link) { return !link.dropped; }));
  const auto joints = static_cast<std::size_t>(
      std::count_if(source.joints.begin(), source.joints.end(), [](const auto& joint) { return !joint.dropped; }));
  if (links > most || joints > 3 * most)
    throw InputError({file},
                     "the " + std::string(source.format) + " file has " + std::to_string(links) +
                         " links that move and " + std::to_string(joints) + " joints",
                     "read a part of it: a drawing has 60 links at most");
}

/// Links that no joint joins to anything.
void leave_out_loose(imports::Source& source, const std::string& file) {
  std::vector<std::string> names;
  for (std::size_t l = 0; l < source.links.size(); ++l) {
    const auto link = static_cast<int>(l);
    if (source.links[l].dropped) continue;
    if (std::any_of(source.joints.begin(), source.joints.end(),
                    [&](const auto& joint) { return !joint.dropped && (joint.from == link || joint.to == link); }))
      continue;
    for (const imports::SourceMesh& mesh : source.meshes)
      if (mesh.links[0] == link || mesh.links[1] == link)
        throw InputError({file, mesh.line},
                         "wheel " + source.links[l].name + " of " + mesh.name + " turns about nothing",
                         "pin its centre to the ground or to a link");
    names.push_back(source.links[l].name);
    source.links[l].dropped = true;
    std::erase_if(source.points, [&](const auto& point) { return point.link == link; });
    std::erase_if(source.loads, [&](const auto& load) { return load.link == link; });
    std::erase_if(source.springs,
                  [&](const auto& spring) { return spring.links[0] == link || spring.links[1] == link; });
  }
  if (!names.empty()) source.note("left out, since no joint moves it: " + imports::enumerated(names));
}

}  // namespace

std::string import_format(std::string_view text) {
  const imports::Format* format = format_of(text);
  return format == nullptr ? "" : std::string(format->name);
}

std::vector<std::string> import_formats() {
  std::vector<std::string> names;
  for (const imports::Format& format : imports::formats()) names.emplace_back(format.name);
  return names;
}

bool is_address(std::string_view path) { return path.starts_with("https://") || path.starts_with("http://"); }

Imported import_text(const std::string& text, const std::string& file, const ImportOptions& options) {
  const imports::Format* format = format_of(text);
  if (format == nullptr) return {text, "", {}};
  const std::string clearance = clearance_of(options);
  imports::Source source = format->read({text, file, options.side, options.side_file});
  source.format = format->name;
  constexpr std::size_t most_in_file = 1000, most_links = 60;
  check_size(source, file, most_in_file);
  imports::merge_welds(source);
  check_size(source, file, most_links);
  imports::close_posture(source, file);
  imports::merge_welds(source);
  imports::merge_rigid(source);
  leave_out_loose(source, file);
  imports::go_planar(source);
  imports::merge_rigid(source);
  imports::mesh_followers(source, file);
  imports::check_meshes(source, file);
  imports::choose_motors(source);
  Imported result;
  result.text = imports::write_drawn(source, file, clearance);
  result.format = source.format;
  for (const std::string& note : source.notes) result.notes.push_back(core::message_line(note));
  return result;
}

Imported import_file(const std::string& path, ImportOptions options) {
  if (is_address(path)) {
    Imported result = import_text(path, core::shortened(path, 60), options);
    if (result.format.empty())
      throw InputError({core::shortened(path, 60)}, "this address holds no mechanism",
                       "give an address of PMKS+, or the path of a file");
    return result;
  }
  const std::string text = read_text(path, "the mechanism file");
  const imports::Format* format = format_of(text);
  if (format != nullptr && !format->side_ending.empty() && options.side.empty()) {
    const std::filesystem::path beside = std::filesystem::path(path).replace_extension(format->side_ending);
    std::error_code error;
    if (std::filesystem::is_regular_file(beside, error)) {
      options.side = read_text(beside.string(), "the file of loops");
      options.side_file = beside.string();
    }
  }
  return import_text(text, path, options);
}

}  // namespace clearloci::mechanism
