// Where the system has no more threads, work goes on with those that there are. Its own program: for the whole process
// it is settled once how many are to be had.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

#include "clearloci/loci.hpp"
#include "clearloci/study.hpp"
#include "core/errors.hpp"
#include "tests/source_dir.hpp"

namespace {

std::atomic<int> threads_left = 0;

}  // namespace

/// In the place of the system's, for std::thread and for TBB.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  return threads_left-- > 0 ? create(thread, attributes, start, argument) : EAGAIN;
}

namespace clearloci {
namespace {

Model five_bar() { return Model::read(source_dir() + "/examples/five_bar.yaml"); }

Study study_of(const Model& model) {
  return parse_study(
      "format: 1\nvary: {L: [0.3, 0.7], d: [0.3, 0.7]}\ntask: {box: {x: [0.1, 0.4], y: [-0.7, -0.5]}}\n"
      "goal: {maximise: margin}\nmethod: {sample: 100}\n",
      model);
}

TEST(NoThreads, LociAreTracedInOne) {
  threads_left = 0;
  EXPECT_TRUE(trace_loci(five_bar()).complete);
}

TEST(NoThreads, TheExactEngineUnderADeadlineIsLeftOut) {
  threads_left = 0;
  const LociRequest request = {.engine = Engine::exact,
                               .deadline = std::chrono::steady_clock::now() + std::chrono::hours(1)};
  try {
    EXPECT_FALSE(trace_loci(five_bar(), request).complete);
  } catch (const LimitReached&) {
  }
}

TEST(NoThreads, StudiesTakeThoseThatThereAre) {
  const Model model = five_bar();
  const Study study = study_of(model);
  const StudyResult alone = run_study(model, study, {.threads = 1});
  for (const int left : {0, 1}) {
    threads_left = left;
    const StudyResult result = run_study(model, study, {.threads = 5});
    ASSERT_EQ(result.designs.size(), alone.designs.size()) << left;
    EXPECT_EQ(result.best, alone.best) << left;
    EXPECT_LT(threads_left, 0) << "more were asked for";
  }
}

TEST(NoThreads, StudiesTakeNoMoreThanTheyHaveWorkFor) {
  const Model model = five_bar();
  threads_left = most_threads;
  (void)run_study(model, study_of(model), {.threads = most_threads});
  EXPECT_GE(threads_left, most_threads - 5);
  EXPECT_THROW((void)run_study(model, study_of(model), {.threads = most_threads + 1}), InputError);
  EXPECT_THROW((void)run_study(model, study_of(model), {.threads = -1}), InputError);
  threads_left = 0;  // also where the process ends
}

}  // namespace
}  // namespace clearloci
