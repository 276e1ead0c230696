# GoogleTest and RapidCheck for every folder's tests.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)

# Laws over random inputs try as many as each says (hundreds of small ones, a dozen designs). A build that is many times
# slower, such as that of the preset asan, takes a smaller share of them, but leaves no law out.
set(CLEARLOCI_LAW_INPUTS "" CACHE STRING "How many random inputs a law tries; empty: as many as it says itself")
set(law_inputs "RC_PARAMS=seed=20110501")  # a fixed seed: the same inputs from run to run
if(CLEARLOCI_LAW_INPUTS)
  set(law_inputs "RC_PARAMS=seed=20110501 max_success=${CLEARLOCI_LAW_INPUTS} max_discard_ratio=100"
    "CLEARLOCI_DESIGNS=${CLEARLOCI_LAW_INPUTS}")
endif()

set(CLEARLOCI_TEST_COST 0)
# clearloci_test(<name> sources... [LIBS libs...]): a GoogleTest executable, each of its suites known to ctest. Suites of
# a directory with a larger CLEARLOCI_TEST_COST start earlier: the long ones, so that no processor waits for them at the
# end. Sources may use "tests/source_dir.hpp" (the repository) and RapidCheck's <rapidcheck/gtest.h>.
function(clearloci_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBS")
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_LIBS} test_source_dir GTest::gtest_main GTest::gmock rapidcheck Threads::Threads)
  clearloci_warnings(${name})
  clearloci_program(${name})
  # What is tested is compiled as users get it; the tests themselves compile a third faster so.
  clearloci_quickly_compiled(${name})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${CLEARLOCI_UNITY})
  # The headers that nearly every test includes are precompiled by the first and taken over by all others.
  get_property(first GLOBAL PROPERTY clearloci_first_test)
  if(first)
    clearloci_precompiled(${name} REUSE_FROM ${first})
  else()
    clearloci_precompiled(${name} PRIVATE <gtest/gtest.h> <algorithm> <array> <cmath> <fstream> <functional> <map> <optional> <random> <sstream>)
    set_property(GLOBAL PROPERTY clearloci_first_test ${name})
  endif()
  set(suites "${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake")
  file(GENERATE OUTPUT "${suites}" CONTENT "include([[${PROJECT_SOURCE_DIR}/cmake/Suites.cmake]])
clearloci_suites([[${name}]] [[$<TARGET_FILE:${name}>]] [[${law_inputs}]] ${CLEARLOCI_TEST_COST})
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${suites}")
endfunction()
