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

# FLINT 2.9 ships neither a CMake package nor a pkg-config file.
if(NOT TARGET flint)
  find_path(FLINT_INCLUDE_DIR flint/fmpz_mpoly_factor.h REQUIRED)
  find_library(FLINT_LIBRARY flint REQUIRED)
  add_library(flint INTERFACE IMPORTED)
  target_include_directories(flint SYSTEM INTERFACE "${FLINT_INCLUDE_DIR}")
  target_link_libraries(flint INTERFACE "${FLINT_LIBRARY}" PkgConfig::mpfr)
endif()

# NLopt's CMake package names its library without saying where the header is.
if(NOT TARGET nlopt)
  find_path(NLOPT_INCLUDE_DIR nlopt.h REQUIRED)
  find_library(NLOPT_LIBRARY nlopt REQUIRED)
  add_library(nlopt INTERFACE IMPORTED)
  target_include_directories(nlopt SYSTEM INTERFACE "${NLOPT_INCLUDE_DIR}")
  target_link_libraries(nlopt INTERFACE "${NLOPT_LIBRARY}")
endif()

# MPFI ships neither.
if(NOT TARGET mpfi)
  find_path(MPFI_INCLUDE_DIR mpfi.h REQUIRED)
  find_library(MPFI_LIBRARY mpfi REQUIRED)
  add_library(mpfi INTERFACE IMPORTED)
  target_include_directories(mpfi SYSTEM INTERFACE "${MPFI_INCLUDE_DIR}")
  target_link_libraries(mpfi INTERFACE "${MPFI_LIBRARY}" PkgConfig::mpfr)
endif()

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
