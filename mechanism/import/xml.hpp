// The tree of an XML text that knows what was read of it, so that a reader can say what it left out. Private to
// mechanism/.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clearloci::mechanism::imports {

class XmlElement {
 public:
  std::string name;
  std::string text;  ///< what stands within it, between its children
  int line = 0;
  std::vector<XmlElement> children;

  struct Attribute {
    std::string name, value;
    mutable bool read = false;
  };
  std::vector<Attribute> attributes;
  mutable bool read = false;

  /// The value of an attribute; nothing where it is missing. Counts as read.
  std::optional<std::string> get(std::string_view attribute) const;
  std::string get(std::string_view attribute, const std::string& otherwise) const;
  bool has(std::string_view attribute) const;
  /// Children of a name; they count as read.
  std::vector<const XmlElement*> all(std::string_view child) const;
  const XmlElement* first(std::string_view child) const;
  /// It is understood with all that is in it.
  void take_whole() const;
};

/// Throws core::InputError that says where the text is no XML. `mended`: white space that is missing between attributes
/// is put in.
XmlElement parse_xml(const std::string& text, const std::string& file);

/// "mesh of geom (3)", "color of connector (12)": what nobody read, below `root`.
std::vector<std::string> unread(const XmlElement& root);

/// Numbers between white space. Throws core::InputError where one is none, or where there are others than `least` to
/// `most` of them.
std::vector<double> numbers_of(const std::string& text, const XmlElement& at, const std::string& what,
                               const std::string& file, std::size_t least, std::size_t most);

}  // namespace clearloci::mechanism::imports
