# What a build can choose, and the flags every target of this project is compiled with.
option(CLEARLOCI_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(CLEARLOCI_BUILD_BENCHMARKS "Build the benchmarks" OFF)
set(CLEARLOCI_MPI "AUTO" CACHE STRING "Studies on several machines by MPI: ON, OFF, or AUTO where it is found")
set(CLEARLOCI_PYTHON "AUTO" CACHE STRING "Build the Python module: ON, OFF, or AUTO where pybind11 is found")
option(CLEARLOCI_WORKBENCH "Build `clearloci view` and `--export html`; wants Node.js and npm" ON)
option(CLEARLOCI_BROWSER_TESTS "Test the page of the workbench in Chromium, too, where that is found" ON)
option(CLEARLOCI_WARNINGS_AS_ERRORS "Treat warnings in this project's code as errors" OFF)
option(CLEARLOCI_UNITY "Compile the folders' sources eight at a time: quicker from nothing, slower after a change" OFF)
option(CLEARLOCI_FUZZ "Build the fuzzers alone, with what they throw bytes at; wants Clang" OFF)
set(CLEARLOCI_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# The system's Python, for which Debian packages NumPy and ezdxf; another one may stand before it in PATH.
if(EXISTS /usr/bin/python3 AND NOT DEFINED Python3_EXECUTABLE)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()

find_program(CLEARLOCI_CCACHE ccache)
if(CLEARLOCI_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without its sloppiness ccache keeps nothing that is compiled with a precompiled header. What one checkout compiled
  # serves the next one in another folder.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros"
    "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${CLEARLOCI_CCACHE}")
endif()

if(CLEARLOCI_SANITIZE)
  add_compile_options(-fsanitize=${CLEARLOCI_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=${CLEARLOCI_SANITIZE})
endif()

if(CLEARLOCI_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "CLEARLOCI_FUZZ wants Clang, whose libFuzzer it uses")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# clearloci_folder(<folder> [sources...]): the folder's static library clearloci_<folder>, alias clearloci::<folder>.
function(clearloci_folder folder)
  add_library(clearloci_${folder} STATIC ${ARGN})
  add_library(clearloci::${folder} ALIAS clearloci_${folder})
  set_target_properties(clearloci_${folder} PROPERTIES EXPORT_NAME ${folder})
  target_include_directories(clearloci_${folder} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:include>)
  target_compile_features(clearloci_${folder} PUBLIC cxx_std_20)
  clearloci_warnings(clearloci_${folder})
  set_target_properties(clearloci_${folder} PROPERTIES UNITY_BUILD ${CLEARLOCI_UNITY})
endfunction()

# clearloci_quickly_compiled(<target>): what waits for files, people and other libraries rather than for arithmetic of its
# own takes two thirds of the time to compile with fewer optimisations, and runs no slower that anybody would notice.
function(clearloci_quickly_compiled target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# clearloci_precompiled(<target> PRIVATE <headers...> | REUSE_FROM <target>): the third parties' headers that most sources
# of the target include.
function(clearloci_precompiled target)
  target_precompile_headers(${target} ${ARGN})
  # For ccache; and GCC 12 takes what is precompiled of the standard library for ours, and warns of its strings.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-array-bounds;-Wno-stringop-overflow>)
endfunction()

# clearloci_alone(<sources...>): sources of a folder that are compiled alone in any case, as they call something of
# their own by a name that another one of the folder uses for something of its own.
function(clearloci_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# -Wno-restrict: GCC 12 sees overlapping copies in every `"text" + std::string()` (its bug 105651, mended in 13).
function(clearloci_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
    $<$<BOOL:${CLEARLOCI_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# clearloci_known_leaks(<target>): an executable whose check for leaks knows those of other libraries.
function(clearloci_known_leaks target)
  if(CLEARLOCI_SANITIZE MATCHES "address")
    target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/cmake/known_leaks.cpp")
  endif()
endfunction()

# clearloci_program(<target>): an executable with an allocator for many small pieces, where mimalloc is found: every new
# design is tens of thousands of numbers and terms, and takes a fifth less time by it. Libraries leave that choice to the
# program that uses them, and the sanitizers bring their own.
if(NOT CLEARLOCI_SANITIZE)
  find_package(mimalloc QUIET)
endif()
function(clearloci_program target)
  clearloci_known_leaks(${target})
  if(TARGET mimalloc)
    target_link_options(${target} PRIVATE LINKER:--push-state,--no-as-needed $<TARGET_FILE:mimalloc> LINKER:--pop-state)
  endif()
endfunction()
