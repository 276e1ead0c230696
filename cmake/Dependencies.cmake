# Third-party libraries that the folder libraries link, as imported targets; the build and the installed package both
# find them here. script/bootstrap installs the Debian packages they come from.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(gmpxx REQUIRED QUIET IMPORTED_TARGET gmpxx)
pkg_check_modules(mpfr REQUIRED QUIET IMPORTED_TARGET mpfr)
pkg_check_modules(ginac REQUIRED QUIET IMPORTED_TARGET ginac)
pkg_check_modules(cln REQUIRED QUIET IMPORTED_TARGET cln)
pkg_check_modules(yaml-cpp REQUIRED QUIET IMPORTED_TARGET yaml-cpp)
pkg_check_modules(pugixml REQUIRED QUIET IMPORTED_TARGET pugixml)
find_package(Eigen3 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)

# clearloci_plain_library(<name> <header> [libs...]): of a library whose package does not say where its header is.
function(clearloci_plain_library name header)
  if(TARGET ${name})
    return()
  endif()
  string(TOUPPER ${name} upper)
  find_path(${upper}_INCLUDE_DIR ${header} REQUIRED)
  find_library(${upper}_LIBRARY ${name} REQUIRED)
  add_library(${name} INTERFACE IMPORTED)
  target_include_directories(${name} SYSTEM INTERFACE "${${upper}_INCLUDE_DIR}")
  target_link_libraries(${name} INTERFACE "${${upper}_LIBRARY}" ${ARGN})
endfunction()

clearloci_plain_library(flint flint/fmpz_mpoly_factor.h PkgConfig::mpfr)
clearloci_plain_library(nlopt nlopt.h)
clearloci_plain_library(mpfi mpfi.h PkgConfig::mpfr)

# CGAL is header-only; its CMake package sets flags we do not want, so only the headers are used.
if(NOT TARGET cgal)
  find_path(CGAL_INCLUDE_DIR CGAL/Arr_algebraic_segment_traits_2.h REQUIRED)
  find_path(BOOST_INCLUDE_DIR boost/version.hpp REQUIRED)
  add_library(cgal INTERFACE IMPORTED)
  target_include_directories(cgal SYSTEM INTERFACE "${CGAL_INCLUDE_DIR}" "${BOOST_INCLUDE_DIR}")
  target_compile_definitions(cgal INTERFACE CGAL_USE_CORE=1 CGAL_USE_GMP=1 CGAL_USE_MPFR=1 CGAL_NDEBUG=1)
  target_link_libraries(cgal INTERFACE PkgConfig::mpfr PkgConfig::gmpxx)
endif()

# Executables with the property CLEARLOCI_ARCHIVES link these from archives, where there are any: a process then waits for
# five libraries less. Modules and other executables, whose size counts more, share them.
foreach(target IN ITEMS PkgConfig::ginac PkgConfig::cln PkgConfig::yaml-cpp PkgConfig::pugixml mpfi)
  get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
  foreach(shared IN LISTS libraries)
    string(REGEX REPLACE "\\.so$" ".a" archive "${shared}")
    if(NOT archive STREQUAL shared AND EXISTS "${archive}")
      list(TRANSFORM libraries REPLACE "^${shared}$"
        "$<IF:$<BOOL:$<TARGET_PROPERTY:CLEARLOCI_ARCHIVES>>,${archive},${shared}>")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES INTERFACE_LINK_LIBRARIES "${libraries}")
endforeach()
