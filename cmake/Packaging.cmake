# Install rules and the CMake package: find_package(clearloci) brings the target clearloci::clearloci.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/clearloci")
set(folders core mechanism symbolic loci numeric check analysis report)
list(TRANSFORM folders PREPEND clearloci_ OUTPUT_VARIABLE folder_targets)

install(TARGETS ${folder_targets} clearloci_library EXPORT clearlociTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(TARGETS clearloci RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
# The public headers, and nothing else.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/clearloci" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}" OPTIONAL)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# The folder libraries are static, so whoever links them needs the third-party targets they name; the package finds
# them with the very file this build uses.
install(EXPORT clearlociTargets NAMESPACE clearloci:: DESTINATION "${package_folder}")
install(FILES "${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake" DESTINATION "${package_folder}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/clearlociConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/clearlociConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/clearlociConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/clearlociConfig.cmake" "${PROJECT_BINARY_DIR}/clearlociConfigVersion.cmake"
  DESTINATION "${package_folder}")
