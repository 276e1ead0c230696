// The equations behind the loci, printed: A, |A|, every Cramer numerator |A_J^k| with its factors, their causes and
// implicit polynomials (results.md, `equations`).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::symbolic {

enum class Language { text, latex, c, python, matlab };

struct ImplicitPolynomial {
  std::string polynomial;
  int degree = 0;           ///< total degree in the free coordinates
  std::string closed_form;  ///< "circle: centre (d, L), radius L"; empty where there is none
};

struct DeterminantFactor {
  std::string expression;
  int multiplicity = 1;
  std::string cause;  ///< may be empty
  std::vector<ImplicitPolynomial> implicit;
  bool too_heavy = false;  ///< `implicit` is empty: the roots' conjugates come to more than anyone can use
};

/// |A| or one numerator |A_J^k|. `name`: the unknown ("fA1x"), or "A" for the determinant itself.
struct Determinant {
  std::string name;
  std::string expression;                  ///< exact value of the printed determinant, sign included; "0" possible
  std::vector<DeterminantFactor> factors;  ///< without the constant
};

/// Of a mechanism with free efforts without a value: reactions that vanish at one choice of efforts where the
/// determinant does; A with -w_e and the columns of the efforts in the place of their columns, without factors with
/// which a reaction vanishes at every effort (docs/background/method.md section 15).
struct PreloadEquation {
  std::vector<std::string> reactions;  ///< "M_A1"
  std::string words;                   ///< "M_A1 and M_A3 can only vanish together"
  Determinant determinant;             ///< its name: the reactions, "_" between them
};

struct EquationSheet {
  std::string mechanism;
  Language language = Language::text;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name, exact value
  /// Names that mean something else in the language or in the equations: as in the file, as written here.
  std::vector<std::pair<std::string, std::string>> renamed;
  std::vector<std::string> coordinates;
  std::vector<std::string> rows;                 ///< "A1B1: fx", "A1B1: moment about P", ...
  std::vector<std::string> unknowns;             ///< column order: "fA1x", "fA1y", ..., "MA1"
  std::vector<std::vector<std::string>> matrix;  ///< A
  std::vector<std::string> loads;                ///< the column -w_e
  /// How every constructed point's symbols follow from the coordinates, in order of evaluation: "xB1" = "...".
  std::vector<std::pair<std::string, std::string>> closure;
  /// Of points that close together, whose places are unknowns behind the coordinates: the polynomials that are zero
  /// where they close, as many as unknowns.
  std::vector<std::string> closing;
  Determinant determinant;
  std::vector<Determinant> numerators;  ///< with free efforts of zero
  /// Joint and column -w_e of one N or N m, of each free effort without a value.
  std::vector<std::pair<std::string, std::vector<std::string>>> efforts = {};
  std::vector<PreloadEquation> preload = {};
};

struct SheetOptions {
  Language language = Language::text;
  bool keep_parameters = false;  ///< --symbolic
};

/// Derived once, and written in each of the languages.
std::vector<EquationSheet> equation_sheets(const mechanism::Mechanism& mechanism,
                                           const std::vector<Language>& languages, bool keep_parameters);

EquationSheet equation_sheet(const mechanism::Mechanism& mechanism, const SheetOptions& options);

/// The whole sheet as a text to read (text, latex) or to run (c, python, matlab).
std::string format(const EquationSheet& sheet);

}  // namespace clearloci::symbolic
