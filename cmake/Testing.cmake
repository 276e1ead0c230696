# GoogleTest and RapidCheck for every folder's tests.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
include(GoogleTest)

# clearloci_test(<name> sources... [LIBS libs...]): a GoogleTest executable, each of its tests known to ctest.
# Sources may use CLEARLOCI_SOURCE_DIR (the repository) and RapidCheck's <rapidcheck/gtest.h>.
function(clearloci_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBS")
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_compile_definitions(${name} PRIVATE CLEARLOCI_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_LIBS} GTest::gtest_main rapidcheck Threads::Threads)
  clearloci_warnings(${name})
  # A fixed seed: the same inputs from run to run. DISCOVERY_TIMEOUT: a loaded machine may start programs slowly.
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 120
    PROPERTIES ENVIRONMENT "RC_PARAMS=seed=20110501")
endfunction()
