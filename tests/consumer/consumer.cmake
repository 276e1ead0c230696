# Installs the package into a folder of its own, builds the outside project against it and runs it.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
outside_project("${WORK}/prefix")
run("${WORK}/prefix/bin/clearloci" --version)
message(STATUS "${output}")
