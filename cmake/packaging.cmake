# Defines which files `cmake --install` installs, and the Debian packages that `cpack --preset package` makes of them.
# The component `video` is a separate package, barehand-video, because libav depends on a hundred packages that only
# users of videos need. The component `python` is the separate package python3-barehand, for machines without the
# tracker, too.
include(GNUInstallDirs)
set(data share/barehand)  # must agree with src/io/data_files.cpp, which searches relative to the program
barehand_more_instruction_sets()
install(DIRECTORY configs DESTINATION ${data} FILES_MATCHING PATTERN "*.yaml" PATTERN "*.json" PATTERN "*.onnx")
install(DIRECTORY web DESTINATION ${data})
install(DIRECTORY lcmtypes DESTINATION ${data} FILES_MATCHING PATTERN "*.lcm" PATTERN foreign EXCLUDE)
install(PROGRAMS deploy/fetch_hand_mesh.sh DESTINATION ${data}/deploy)
install(DIRECTORY deploy/batch DESTINATION ${data}/deploy USE_SOURCE_PERMISSIONS)
install(FILES deploy/udev/60-barehand-sensors.rules DESTINATION lib/udev/rules.d)
install(DIRECTORY deploy/systemd/ DESTINATION lib/systemd/system)
install(FILES deploy/OPERATIONS.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/deploy)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "*.jpg" PATTERN "*.svg"
                                                                          PATTERN "*.png" PATTERN "*.webp")
install(FILES deploy/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES deploy/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR}-video COMPONENT video)
set(python_docs ${CMAKE_INSTALL_DATAROOTDIR}/doc/python3-barehand)
install(FILES deploy/debian/copyright DESTINATION ${python_docs} COMPONENT python)

# Installs a file compressed by gzip, as Debian requires for man pages and changelogs.
find_program(GZIP gzip REQUIRED)
function(install_compressed file name destination)  # further arguments are passed to install()
  set(compressed ${PROJECT_BINARY_DIR}/packaging/${name}.gz)
  execute_process(COMMAND ${GZIP} -9nc ${PROJECT_SOURCE_DIR}/${file} OUTPUT_FILE ${compressed} COMMAND_ERROR_IS_FATAL ANY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  install(FILES ${compressed} DESTINATION ${destination} ${ARGN})
endfunction()
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/packaging)
install_compressed(deploy/debian/changelog changelog ${CMAKE_INSTALL_DOCDIR})
install_compressed(deploy/debian/changelog changelog ${CMAKE_INSTALL_DOCDIR}-video COMPONENT video)
install_compressed(deploy/debian/changelog changelog ${python_docs} COMPONENT python)
install_compressed(deploy/debian/barehand.1 barehand.1 ${CMAKE_INSTALL_MANDIR}/man1)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Barehand maintainers <maintainers@barehand.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # adds the versions of the libraries that the program was linked with
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_NAME} built using CMake")  # CPack omits this default text
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME barehand)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_DEPENDS "libjs-three")  # for the live page; SHLIBDEPS adds the libraries
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SUGGESTS
    "barehand-video, liblcm-bin, libegl1, npm, parallel, python3-barehand")  # scripts in deploy/ use npm and parallel
set(CPACK_DEBIAN_UNSPECIFIED_DESCRIPTION "tracks a bare hand and publishes glove-like states on LCM
Barehand is a daemon beside a depth sensor. It watches a bare hand that holds
and moves things and says on LCM, frame by frame, what an instrumented glove
would say: where the palm and the phalanges are, how every joint is bent, what
is seen and what is inferred, and how sure it is.")
set(CPACK_DEBIAN_VIDEO_PACKAGE_NAME barehand-video)
set(CPACK_DEBIAN_VIDEO_PACKAGE_DEPENDS "barehand (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_VIDEO_DESCRIPTION "lets barehand write videos of tracked hands
This module writes what `barehand track --overlay` draws to videos, through
FFmpeg's libraries. Without it barehand writes single pictures.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-barehand)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/deploy/debian/python3-barehand/postinst;${PROJECT_SOURCE_DIR}/deploy/debian/python3-barehand/prerm")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "hands tracked by barehand, in Python
This module reads hand states from LCM, live and from logs, and hands them out
in the conventions of OpenXR, WebXR, MANO and instrumented gloves. It sends the
images of depth cameras to barehand. It needs neither barehand nor LCM here.")
if(BAREHAND_ARCH MATCHES "^x86-64-v")
  string(APPEND CPACK_DEBIAN_UNSPECIFIED_DESCRIPTION "\n.\nThis build needs an ${BAREHAND_ARCH} processor or better.")
endif()
include(CPack)

option(BAREHAND_PACKAGE_TEST "Test the package in a fresh Debian tree: as root, with a Debian mirror, minutes long" OFF)
if(BAREHAND_PACKAGE_TEST)
  enable_testing()
  add_test(NAME package.CleanInstall
           COMMAND sh -c "exec ${PROJECT_SOURCE_DIR}/tests/package/clean_install.sh ${PROJECT_BINARY_DIR}/barehand_*.deb")
  set_tests_properties(package.CleanInstall PROPERTIES TIMEOUT 1200)
endif()
