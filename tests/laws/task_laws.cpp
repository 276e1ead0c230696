// Verdicts of tasks against sampling, certificates against the second opinion, studies against verify.
#include <algorithm>
#include <cmath>

#include "analysis/zones.hpp"
#include "check/check.hpp"
#include "clearloci/study.hpp"
#include "core/errors.hpp"
#include "mechanism/read_task.hpp"
#include "report/certificate.hpp"
#include "report/verification.hpp"
#include "tests/laws/law_subject.hpp"
#include "tests/laws/same_topology.hpp"
#include "tests/laws/task_designs.hpp"
#include "tests/laws/task_oracle.hpp"

namespace clearloci::test {
namespace {

std::mt19937 random_of(const LawDesign& design, int step) {
  std::seed_seq sequence{design.seed, static_cast<int>(design.family), design.index, 1 + step};
  return std::mt19937(sequence);
}

/// A pose of the file's working mode, in the file's unit.
std::optional<std::array<double, 2>> reached(Subject& s, std::mt19937& random) {
  const std::vector<int> sides = mechanism::working_mode(s.mechanism);
  const auto between = [&](std::size_t c) {
    return std::uniform_real_distribution<double>(s.lower(c), s.upper(c))(random);
  };
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 2> at = {between(0), between(1)};
    if (s.witness.reachable(at, sides)) return at;
  }
  return std::nullopt;
}

/// The task file's lines: a box, a circle, a polygon or a path about a pose that is reached, and wishes.
std::optional<std::string> task_text(Subject& s, std::mt19937& random) {
  const auto at = reached(s, random);
  if (!at) return std::nullopt;
  const auto in = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const double unit = core::to_double(s.design.unit), size = s.size();
  // Of the lattice on places with few digits.
  const auto number = [&](double metres) {
    core::Rational value(s.design.lattice ? core::Rational(std::lround(metres / size * 64), 64)
                                          : core::Rational(std::lround(metres / size * 100000), 100000));
    value.canonicalize();
    return text_of(core::Rational(value * core::Rational(size * unit)));
  };
  const auto place = [&](double dx, double dy) {
    return "[" + number((*at)[0] + dx) + ", " + number((*at)[1] + dy) + "]";
  };
  const auto step = [&] { return size * (in(0, 1) == 0 ? 1 : -1) * in(1, 8) / 128.0; };
  const double side = size * in(1, 10) / 128.0;
  std::string text = "format: 1\n";
  switch (in(0, 3)) {
    case 0:
      text += "box: {x: [" + number((*at)[0]) + ", " + number((*at)[0] + side) + "], y: [" + number((*at)[1]) + ", " +
              number((*at)[1] + side) + "]}\n";
      break;
    case 1:
      text += "circle: {centre: " + place(0, 0) + ", radius: " + number(side) + "}\n";
      break;
    case 2:
      text += "polygon: [" + place(0, 0) + ", " + place(side, step()) + ", " + place(step(), side) + "]\n";
      break;
    default:
      text += "path: [" + place(0, 0) + ", " + place(step(), step()) + ", " + place(step(), step()) + "]\n";
  }
  if (in(0, 1) == 0) text += "margin: " + number(size * in(1, 4) / 256.0) + "\n";
  if (has(s.design.forms, Form::task_loads))
    text += "loads_from: [[" + std::to_string(in(-9, -1) * 10) + ", -100], [" + std::to_string(in(1, 9) * 10) +
            ", -100]]\n";
  if (has(s.design.forms, Form::task_least))
    text += in(0, 1) == 0 ? "min_force: " + std::to_string(in(1, 30)) + "\n" : "min_couple: 1/2\n";
  if (has(s.design.forms, Form::task_tolerances))
    text += "tolerances: {push: 1/" + std::to_string(in(10, 1000)) + ", d: " + number(size / 4096) + "}\n";
  if (has(s.design.forms, Form::task_balls))
    text += "loads_within: [{load: 1, radius: " + std::to_string(in(1, 12)) + "}]\n";
  if (has(s.design.forms, Form::task_error)) text += "pose_error: " + micrometres(in(20, 400), s.design.unit) + "\n";
  return text;
}

/// Loads of balls and designs within tolerances, some of them: a verified task keeps its signs for each.
void hold_spread(Subject& s, std::mt19937& random, const core::Task& task, const Verification& result) {
  const auto part = [&] { return 2 * std::uniform_real_distribution<double>(0, 1)(random) - 1; };
  for (int sample = 0; sample < 12; ++sample) {
    std::vector<mechanism::Override> values;
    for (const core::Tolerance& tolerance : task.tolerances)
      for (const auto& [name, value] : s.design.values)
        if (name == tolerance.parameter) {
          const double by = part();
          const core::Rational at =
              value + (by < 0 ? tolerance.below * core::Rational(-by) : tolerance.above * core::Rational(by));
          values.emplace_back(name, core::to_string(at));
        }
    const mechanism::Mechanism member = mechanism::parse_mechanism(s.design.text, "member.yaml", values);
    core::Task alone = task;
    alone.tolerances.clear(), alone.loads_within.clear(), alone.pose_error.reset();
    const Oracle oracle(member, alone);
    hold_verified(random, oracle, alone, result, 10, [&](bool holds, const std::string& what) {
      if (!holds) s.report.fault("within the tolerances: " + what);
    });
  }
}

/// What goes to a certificate is traced in other ways here and there; the loci are the same.
void tells_the_same(Subject& s, const core::LocusMap& with_certificate) {
  const std::optional<core::LocusMap> map = loci_of(s);
  if (!map || !map->complete || !with_certificate.complete) return;
  for (const std::string& difference : differences(*map, with_certificate, EndsOnSides::by_place))
    s.report.fault("without and with a certificate: " + difference);
  s.report.held("maps without and with a certificate");
}

}  // namespace

void judge_task(Subject& s) {
  if (!s.is_plane()) return;
  std::mt19937 random = random_of(s.design, 1);
  // Shapes that leave the box or cross themselves are drawn anew.
  std::optional<std::string> text;
  std::optional<core::Task> drawn;
  for (int i = 0; i < 20 && !drawn; ++i) {
    text = task_text(s, random);
    if (!text) return;
    try {
      drawn = mechanism::parse_task(*text, "task.yaml", s.mechanism);
    } catch (const core::InputError&) {
      drawn.reset();
    }
  }
  if (!drawn) return s.report.refused("no task of twenty fits: " + *text);
  const core::Task& task = *drawn;
  Verification result;
  try {
    result = s.report.in_patience([&] { return test::decided(s.mechanism, task, {}); });
  } catch (const core::InputError& refused) {
    return s.report.refused(refused.what());
  }
  s.report.held(to_string(result.verdict) + " tasks");
  if (result.verdict == core::Verdict::undecided) s.report.uncertified("task");
  const Say say = [&](bool holds, const std::string& what) {
    if (!holds) s.report.fault(what + " with the task " + *text);
  };
  say(result.witness.has_value() == (result.verdict == core::Verdict::refuted), "a witness");
  say(result.open.has_value() == (result.verdict == core::Verdict::undecided), "what is open");
  const bool nominal = task.tolerances.empty() && task.loads_within.empty() && !task.pose_error;
  const Oracle oracle(s.mechanism, task);
  if (result.verified()) {
    hold_verified(random, oracle, task, result, 200, say);
    if (!nominal && !task.loads) hold_spread(s, random, task, result);
  } else if (result.witness && nominal) {
    hold_refuted(oracle, task, *result.witness, say);
  }
}

/// What the program writes as proven the checker accepts.
void judge_certificate(Subject& s) {
  if (!s.is_plane()) return;
  std::string text;
  core::Certificate certificate;
  const bool with_zones = s.design.index % 3 == 0;
  try {
    const report::CertificateSource source{with_zones ? "zones" : "loci", s.design.text, {}};
    if (with_zones) {
      s.report.in_patience([&] { return find_zones(s.mechanism, {s.request}, &certificate); });
    } else {
      const core::LocusMap map = s.report.in_patience([&] { return trace_loci(s.mechanism, s.request, &certificate); });
      tells_the_same(s, map);
    }
    text = report::certificate_text(source, certificate);
  } catch (const core::InputError& refused) {
    return s.report.refused(refused.what());
  } catch (const core::LimitReached&) {
    return s.report.late();
  }
  try {
    // It is slower than what it checks: it takes no one's time but its own.
    const check::Examination examination =
        check::check_certificate_text(s.design.text, "design.yaml", text, "certificate");
    if (!examination.accepted) s.report.fault("check rejects: " + examination.why.substr(0, 400));
    s.report.held("certificates");
    s.report.held("claims of certificates left unchecked", static_cast<long>(examination.unchecked.size()));
  } catch (const core::InputError& refused) {
    s.report.fault(std::string("check refuses: ") + refused.what());
  }
}

/// A study says of each design what verify says of it.
void judge_study(Subject& s) {
  if (!s.is_plane() || s.design.values.empty() || has(s.design.forms, Form::units)) return;
  std::mt19937 random = random_of(s.design, 2);
  const auto task = task_text(s, random);
  if (!task) return;
  const core::Rational d = s.design.values.front().second, spread = core::Rational(s.size()) / 20;
  const std::string text =
      "format: 1\nvary: {d: [" + text_of(core::Rational(d - spread)) + ", " + text_of(core::Rational(d + spread)) +
      "]}\ntask:\n  " +
      [&] {
        std::string lines = task->substr(task->find('\n') + 1);
        for (std::size_t at = lines.find('\n'); at + 1 < lines.size(); at = lines.find('\n', at + 1))
          lines.replace(at, 1, "\n  ");
        return lines;
      }() +
      "goal: {maximise: margin}\nmethod: {grid: [4]}\n";
  try {
    const Model model = Model::parse(s.design.text);
    const Study study = parse_study(text, model);
    const StudyResult result = s.report.in_patience([&] { return run_study(model, study, {.threads = 1}); });
    for (const StudyDesign& design : result.designs) {
      const Model member = design_model(model, result, design);
      const Verification answer =
          s.report.in_patience([&] { return verify(member, study.tasks.front(), {.depth = VerifyDepth::margin}); });
      using Status = StudyDesign::Status;
      const bool differs = (design.status == Status::feasible && answer.verdict == Verdict::refuted) ||
                           (design.status == Status::infeasible && answer.verdict == Verdict::verified);
      if (differs)
        s.report.fault("a study says " + to_string(design.status) + " (" + design.reason + "), verify " +
                       to_string(answer.verdict) + " of d = " + std::to_string(design.values.front()) + " in " + text);
      s.report.held("designs of studies");
    }
  } catch (const core::InputError& refused) {
    s.report.refused(refused.what());
  }
}

}  // namespace clearloci::test
