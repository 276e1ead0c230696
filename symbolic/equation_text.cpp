// The equation sheet as a document to read or a program to run.
#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "core/text.hpp"
#include "symbolic/code_names.hpp"
#include "symbolic/equation_sheet.hpp"

namespace clearloci::symbolic {
namespace {

/// What an identifier may hold in C, Python and MATLAB.
std::string identifier(const std::string& name) {
  std::string result;
  for (const char c : name) result += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return result;
}

void write_factors(std::ostream& out, const Determinant& d, const std::string& indent) {
  for (const DeterminantFactor& factor : d.factors) {
    out << indent << factor.expression;
    if (factor.multiplicity > 1) out << "   (" << factor.multiplicity << " times)";
    if (!factor.cause.empty()) out << "   [" << factor.cause << "]";
    out << "\n";
    for (const ImplicitPolynomial& implicit : factor.implicit) {
      out << indent << "  degree " << implicit.degree << ": " << implicit.polynomial << " = 0";
      if (!implicit.closed_form.empty()) out << "   [" << implicit.closed_form << "]";
      out << "\n";
    }
    if (factor.too_heavy) out << indent << "  implicit polynomial: of too high a degree to be of use\n";
  }
}

std::string format_text(const EquationSheet& sheet) {
  std::ostringstream out;
  out << core::printable(sheet.mechanism) << "\n\nA w = -w_e\n\nParameters\n";
  for (const auto& [name, value] : sheet.parameters) out << "  " << name << " = " << value << "\n";
  if (!sheet.renamed.empty()) out << "\nNames that mean something else here\n";
  for (const auto& [name, written] : sheet.renamed) out << "  " << name << " is written " << written << "\n";
  out << "\nClosure\n";
  for (const auto& [name, value] : sheet.closure) out << "  " << name << " = " << value << "\n";
  if (!sheet.closing.empty()) out << "\nClosing equations\n";
  for (const std::string& polynomial : sheet.closing) out << "  " << polynomial << " = 0\n";
  out << "\nMatrix A and right-hand side -w_e\n";
  std::size_t label = 0;
  for (const std::string& row : sheet.rows) label = std::max(label, row.size());
  std::vector<std::size_t> widths;
  for (std::size_t j = 0; j <= sheet.unknowns.size(); ++j) {
    std::size_t width = j < sheet.unknowns.size() ? sheet.unknowns[j].size() : 4;
    for (std::size_t i = 0; i < sheet.matrix.size(); ++i) {
      width = std::max(width, (j < sheet.unknowns.size() ? sheet.matrix[i][j] : sheet.loads[i]).size());
    }
    widths.push_back(width);
  }
  const auto padded = [](const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
  };
  out << "  " << std::string(label, ' ');
  for (std::size_t j = 0; j < sheet.unknowns.size(); ++j) out << "  " << padded(sheet.unknowns[j], widths[j]);
  out << " |  " << padded("-w_e", widths.back()) << "\n";
  for (std::size_t i = 0; i < sheet.matrix.size(); ++i) {
    out << "  " << sheet.rows[i] << std::string(label - sheet.rows[i].size(), ' ');
    for (std::size_t j = 0; j < sheet.unknowns.size(); ++j) out << "  " << padded(sheet.matrix[i][j], widths[j]);
    out << " |  " << padded(sheet.loads[i], widths.back()) << "\n";
  }
  out << "\n|A| = " << sheet.determinant.expression << "\n";
  write_factors(out, sheet.determinant, "    ");
  for (const Determinant& numerator : sheet.numerators) {
    out << "\n|A_" << numerator.name << "| = " << numerator.expression << "\n";
    write_factors(out, numerator, "    ");
  }
  for (const auto& [joint, column] : sheet.efforts) {
    out << "\nColumn -w_e of one N or N m of the free effort of " << joint << " (zero above)\n";
    for (std::size_t i = 0; i < column.size(); ++i)
      if (column[i] != "0") out << "  " << sheet.rows[i] << ": " << column[i] << "\n";
  }
  if (!sheet.preload.empty())
    out << "\nPreload: |A| with -w_e and the columns of the free efforts in the place of the columns of reactions, "
           "without what vanishes at every effort\n";
  for (const PreloadEquation& equation : sheet.preload) {
    out << "\n" << equation.words << ": " << equation.determinant.expression << "\n";
    write_factors(out, equation.determinant, "    ");
  }
  return out.str();
}

/// A comment of its own line for every name that had to change.
void write_renamed(std::ostream& out, const EquationSheet& sheet, const std::string& comment) {
  for (const auto& [name, written] : sheet.renamed) out << comment << name << " is written " << written << "\n";
}

std::string latex_name(const std::string& unknown) {
  return unknown.substr(0, 1) + "_{\\mathrm{" + latex_text(unknown.substr(1)) + "}}";
}

std::string format_latex(const EquationSheet& sheet) {
  std::ostringstream out;
  out << "% " << comment_text(sheet.mechanism, Language::latex)
      << ": A w = -w_e\n% needs amsmath; for more than ten columns: "
      << "\\setcounter{MaxMatrixCols}{" << sheet.unknowns.size() + 1 << "}\n";
  write_renamed(out, sheet, "% ");
  for (const auto& [name, value] : sheet.closure) out << "\\[ " << name << " = " << value << " \\]\n";
  for (const std::string& polynomial : sheet.closing) out << "\\[ " << polynomial << " = 0 \\]\n";
  out << "\\setcounter{MaxMatrixCols}{" << sheet.unknowns.size() + 1 << "}\n\\[\n\\begin{bmatrix}\n";
  for (const auto& row : sheet.matrix) {
    for (std::size_t j = 0; j < row.size(); ++j) out << (j == 0 ? "  " : " & ") << row[j];
    out << " \\\\\n";
  }
  out << "\\end{bmatrix}\n\\begin{bmatrix}";
  for (const std::string& unknown : sheet.unknowns) out << " " << latex_name(unknown) << " \\\\";
  out << " \\end{bmatrix} = \\begin{bmatrix}";
  for (const std::string& load : sheet.loads) out << " " << load << " \\\\";
  out << " \\end{bmatrix}\n\\]\n";
  const auto write = [&](const std::string& name, const Determinant& d) {
    out << "\\[ " << name << " = " << d.expression << " \\]\n";
    for (const DeterminantFactor& factor : d.factors) {
      if (!factor.cause.empty()) out << "% " << factor.expression << ": " << factor.cause << "\n";
      for (const ImplicitPolynomial& implicit : factor.implicit) {
        out << "\\[ " << implicit.polynomial << " = 0 \\]";
        if (!implicit.closed_form.empty()) out << " % " << implicit.closed_form;
        out << "\n";
      }
    }
  };
  write("|A|", sheet.determinant);
  for (const Determinant& numerator : sheet.numerators) {
    write("|A_{" + latex_name(numerator.name) + "}|", numerator);
  }
  for (std::size_t i = 0; i < sheet.preload.size(); ++i) {
    out << "% " << comment_text(sheet.preload[i].words, Language::latex) << "\n";
    write("D_{" + std::to_string(i + 1) + "}", sheet.preload[i].determinant);
  }
  return out.str();
}

/// The identifiers in a formula. The e of a number's exponent is none.
std::set<std::string> identifiers(const std::string& formula) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; };
  std::set<std::string> found;
  for (std::size_t at = 0; at < formula.size();) {
    const std::size_t start = at;
    if (!is_letter(formula[at]) && !is_digit(formula[at])) {
      ++at;
      continue;
    }
    while (at < formula.size() && (is_letter(formula[at]) || is_digit(formula[at]))) ++at;
    if (is_letter(formula[start])) found.insert(formula.substr(start, at - start));
  }
  return found;
}

using Lines = std::vector<std::pair<std::string, std::string>>;

/// Of definitions in the order of their evaluation those that `needed` uses, directly or through others; what they use
/// joins `needed`.
Lines used(const Lines& definitions, std::set<std::string>& needed) {
  Lines result;
  for (auto line = definitions.rbegin(); line != definitions.rend(); ++line) {
    if (!needed.contains(line->first)) continue;
    needed.merge(identifiers(line->second));
    result.insert(result.begin(), *line);
  }
  return result;
}

std::string arguments(const EquationSheet& sheet, const std::string& type) {
  std::string list;
  for (const std::string& name : sheet.coordinates) {
    if (!list.empty()) list += ", ";
    list.append(type).append(name);
  }
  return list;
}

std::vector<const Determinant*> all_determinants(const EquationSheet& sheet) {
  std::vector<const Determinant*> list{&sheet.determinant};
  for (const Determinant& numerator : sheet.numerators) list.push_back(&numerator);
  for (const PreloadEquation& equation : sheet.preload) list.push_back(&equation.determinant);
  return list;
}

/// The beginning of a C function's body: its parameters and the closure, as far as `formulas` need them.
void write_c_definitions(std::ostream& out, const EquationSheet& sheet,
                         const std::vector<const std::string*>& formulas) {
  std::set<std::string> needed;
  for (const std::string* formula : formulas) needed.merge(identifiers(*formula));
  const Lines closure = used(sheet.closure, needed);
  for (const std::string& coordinate : sheet.coordinates)
    if (!needed.contains(coordinate)) out << "  (void)" << coordinate << ";\n";
  if (needed.contains("pi")) out << "  const double pi = 3.14159265358979323846;\n";
  for (const Lines& lines : {used(sheet.parameters, needed), closure})
    for (const auto& [name, value] : lines) out << "  const double " << name << " = " << value << ";\n";
}

std::string format_c(const EquationSheet& sheet) {
  const std::string n = std::to_string(sheet.unknowns.size());
  const std::string places = arguments(sheet, "double ");
  std::ostringstream out;
  out << "/* " << comment_text(sheet.mechanism, Language::c) << ": A w = -w_e. Unknowns:";
  for (const std::string& unknown : sheet.unknowns) out << " " << unknown;
  out << " */\n";
  for (const auto& [name, written] : sheet.renamed)
    out << "/* " << comment_text(name, Language::c) << " is written " << written << " */\n";
  out << "#include <math.h>\n\n";
  const std::string matrix = "void newton_euler(" + places + ", double A[" + n + "][" + n + "], double b[" + n + "])";
  const auto head = [&](const Determinant& d) {
    return "double determinant_" + identifier(d.name) + "(" + places + ")";
  };
  out << matrix << ";\n";
  for (const Determinant* d : all_determinants(sheet)) out << head(*d) << ";\n";
  const std::string closing = "void closing(" + places + ", double g[" + std::to_string(sheet.closing.size()) + "])";
  if (!sheet.closing.empty()) {
    out << closing << ";\n\n/* zero where the points of groups close */\n" << closing << " {\n";
    std::vector<const std::string*> polynomials;
    for (const std::string& entry : sheet.closing) polynomials.push_back(&entry);
    write_c_definitions(out, sheet, polynomials);
    for (std::size_t i = 0; i < sheet.closing.size(); ++i) out << "  g[" << i << "] = " << sheet.closing[i] << ";\n";
    out << "}\n";
  }
  out << "\n" << matrix << " {\n";
  std::vector<const std::string*> formulas;
  for (const auto& row : sheet.matrix)
    for (const std::string& entry : row) formulas.push_back(&entry);
  for (const std::string& load : sheet.loads) formulas.push_back(&load);
  write_c_definitions(out, sheet, formulas);
  for (std::size_t i = 0; i < sheet.matrix.size(); ++i) {
    for (std::size_t j = 0; j < sheet.matrix[i].size(); ++j) {
      out << "  A[" << i << "][" << j << "] = " << sheet.matrix[i][j] << ";\n";
    }
    out << "  b[" << i << "] = " << sheet.loads[i] << ";\n";
  }
  out << "}\n";
  for (const Determinant* d : all_determinants(sheet)) {
    out << "\n" << head(*d) << " {\n";
    write_c_definitions(out, sheet, {&d->expression});
    out << "  return " << d->expression << ";\n}\n";
  }
  return out.str();
}

std::string format_python(const EquationSheet& sheet) {
  std::ostringstream out;
  // The name stands below the second line: a comment in the first two may choose the encoding of the file.
  out << "# Equations of a mechanism, A w = -w_e,\n# written by clearloci equations:\n# "
      << comment_text(sheet.mechanism, Language::python) << "\n";
  write_renamed(out, sheet, "# ");
  out << "from math import atan2, cos, pi, sin, sqrt\n\n";
  for (const auto& [name, value] : sheet.parameters) out << name << " = " << value << "\n";
  out << "UNKNOWNS = [";
  for (const std::string& unknown : sheet.unknowns) out << "\"" << unknown << "\", ";
  out << "]\n\n\ndef newton_euler(" << arguments(sheet, "") << "):\n    \"\"\"A and -w_e as lists.\"\"\"\n";
  for (const auto& [name, value] : sheet.closure) out << "    " << name << " = " << value << "\n";
  out << "    A = [\n";
  for (const auto& row : sheet.matrix) {
    out << "        [";
    for (std::size_t j = 0; j < row.size(); ++j) out << (j == 0 ? "" : ", ") << row[j];
    out << "],\n";
  }
  out << "    ]\n    b = [";
  for (std::size_t i = 0; i < sheet.loads.size(); ++i) out << (i == 0 ? "" : ", ") << sheet.loads[i];
  out << "]\n    return A, b\n";
  if (!sheet.closing.empty()) {
    out << "\n\ndef closing(" << arguments(sheet, "") << "):\n    \"\"\"Zero where the points of groups close.\"\"\"\n";
    std::set<std::string> needed;
    for (const std::string& closing : sheet.closing) needed.merge(identifiers(closing));
    for (const auto& [name, value] : used(sheet.closure, needed)) out << "    " << name << " = " << value << "\n";
    out << "    return [";
    for (std::size_t i = 0; i < sheet.closing.size(); ++i) out << (i == 0 ? "" : ", ") << sheet.closing[i];
    out << "]\n";
  }
  for (const Determinant* d : all_determinants(sheet)) {
    out << "\n\ndef determinant_" << identifier(d->name) << "(" << arguments(sheet, "") << "):\n";
    std::set<std::string> needed = identifiers(d->expression);
    for (const auto& [name, value] : used(sheet.closure, needed)) out << "    " << name << " = " << value << "\n";
    out << "    return " << d->expression << "\n";
  }
  return out.str();
}

std::string format_matlab(const EquationSheet& sheet) {
  std::ostringstream out;
  const bool closes = !sheet.closing.empty();
  out << "function [A, b, determinants" << (closes ? ", closing" : "") << "] = newton_euler(" << arguments(sheet, "")
      << ")\n% " << comment_text(sheet.mechanism, Language::matlab) << ": A w = -w_e. Unknowns:";
  for (const std::string& unknown : sheet.unknowns) out << " " << unknown;
  out << "\n";
  write_renamed(out, sheet, "% ");
  out << "% determinants: |A|, then the numerator of every unknown\n";
  if (closes) out << "% closing: zero where the points of groups close\n";
  for (const PreloadEquation& equation : sheet.preload)
    out << "% then: " << comment_text(equation.words, Language::matlab) << "\n";
  for (const Lines* lines : {&sheet.parameters, &sheet.closure})
    for (const auto& [name, value] : *lines) out << name << " = " << value << ";\n";
  out << "A = [\n";
  for (const auto& row : sheet.matrix) {
    for (std::size_t j = 0; j < row.size(); ++j) out << (j == 0 ? "  " : ", ") << "(" << row[j] << ")";
    out << ";\n";
  }
  out << "];\nb = [";
  for (const std::string& load : sheet.loads) out << "(" << load << "); ";
  out << "];\ndeterminants = [\n";
  for (const Determinant* d : all_determinants(sheet)) out << "  (" << d->expression << ");\n";
  out << "];\n";
  if (closes) out << "closing = [\n";
  for (const std::string& closing : sheet.closing) out << "  (" << closing << ");\n";
  out << (closes ? "];\n" : "") << "end\n";
  return out.str();
}

}  // namespace

std::string format(const EquationSheet& sheet) {
  switch (sheet.language) {
    case Language::text:
      return format_text(sheet);
    case Language::latex:
      return format_latex(sheet);
    case Language::c:
      return format_c(sheet);
    case Language::python:
      return format_python(sheet);
    case Language::matlab:
      return format_matlab(sheet);
  }
  return "";
}

}  // namespace clearloci::symbolic
