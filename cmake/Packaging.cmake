# Install rules and the CMake package: find_package(clearloci) brings the target clearloci::clearloci.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/clearloci")
set(rooms numbers sheet search curves points surfaces zones tasks)
list(TRANSFORM rooms PREPEND loci_)
set(folders core mechanism symbolic ${rooms} loci numeric check analysis studies report)
list(TRANSFORM folders PREPEND clearloci_ OUTPUT_VARIABLE folder_targets)

install(TARGETS ${folder_targets} clearloci_library EXPORT clearlociTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
install(TARGETS clearloci RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
# The module for MPI, where the program's run path leads to.
if(TARGET clearloci_mpi)
  set(modules "${CMAKE_INSTALL_LIBDIR}/clearloci")
  install(TARGETS clearloci_mpi LIBRARY DESTINATION "${modules}" COMPONENT program)
  file(RELATIVE_PATH to_modules "/${CMAKE_INSTALL_BINDIR}" "/${modules}")
  set_target_properties(clearloci PROPERTIES INSTALL_RPATH "$ORIGIN/${to_modules}")
endif()
# The public headers, and nothing else.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/clearloci" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT library)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
# Schemas of the mechanism file, for editors, and of what --json prints.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/" DESTINATION "${CMAKE_INSTALL_DATADIR}/clearloci" COMPONENT program)
# What the README refers to.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program
  PATTERN Doxyfile EXCLUDE PATTERN conf.py EXCLUDE PATTERN "*.rst" EXCLUDE PATTERN site.css EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

# The folder libraries are static, so whoever links them needs the third-party targets they name; the package finds
# them with the very file this build uses.
install(EXPORT clearlociTargets NAMESPACE clearloci:: DESTINATION "${package_folder}" COMPONENT library)
install(FILES "${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake" DESTINATION "${package_folder}" COMPONENT library)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/clearlociConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/clearlociConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/clearlociConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/clearlociConfig.cmake" "${PROJECT_BINARY_DIR}/clearlociConfigVersion.cmake"
  DESTINATION "${package_folder}" COMPONENT library)

# Debian packages by `cpack --config <build>/CPackConfig.cmake`: a package a component.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clearloci)
set(CPACK_PACKAGE_CONTACT "the clearloci maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET clearloci_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME clearloci)
# Loaded when the first picture is asked for (report/canvas.cpp), so that nothing linked tells of it.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libcairo2)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libclearloci-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
string(CONCAT CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libginac-dev, libcln-dev, libeigen3-dev, libcgal-dev, libgmp-dev, libmpfr-dev, libmpfi-dev, libflint-dev, libyaml-cpp-dev, libpugixml-dev, "
  "libnlopt-dev, libfmt-dev, nlohmann-json3-dev, libcairo2, libboost-dev, libtbb-dev, zlib1g-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-clearloci)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy, libcairo2")
include(CPack)
