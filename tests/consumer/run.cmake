# Runs a command; its output is in `output`.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${status}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Builds the outside project against what is installed under a prefix, and runs the README's program. More arguments:
# targets, if not all.
function(outside_project prefix)
  set(flags "")
  if(SANITIZE)
    set(flags "-fsanitize=${SANITIZE}")
    set(ENV{ASAN_OPTIONS} detect_leaks=0)  # those of other libraries that cmake/known_leaks.cpp knows are not told here
  endif()
  run("${PYTHON}" "${PROGRAMS}" "${README}" "${prefix}/include/clearloci" "${WORK}/programs")
  run("${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${SOURCE}" -B "${WORK}/build" -D "PROGRAMS=${WORK}/programs"
    -D "CMAKE_PREFIX_PATH=${prefix}" -D "CMAKE_CXX_COMPILER=${COMPILER}"
    -D "CMAKE_BUILD_TYPE=${BUILD_TYPE}" -D "CMAKE_CXX_FLAGS=${flags}")
  set(targets "")
  if(ARGN)
    set(targets --target ${ARGN})
  endif()
  run("${CMAKE_COMMAND}" --build "${WORK}/build" ${targets})
  file(COPY_FILE "${MODEL}" "${WORK}/build/engraver.yaml")
  run("${CMAKE_COMMAND}" -E chdir "${WORK}/build" ./loci_of)
  if(NOT output MATCHES "c1: .+ = 0\n")
    message(FATAL_ERROR "the outside program printed:\n${output}")
  endif()
endfunction()
