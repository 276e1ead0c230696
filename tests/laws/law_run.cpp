#include "tests/laws/law_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "core/errors.hpp"
#include "tests/laws/law_subject.hpp"

namespace clearloci::test {
namespace {

constexpr rlim_t most_memory = 6'000'000'000;
// Of CPU, s: what the law itself may take in one step, questions to the program apart.
constexpr rlim_t most_seconds = 300;

struct StepRow {
  const char* name;
  void (*judge)(Subject&);
};
constexpr std::array steps = {StepRow{"loci", judge_loci},         StepRow{"validate", judge_validation},
                              StepRow{"engines", judge_engines},   StepRow{"margins", judge_margins},
                              StepRow{"zones", judge_zones},       StepRow{"verify", judge_task},
                              StepRow{"check", judge_certificate}, StepRow{"study", judge_study}};

/// In the child: tells `out` what it finds, a line each.
void work(const LawDesign& design, const StepRow& step, int patience, int out) {
  rlimit memory{most_memory, most_memory}, time{most_seconds, most_seconds};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CPU, &time);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  Report report(
      [out](const std::string& line) {
        const std::string whole = line + "\n";
        if (write(out, whole.data(), whole.size()) < 0) _exit(1);
      },
      patience);
  try {
    Subject subject(design, report);
    step.judge(subject);
  } catch (const core::InputError& refused) {
    // The reader refuses boxes in which no pose can be reached, and links that bend; which these are, its tests know.
    report.refused(refused.what());
  } catch (const std::bad_alloc&) {
    report.fault("out of memory");
  } catch (const std::exception& error) {
    report.fault(std::string("throws: ") + error.what());
  }
}

struct StepAnswer {
  std::vector<std::string> lines;
  int status = 0;
  double seconds = 0;
};

StepAnswer in_child(const LawDesign& design, const StepRow& step, int patience) {
  std::array<int, 2> ends{};
  core::ensure(pipe(ends.data()) == 0, "a pipe");
  std::cout.flush();
  const pid_t child = fork();
  core::ensure(child >= 0, "a process");
  if (child == 0) {
    close(ends[0]);
    work(design, step, patience, ends[1]);
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(ends[0], part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  StepAnswer answer;
  rusage usage{};
  wait4(child, &answer.status, 0, &usage);
  answer.seconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                   1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) answer.lines.push_back(line);
  return answer;
}

void take(Judgement& judgement, const std::string& step, const StepAnswer& answer) {
  judgement.seconds += answer.seconds;
  const auto reach = [&](Outcome outcome) { judgement.outcome = std::max(judgement.outcome, outcome); };
  for (const std::string& line : answer.lines) {
    const std::size_t blank = line.find(' ');
    const std::string kind = line.substr(0, blank), rest = line.substr(blank + 1);
    if (kind == "fault") {
      judgement.faults.push_back(step + ": " + rest);
      reach(Outcome::contradicted);
    } else if (kind == "uncertified") {
      judgement.doubts.push_back(step + ": " + rest);
      reach(Outcome::uncertified);
    } else if (kind == "late") {
      judgement.doubts.push_back(step + ": not done");
      reach(Outcome::late);
    } else if (kind == "refused") {
      judgement.doubts.push_back(step + ": refused: " + rest.substr(0, 200));
      if (step != "loci") continue;  // a command may refuse what others do
      judgement.outcome = Outcome::refused;
    } else if (kind == "held") {
      const std::size_t next = rest.find(' ');
      judgement.held[rest.substr(next + 1)] += std::atol(rest.c_str());
    }
  }
  if (WIFSIGNALED(answer.status)) {
    const int signal = WTERMSIG(answer.status);
    if (signal == SIGXCPU || signal == SIGKILL) {
      judgement.doubts.push_back(step + ": not done");
      reach(Outcome::late);
    } else {
      judgement.faults.push_back(step + ": ended by signal " + std::to_string(signal));
      reach(Outcome::contradicted);
    }
  }
}

std::string file_name(const Judgement& judgement) {
  std::string name = to_string(judgement.family) + "_" + std::to_string(judgement.index);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

void keep_design(const std::string& folder, const LawDesign& design, const Judgement& judgement) {
  std::ofstream file(folder + "/" + to_string(judgement.outcome) + "_" + file_name(judgement) + ".yaml");
  file << "# " << arguments_of(design) << "\n";
  for (const std::string& fault : judgement.faults) file << "# " << fault.substr(0, 500) << "\n";
  for (const std::string& doubt : judgement.doubts) file << "# " << doubt.substr(0, 300) << "\n";
  file << design.text;
}

/// Its first fault, otherwise the first doubt of each step.
std::string summary_of(const Judgement& judgement) {
  if (!judgement.faults.empty()) return judgement.faults.front().substr(0, 300);
  std::string summary, last;
  for (const std::string& doubt : judgement.doubts) {
    const std::string step = doubt.substr(0, doubt.find(':'));
    if (step != last) summary += (summary.empty() ? "" : ", ") + doubt.substr(0, 60);
    last = step;
  }
  return summary;
}

/// A line of the state file: family, index, lattice, forms, outcome, s, what was held.
std::string line_of(const Judgement& j) {
  std::string held;
  for (const auto& [what, count] : j.held) held += fmt::format("\t{} {}", count, what);
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{:.2f}{}\n", static_cast<int>(j.family), j.index, j.lattice ? 1 : 0,
                     j.forms.to_string(), static_cast<int>(j.outcome), j.seconds, held);
}

std::vector<Judgement> read_state(const std::string& file) {
  std::vector<Judgement> list;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("#")) continue;
    std::vector<std::string> words;
    std::istringstream parts(line);
    for (std::string word; std::getline(parts, word, '\t');) words.push_back(word);
    if (words.size() < 6 || words[3].size() != form_table.size()) continue;  // of a run that was cut off
    Judgement j;
    j.family = static_cast<Family>(std::stoi(words[0])), j.index = std::stoi(words[1]), j.lattice = words[2] == "1";
    j.forms = FormSet(words[3]), j.outcome = static_cast<Outcome>(std::stoi(words[4])), j.seconds = std::stod(words[5]);
    for (std::size_t i = 6; i < words.size(); ++i)
      j.held[words[i].substr(words[i].find(' ') + 1)] = std::atol(words[i].c_str());
    list.push_back(std::move(j));
  }
  return list;
}

struct Count {
  int designs = 0;
  std::array<int, 5> outcomes{};
  double seconds = 0;

  void add(const Judgement& j) {
    ++designs, ++outcomes[static_cast<std::size_t>(j.outcome)];
    seconds += j.seconds;
  }
};

std::string row_of(const std::string& name, const Count& count) {
  const auto of = [&](Outcome outcome) { return count.outcomes[static_cast<std::size_t>(outcome)]; };
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.1f} |\n", name, count.designs, of(Outcome::held),
                     of(Outcome::refused), of(Outcome::uncertified), of(Outcome::late), of(Outcome::contradicted),
                     count.designs > 0 ? count.seconds / count.designs : 0);
}

}  // namespace

std::string to_string(Outcome outcome) {
  static const std::array<const char*, 5> names = {"refused", "held", "uncertified", "late", "contradicted"};
  return names[static_cast<std::size_t>(outcome)];
}

Judgement judge(const LawDesign& design, int patience) {
  Judgement judgement{design.family, design.index, design.lattice, design.forms, Outcome::held, 0, {}, {}, {}};
  for (const StepRow& step : steps) {
    take(judgement, step.name, in_child(design, step, patience));
    if (judgement.outcome == Outcome::refused) break;
  }
  return judgement;
}

std::vector<Judgement> run(const LawRun& run) {
  std::vector<Judgement> all = run.state.empty() ? std::vector<Judgement>{} : read_state(run.state);
  const auto is_known_index = [&](Family family, int index) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Judgement& j) { return j.family == family && j.index == index; });
  };
  std::ofstream state;
  if (!run.state.empty()) state.open(run.state, std::ios::app);
  const int families = static_cast<int>(run.families.size());
  for (int i = 0; i < run.designs; ++i) {
    const Family family = run.families[static_cast<std::size_t>(i % families)];
    const int index = run.first + i / families;
    if (is_known_index(family, index)) continue;
    const LawDesign design = law_design(run.seed, family, index);
    const Judgement judgement = judge(design, run.patience);
    if (state.is_open()) state << line_of(judgement) << std::flush;
    if (!run.keep.empty() && judgement.outcome > Outcome::held) keep_design(run.keep, design, judgement);
    if (judgement.outcome > Outcome::held)
      std::cout << to_string(family) << " " << index << ": " << to_string(judgement.outcome) << " "
                << summary_of(judgement) << std::endl;
    all.push_back(judgement);
  }
  return all;
}

std::string table_of(const std::vector<Judgement>& judgements) {
  Count total;
  std::map<Family, Count> families;
  std::map<std::size_t, Count> forms;
  std::map<std::string, long> held;
  for (const Judgement& j : judgements) {
    total.add(j);
    families[j.family].add(j);
    for (std::size_t f = 0; f < form_table.size(); ++f)
      if (j.forms.test(f)) forms[f].add(j);
    for (const auto& [what, count] : j.held) held[what] += count;
  }
  const std::string head =
      " | designs | held | refused | not certified | not done | contradicted | s each |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::string text = "| family" + head;
  for (const auto& [family, count] : families) text += row_of(to_string(family), count);
  text += row_of("all", total) + "\n| form" + head;
  for (const auto& [form, count] : forms) text += row_of(form_table[form].name, count);
  text += fmt::format("\n{:.2f} h of CPU; held:", total.seconds / 3600);
  for (const auto& [what, count] : held) text += fmt::format(" {} {},", count, what);
  text.back() = '\n';
  return text;
}

}  // namespace clearloci::test
