#include "symbolic/code_names.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "core/text.hpp"

namespace clearloci::symbolic {
namespace {

using Words = std::set<std::string, std::less<>>;

/// What every output uses itself.
const Words own_words = {"A", "atan2", "b", "cos", "sin", "sqrt", "pi"};

// Parameters are local in C, so that functions of the library may be hidden; words of the language and macros may not.
// C++ included, since C is pasted into it. `linux` and `unix` are macros of GNU C.
const Words c_words = {"alignas",
                       "alignof",
                       "and",
                       "and_eq",
                       "asm",
                       "auto",
                       "bitand",
                       "bitor",
                       "bool",
                       "break",
                       "case",
                       "catch",
                       "char",
                       "char16_t",
                       "char32_t",
                       "char8_t",
                       "class",
                       "co_await",
                       "co_return",
                       "co_yield",
                       "compl",
                       "concept",
                       "const",
                       "const_cast",
                       "consteval",
                       "constexpr",
                       "constinit",
                       "continue",
                       "decltype",
                       "default",
                       "delete",
                       "do",
                       "double",
                       "dynamic_cast",
                       "else",
                       "enum",
                       "explicit",
                       "export",
                       "extern",
                       "false",
                       "float",
                       "for",
                       "friend",
                       "goto",
                       "i386",
                       "if",
                       "inline",
                       "int",
                       "linux",
                       "long",
                       "main",
                       "mutable",
                       "namespace",
                       "new",
                       "noexcept",
                       "not",
                       "not_eq",
                       "nullptr",
                       "operator",
                       "or",
                       "or_eq",
                       "pow",
                       "private",
                       "protected",
                       "public",
                       "register",
                       "reinterpret_cast",
                       "requires",
                       "restrict",
                       "return",
                       "short",
                       "signed",
                       "sizeof",
                       "static",
                       "static_assert",
                       "static_cast",
                       "struct",
                       "switch",
                       "template",
                       "this",
                       "thread_local",
                       "throw",
                       "true",
                       "try",
                       "typedef",
                       "typeid",
                       "typename",
                       "typeof",
                       "typeof_unqual",
                       "union",
                       "unix",
                       "unsigned",
                       "using",
                       "virtual",
                       "void",
                       "volatile",
                       "wchar_t",
                       "while",
                       "xor",
                       "xor_eq",
                       "DOMAIN",
                       "SING",
                       "OVERFLOW",
                       "UNDERFLOW",
                       "PLOSS",
                       "TLOSS",
                       "X_TLOSS",
                       "INFINITY",
                       "NAN",
                       "NULL",
                       "I",
                       "HUGE",
                       "MAXFLOAT",
                       "newton_euler",
                       "isfinite",
                       "isnan",
                       "isinf",
                       "isnormal",
                       "signbit",
                       "fpclassify",
                       "isgreater",
                       "isless",
                       "isunordered",
                       "signgam",
                       "math_errhandling"};

const Words python_words = {"False",   "None",     "True",     "and",    "as",   "assert", "async",    "await",
                            "break",   "class",    "continue", "def",    "del",  "elif",   "else",     "except",
                            "finally", "for",      "from",     "global", "if",   "import", "in",       "is",
                            "lambda",  "nonlocal", "not",      "or",     "pass", "raise",  "return",   "try",
                            "while",   "with",     "yield",    "match",  "case", "type",   "UNKNOWNS", "newton_euler"};

// Octave's words among them.
const Words matlab_words = {"break",
                            "case",
                            "catch",
                            "classdef",
                            "continue",
                            "do",
                            "else",
                            "elseif",
                            "end",
                            "end_try_catch",
                            "end_unwind_protect",
                            "endclassdef",
                            "endenumeration",
                            "endevents",
                            "endfor",
                            "endfunction",
                            "endif",
                            "endmethods",
                            "endparfor",
                            "endproperties",
                            "endswitch",
                            "endwhile",
                            "enumeration",
                            "events",
                            "for",
                            "function",
                            "global",
                            "if",
                            "import",
                            "methods",
                            "otherwise",
                            "parfor",
                            "persistent",
                            "properties",
                            "return",
                            "spmd",
                            "switch",
                            "try",
                            "until",
                            "unwind_protect",
                            "unwind_protect_cleanup",
                            "while",
                            "arguments",
                            "ans",
                            "determinants",
                            "newton_euler",
                            "nargin",
                            "nargout",
                            "varargin",
                            "varargout"};

// |A|, w and w_e of the headings.
const Words text_words = {"A", "atan2", "w", "w_e", "cos", "sin", "sqrt", "pi"};

constexpr std::string_view reserved_prefixes[] = {"determinant_", "M_",   "FP_",  "HUGE_",
                                                  "MATH_",        "SNAN", "DBL_", "FLT_"};

bool is_program(Language language) {
  return language == Language::c || language == Language::python || language == Language::matlab;
}

const Words& words_of(Language language) {
  switch (language) {
    case Language::c:
      return c_words;
    case Language::python:
      return python_words;
    case Language::matlab:
      return matlab_words;
    case Language::text:
    case Language::latex:
      break;
  }
  return text_words;
}

std::string replace_all(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

/// Those that LaTeX has a command for.
const Words greek_letters = {"alpha",   "beta",   "gamma", "delta",   "epsilon", "zeta",  "eta",   "theta", "iota",
                             "kappa",   "lambda", "mu",    "nu",      "xi",      "pi",    "rho",   "sigma", "tau",
                             "upsilon", "phi",    "chi",   "psi",     "omega",   "Gamma", "Delta", "Theta", "Lambda",
                             "Xi",      "Pi",     "Sigma", "Upsilon", "Phi",     "Psi",   "Omega"};

std::string upright(const std::string& word) { return "\\mathrm{" + latex_text(word) + "}"; }

}  // namespace

bool CodeNames::is_free(const std::string& name) const {
  if (taken_.contains(name) || words_of(language_).contains(name)) return false;
  if (!is_program(language_)) return true;
  if (own_words.contains(name)) return false;
  return std::none_of(std::begin(reserved_prefixes), std::end(reserved_prefixes),
                      [&](std::string_view prefix) { return name.starts_with(prefix); });
}

const std::string& CodeNames::name(const std::string& kind, const std::string& wanted) {
  const auto key = std::pair(kind, wanted);
  const auto found = names_.find(key);
  if (found != names_.end()) return found->second;
  // MATLAB tells names apart by their first 63 characters, C99 too; one that begins with _ is C's or no MATLAB.
  constexpr std::size_t longest = 50;
  std::string written = wanted;
  if (is_program(language_)) {
    if (!written.empty() && written.front() == '_') written.insert(0, "v");
    for (const std::string_view prefix : reserved_prefixes)
      if (written.starts_with(prefix)) written.insert(0, "v_");
    if (written.size() > longest) written.resize(longest);
  }
  const std::string stem = written;
  for (int number = 2; !is_free(written); ++number)
    written = number == 2 ? stem + "_" : stem + "_" + std::to_string(number);
  taken_.insert(written);
  if (written != wanted) renamed_.emplace_back(kind + wanted, written);
  return names_.emplace(key, written).first->second;
}

std::string CodeNames::in_formula(const std::string& kind, const std::string& wanted) {
  const std::string& written = name(kind, wanted);
  if (language_ != Language::latex) return written;
  // What is derived of a point has its own letter first: x of the point i is no xi. Names of a file may be set alike:
  // theta1 and theta_1.
  const std::string set = kind == derived ? latex_derived(written) : latex_symbol(written);
  const auto [same, fresh] = set_.emplace(set, written);
  return fresh || same->second == written ? set : upright(written);
}

std::string comment_text(const std::string& text, Language language) {
  std::string line = text;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  line = core::printable(line);
  if (language != Language::c) return line;
  // "*/" ends a comment, "/*" in one is a warning; so are trigraphs and, at a line's end, a backslash.
  line = replace_all(line, "*/", "* /");
  line = replace_all(line, "/*", "/ *");
  line = replace_all(line, "??", "? ?");
  return line;
}

std::string latex_text(const std::string& name) { return replace_all(name, "_", "\\_"); }

std::string latex_derived(const std::string& name) {
  std::string first = latex_text(name.substr(0, 1));
  if (name.size() == 1) return first;
  const std::string of = name.substr(1);
  return first + "_{" + (greek_letters.contains(of) ? "\\" + of : latex_text(of)) + "}";
}

std::string latex_symbol(const std::string& name) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto end_of_word = std::find_if_not(name.begin(), name.end(), is_letter);
  const std::string word(name.begin(), end_of_word);
  // A letter and what it is of: "xB2", "lAB".
  if (word.empty() || (word.size() > 1 && std::isupper(static_cast<unsigned char>(word[1])) != 0))
    return latex_derived(name);
  std::string rest(end_of_word, name.end());
  if (rest.size() > 1 && rest.front() == '_') rest.erase(0, 1);
  std::string first = greek_letters.contains(word) ? "\\" + word : word.size() == 1 ? word : upright(word);
  if (rest.empty()) return first;
  const bool is_word = rest.size() > 1 && std::all_of(rest.begin(), rest.end(), is_letter);
  return first + "_{" + (greek_letters.contains(rest) ? "\\" + rest : is_word ? upright(rest) : latex_text(rest)) + "}";
}

}  // namespace clearloci::symbolic
