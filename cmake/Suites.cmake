# clearloci_suites(<name> <program> <environment> <cost>): each suite of a GoogleTest program as a test <name>.<suite>. Read by
# ctest before it runs, not by the configuration: the program tells its suites. The tests of a suite share a process, and
# with it what its fixture computes once.
function(clearloci_suites name program environment cost)
  set(listed)
  if(EXISTS "${program}")
    execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
    if(failed)
      set(listed)
    endif()
  endif()
  # A suite stands at the beginning of its line: "Case/Suite.", perhaps with a comment; its tests are indented.
  string(REGEX MATCHALL "(^|\n)[^ \n#]+\\." suites "${listed}")
  if(NOT suites)
    add_test("${name}.NOT_BUILT" "${program}")  # which fails
  endif()
  foreach(suite IN LISTS suites)
    string(REGEX REPLACE "[\n.]" "" suite "${suite}")
    add_test("${name}.${suite}" "${program}" "--gtest_filter=${suite}.*")
    set_tests_properties("${name}.${suite}" PROPERTIES ENVIRONMENT "${environment}" COST "${cost}")
  endforeach()
endfunction()
