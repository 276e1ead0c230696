#include "mechanism/read.hpp"
#include "mechanism/idle.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/text.hpp"
#include "mechanism/assembly/assemble.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/idle_limits.hpp"
#include "mechanism/import/import.hpp"
#include "mechanism/inline_points.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/redundant_rods.hpp"
#include "mechanism/repeat.hpp"
#include "mechanism/spring_ends.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

const std::vector<std::string> top_keys = {"format",       "name",  "space",  "units",   "parameters", "workspace",
                                           "frames",       "drawn", "points", "links",   "joints",     "springs",
                                           "end_effector", "loads", "limits", "gravity", "repeat"};
/// What may be written once for parts that are alike.
const std::vector<std::string> repeatable_keys = {"parameters", "frames", "drawn",   "points", "links",
                                                  "joints",     "loads",  "springs", "limits"};

Space read_space(const std::optional<Value>& value) {
  if (!value) return Space::planar;
  const std::string text = text_of(*value);
  if (text == "planar") return Space::planar;
  if (text == "spatial") return Space::spatial;
  throw InputError(value->where, "the space is '" + text + "'", "write space: planar or space: spatial");
}

}  // namespace

const std::vector<std::string>& file_keys() { return top_keys; }

std::string name_of(const std::optional<Value>& value, const std::string& file) {
  constexpr std::size_t longest = 160;
  std::string name = value ? text_of(*value) : std::filesystem::path(file).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return core::shortened(name, longest);
}

namespace {

/// The document with its repetitions written out and a construction of every point.
Assembled constructed(const Value& written, const std::vector<Override>& overrides) {
  (void)Mapping(written, top_keys, true);
  const Value plain = telescoped_rods(name_inline_points(expand_repeat(written, repeatable_keys)));
  const Mapping root(plain, top_keys, true);
  check_format(root.at("format"));
  if (!is_drawn(plain)) root.require({"workspace", "points", "links", "joints", "end_effector"});
  (void)read_space(root.find("space"));
  if (is_drawn(plain)) return assemble(plain, overrides);
  return {plain, {}, {}};
}

Mechanism read_document(const Value& written, const std::string& file, const std::vector<Override>& overrides) {
  const Assembled assembled = constructed(written, without_efforts(overrides));
  const Mapping root(assembled.document, top_keys, true);

  Mechanism mechanism;
  mechanism.notes = assembled.notes;
  mechanism.space = read_space(root.find("space"));
  mechanism.file = file;
  mechanism.name = name_of(root.find("name"), file);
  mechanism.units = read_units(root.find("units"));
  const GivenEfforts efforts = given_efforts(root.at("workspace"), overrides);
  check_given_efforts(root.at("joints"), root.find("parameters"), efforts);
  read_parameters(mechanism, root.find("parameters"), free_effort_parameters(root.at("joints"), efforts),
                  efforts.values);
  read_workspace(mechanism, root.at("workspace"));
  read_points(mechanism, root.at("points"), root.find("frames"), root.find("links"), root.find("joints"));
  read_gear_points(mechanism, root.at("joints"));
  read_belt_points(mechanism, root.at("joints"));
  read_links(mechanism, root.at("links"));
  read_joints(mechanism, root.at("joints"));
  fill_inertia(mechanism);
  read_end_effector(mechanism, root.at("end_effector"));
  read_loads(mechanism, root.find("loads"));
  read_gravity(mechanism, root.find("gravity"));
  read_springs(mechanism, root.find("springs"));
  read_limits(mechanism, root.find("limits"));

  hold_point_masses(mechanism);
  choose_free_cables(mechanism, names_of_efforts(efforts));
  give_free_efforts(mechanism, efforts);
  hold_idle_freedoms(mechanism);
  check_names(mechanism);
  check_coordinates_used(mechanism, root.at("workspace").where);
  check_square(mechanism, root.at("joints").where);
  check_distinct_bases(mechanism);
  check_reachability(mechanism);
  check_axes(mechanism);
  check_springs(mechanism);
  check_rigidity(mechanism);
  check_joint_marks(mechanism);
  check_gears(mechanism);
  leave_out_ends_out_of_reach(mechanism);
  limit_spring_ends(mechanism);
  return mechanism;
}

}  // namespace

namespace {

Value parse_mapping(const std::string& text, const std::string& file) {
  Value document = parse_document(text, file);
  if (!document.is_map())
    throw InputError(document.where, "the file is no mapping of keys to values", "start with the line format: 1");
  return document;
}

template <typename Read>
auto read_text_of(const Value& document, const std::string& file, const Read& read) {
  try {
    return read(document);
  } catch (const InputError& error) {
    throw told_of_file(error, file);
  }
}

}  // namespace

Mechanism parse_mechanism(const std::string& text, const std::string& file, const std::vector<Override>& overrides) {
  return mechanism_reader(text, file)(overrides);
}

MechanismReader mechanism_reader(const std::string& text, const std::string& file) {
  return [written = parse_mapping(text, file), file](const std::vector<Override>& overrides) {
    return read_text_of(written, file, [&](const Value& document) { return read_document(document, file, overrides); });
  };
}

WrittenMechanism constructed_text(const std::string& text, const std::string& file) {
  return read_text_of(parse_mapping(text, file), file, [&](const Value& document) -> WrittenMechanism {
    Assembled assembled = constructed(document, {});
    const Mapping root(assembled.document, top_keys, true);
    std::vector<Node::Pair> pairs;
    for (const auto& [key, content] : assembled.document.node.pairs()) {
      pairs.emplace_back(key, content);
      // A file that gives itself no name is called by the file's: this one has another.
      if (key.Scalar() == "format" && !root.find("name"))
        pairs.emplace_back(Node::scalar("name", key.where()), Node::scalar(name_of({}, file), key.where()));
    }
    assembled.document.node = Node::map(std::move(pairs), assembled.document.node.where());
    return {written_document(assembled.document, assembled.comments), std::move(assembled.notes)};
  });
}

std::string read_text(const std::string& path, const std::string& what, std::size_t most) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError({path, 0, 0}, "there is no such file", "check the path");
  if (std::filesystem::is_directory(status))
    throw InputError({path, 0, 0}, "this is a folder, not a file", "name " + what + " in it");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({path, 0, 0}, "the file cannot be read", "check its permissions");
  // Read piece by piece, since the size of a pipe is not known and that of a device is endless.
  std::string text;
  std::vector<char> piece(std::size_t{1} << 16);
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > most)
      throw InputError({path, 0, 0}, "the file has more than " + std::to_string(most >> 20) + " MB",
                       most == largest_text ? "name " + what + ", a text written by hand" : "name " + what);
  }
  if (file.bad()) throw InputError({path, 0, 0}, "the file cannot be read", "check its permissions");
  return text;
}

namespace {

/// Lines that errors name are those of the imported text.
ModelText named(Imported imported, const std::string& file) {
  std::string name = imported.format.empty() ? file
                     : is_address(file)      ? "the address, as imported"
                                             : file + ", as imported";
  return {std::move(imported.text), std::move(imported.notes), std::move(name)};
}

}  // namespace

ModelText read_model_text(const std::string& path) { return named(import_file(path), path); }

ModelText model_text(std::string text, std::string file) {
  if (import_format(text).empty()) return {std::move(text), {}, std::move(file)};
  return named(import_text(text, file), file);
}

Mechanism read_mechanism(const std::string& path, const std::vector<Override>& overrides) {
  const ModelText text = read_model_text(path);
  Mechanism mechanism = parse_mechanism(text.text, text.file, overrides);
  mechanism.notes.insert(mechanism.notes.begin(), text.notes.begin(), text.notes.end());
  return mechanism;
}

}  // namespace clearloci::mechanism
