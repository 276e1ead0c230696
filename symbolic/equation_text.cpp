// The equation sheet as a document to read or a program to run.
#include <algorithm>
#include <cctype>
#include <sstream>

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
  out << sheet.mechanism << "\n\nA w = -w_e\n\nParameters\n";
  for (const auto& [name, value] : sheet.parameters) out << "  " << name << " = " << value << "\n";
  out << "\nClosure\n";
  for (const auto& [name, value] : sheet.closure) out << "  " << name << " = " << value << "\n";
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
  return out.str();
}

std::string latex_name(const std::string& unknown) {
  return unknown.substr(0, 1) + "_{\\mathrm{" + unknown.substr(1) + "}}";
}

std::string format_latex(const EquationSheet& sheet) {
  std::ostringstream out;
  out << "% " << sheet.mechanism << ": A w = -w_e\n% needs amsmath; for more than ten columns: "
      << "\\setcounter{MaxMatrixCols}{" << sheet.unknowns.size() + 1 << "}\n";
  for (const auto& [name, value] : sheet.closure) out << "\\[ " << name << " = " << value << " \\]\n";
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
  return out.str();
}

/// What the generated programs differ in.
struct Syntax {
  std::string comment, terminator, declare;
};

Syntax syntax_of(Language language) {
  if (language == Language::c) return {"//", ";", "const double "};
  if (language == Language::python) return {"#", "", ""};
  return {"%", ";", ""};
}

/// The names a program needs before anything else: numeric parameters kept symbolic are set to their values.
void write_definitions(std::ostream& out, const EquationSheet& sheet, const Syntax& syntax, const std::string& indent) {
  for (const auto& [name, value] : sheet.closure) {
    out << indent << syntax.declare << name << " = " << value << syntax.terminator << "\n";
  }
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
  return list;
}

std::string format_c(const EquationSheet& sheet) {
  const std::string n = std::to_string(sheet.unknowns.size());
  const Syntax syntax = syntax_of(Language::c);
  std::ostringstream out;
  out << "/* " << sheet.mechanism << ": A w = -w_e. Unknowns:";
  for (const std::string& unknown : sheet.unknowns) out << " " << unknown;
  out << " */\n#include <math.h>\n\n";
  for (const auto& [name, value] : sheet.parameters) {
    out << "static const double " << identifier(name) << " = " << value << ";\n";
  }
  out << "\nvoid newton_euler(" << arguments(sheet, "double ") << ", double A[" << n << "][" << n << "], double b[" << n
      << "]) {\n";
  write_definitions(out, sheet, syntax, "  ");
  for (std::size_t i = 0; i < sheet.matrix.size(); ++i) {
    for (std::size_t j = 0; j < sheet.matrix[i].size(); ++j) {
      out << "  A[" << i << "][" << j << "] = " << sheet.matrix[i][j] << ";\n";
    }
    out << "  b[" << i << "] = " << sheet.loads[i] << ";\n";
  }
  out << "}\n";
  for (const Determinant* d : all_determinants(sheet)) {
    out << "\ndouble determinant_" << identifier(d->name) << "(" << arguments(sheet, "double ") << ") {\n";
    write_definitions(out, sheet, syntax, "  ");
    out << "  return " << d->expression << ";\n}\n";
  }
  return out.str();
}

std::string format_python(const EquationSheet& sheet) {
  const Syntax syntax = syntax_of(Language::python);
  std::ostringstream out;
  out << "# " << sheet.mechanism << ": A w = -w_e\nfrom math import cos, pi, sin, sqrt\n\n";
  for (const auto& [name, value] : sheet.parameters) {
    std::string expression = value;
    for (std::size_t at = 0; (at = expression.find('^', at)) != std::string::npos; at += 2)
      expression.replace(at, 1, "**");
    out << identifier(name) << " = " << expression << "\n";
  }
  out << "UNKNOWNS = [";
  for (const std::string& unknown : sheet.unknowns) out << "\"" << unknown << "\", ";
  out << "]\n\n\ndef newton_euler(" << arguments(sheet, "") << "):\n    \"\"\"A and -w_e as lists.\"\"\"\n";
  write_definitions(out, sheet, syntax, "    ");
  out << "    A = [\n";
  for (const auto& row : sheet.matrix) {
    out << "        [";
    for (std::size_t j = 0; j < row.size(); ++j) out << (j == 0 ? "" : ", ") << row[j];
    out << "],\n";
  }
  out << "    ]\n    b = [";
  for (std::size_t i = 0; i < sheet.loads.size(); ++i) out << (i == 0 ? "" : ", ") << sheet.loads[i];
  out << "]\n    return A, b\n";
  for (const Determinant* d : all_determinants(sheet)) {
    out << "\n\ndef determinant_" << identifier(d->name) << "(" << arguments(sheet, "") << "):\n";
    write_definitions(out, sheet, syntax, "    ");
    out << "    return " << d->expression << "\n";
  }
  return out.str();
}

std::string format_matlab(const EquationSheet& sheet) {
  const Syntax syntax = syntax_of(Language::matlab);
  std::ostringstream out;
  out << "function [A, b, determinants] = newton_euler(" << arguments(sheet, "") << ")\n% " << sheet.mechanism
      << ": A w = -w_e. Unknowns:";
  for (const std::string& unknown : sheet.unknowns) out << " " << unknown;
  out << "\n% determinants: |A|, then the numerator of every unknown\n";
  for (const auto& [name, value] : sheet.parameters) out << identifier(name) << " = " << value << ";\n";
  write_definitions(out, sheet, syntax, "");
  out << "A = [\n";
  for (const auto& row : sheet.matrix) {
    for (std::size_t j = 0; j < row.size(); ++j) out << (j == 0 ? "  " : ", ") << "(" << row[j] << ")";
    out << ";\n";
  }
  out << "];\nb = [";
  for (const std::string& load : sheet.loads) out << "(" << load << "); ";
  out << "];\ndeterminants = [\n";
  for (const Determinant* d : all_determinants(sheet)) out << "  (" << d->expression << ");\n";
  out << "];\nend\n";
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
