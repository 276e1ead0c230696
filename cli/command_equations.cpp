// clearloci equations: A, |A|, every numerator and its factors, as text, source code or JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/singular_modes.hpp"
#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/time_limit.hpp"
#include "core/errors.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/wording.hpp"
#include "symbolic/equation_sheet.hpp"

namespace clearloci::cli {
namespace {

using symbolic::Language;

struct LanguageName {
  const char* name;
  Language language;
  const char* ending;
};

constexpr std::array languages = {
    LanguageName{"text", Language::text, "txt"},   LanguageName{"latex", Language::latex, "tex"},
    LanguageName{"c", Language::c, "c"},           LanguageName{"python", Language::python, "py"},
    LanguageName{"matlab", Language::matlab, "m"},
};

struct EquationsCommand {
  CommonArguments common;
  std::string languages = "text";
  bool keep_parameters = false;
};

const LanguageName& find_language(const std::string& word) {
  const auto* const found = std::find_if(languages.begin(), languages.end(),
                                         [&](const LanguageName& language) { return word == language.name; });
  if (found == languages.end())
    throw core::InputError({.file = "--language"}, fmt::format("unknown language '{}'", word),
                           "choose from text, latex, c, python, matlab");
  return *found;
}

using Json = nlohmann::ordered_json;

Json factors_json(const symbolic::Determinant& determinant) {
  Json factors = Json::array();
  for (const symbolic::DeterminantFactor& factor : determinant.factors) {
    Json implicit = Json::array();
    for (const symbolic::ImplicitPolynomial& polynomial : factor.implicit) {
      Json entry = {{"polynomial", polynomial.polynomial}, {"degree", polynomial.degree}};
      if (!polynomial.closed_form.empty()) entry["closed_form"] = polynomial.closed_form;
      implicit.push_back(std::move(entry));
    }
    factors.push_back({{"expression", factor.expression},
                       {"multiplicity", factor.multiplicity},
                       {"cause", factor.cause},
                       {"implicit", std::move(implicit)}});
  }
  return factors;
}

Json dictionary_json(const std::vector<std::pair<std::string, std::string>>& entries) {
  Json dictionary = Json::object();
  for (const auto& [name, content] : entries) dictionary[name] = content;
  return dictionary;
}

/// The object of results.md, with the factors of |A| and the closure besides.
Json sheet_json(const symbolic::EquationSheet& sheet) {
  Json numerators = Json::object();
  for (const symbolic::Determinant& numerator : sheet.numerators)
    numerators[numerator.name] = {{"expression", numerator.expression}, {"factors", factors_json(numerator)}};
  Json all = {{"format", 1},
              {"mechanism", report::printable(sheet.mechanism)},
              {"parameters", dictionary_json(sheet.parameters)},
              {"coordinates", sheet.coordinates},
              {"closure", dictionary_json(sheet.closure)},
              {"closing", sheet.closing},
              {"rows", sheet.rows},
              {"unknowns", sheet.unknowns},
              {"matrix", sheet.matrix},
              {"loads", sheet.loads},
              {"determinant", sheet.determinant.expression},
              {"determinant_factors", factors_json(sheet.determinant)},
              {"numerators", std::move(numerators)}};
  if (sheet.efforts.empty() && sheet.preload.empty()) return all;
  Json preload = Json::array();
  for (const symbolic::PreloadEquation& equation : sheet.preload)
    preload.push_back({{"reactions", equation.reactions},
                       {"words", equation.words},
                       {"expression", equation.determinant.expression},
                       {"factors", factors_json(equation.determinant)}});
  all["efforts"] = Json::object();
  for (const auto& [joint, column] : sheet.efforts) all["efforts"][joint] = column;
  all["preload"] = std::move(preload);
  return all;
}

int run(const EquationsCommand& arguments, TimeLimit& limit) {
  std::vector<LanguageName> chosen;
  for (const std::string& word : split(arguments.languages)) chosen.push_back(find_language(word));
  const mechanism::Mechanism mechanism = read_model(arguments.common);
  require_regular(mechanism, mechanism::working_mode(mechanism));
  const auto incomplete = [common = arguments.common, name = mechanism.name] {
    write_incomplete(common, "equations.json", incomplete_body(name, "every equation was"), false);
  };
  limit.known(incomplete);
  const bool write = !arguments.common.output.empty();
  const std::filesystem::path folder = output_folder(arguments.common);

  if (arguments.common.json) {
    const std::string text = report::json_text(sheet_json(symbolic::equation_sheet(
        mechanism, {.language = Language::text, .keep_parameters = arguments.keep_parameters})));
    limit.writing();
    if (write) report::write_atomically(folder / "equations.json", text);
    fmt::print("{}", text);
    return exit_done;
  }
  report::StagedFiles staged;
  std::string all;
  for (const LanguageName& language : chosen) {
    const std::string text = symbolic::format(symbolic::equation_sheet(
        mechanism, {.language = language.language, .keep_parameters = arguments.keep_parameters}));
    if (write) staged.add(folder / fmt::format("equations.{}", language.ending), text);
    all += text;
  }
  limit.commit(staged);
  if (!arguments.common.quiet) fmt::print("{}", all);
  return exit_done;
}

}  // namespace

Command add_equations_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("equations", "Print the equations behind the loci, exact and factored");
  const auto arguments = std::make_shared<EquationsCommand>();
  add_common_arguments(*app, arguments->common);
  app->add_option("--language", arguments->languages, "text, latex, c, python, matlab; comma-separated")
      ->type_name("LIST")
      ->capture_default_str();
  app->add_flag("--symbolic", arguments->keep_parameters, "Keep the parameters as symbols");
  app->footer(
      "Example: clearloci equations examples/five_bar.yaml --symbolic --language latex\n"
      "With -o the text is also written to DIR/equations.txt (.tex, .c, .py, .m, .json).");
  return within_limit(app, arguments, run);
}

}  // namespace clearloci::cli
