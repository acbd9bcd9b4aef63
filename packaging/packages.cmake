# SPDX-License-Identifier: Apache-2.0
# Debian packages, by `scripts/package`: armature (programs, libraries, component libraries, the studio), armature-dev (what
# components are built with), armature-robots (Janus, WAM, rover), armature-ros2 where Cyclone DDS is installed,
# python3-armature where pybind11 is. Each install rule names its package as COMPONENT; what names none is of the default of its folder.
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(packages armature dev robots)
if(TARGET ros2)
  list(APPEND packages ros2)
endif()
if(TARGET armature_python)
  list(APPEND packages python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME armature)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "component-based real-time control of robots")
set(CPACK_PACKAGE_CONTACT "The authors of Armature <authors@armature.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
# What debuggers want goes to packages of its own, -dbgsym; CPack strips what it has taken it from.
set(CPACK_DEBIAN_DEBUGINFO_PACKAGE ON)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
                                                GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_ARMATURE_PACKAGE_NAME armature)
set(CPACK_DEBIAN_ARMATURE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ARMATURE_PACKAGE_CONTROL_EXTRA ${packaging}/triggers)
set(CPACK_DEBIAN_ARMATURE_DESCRIPTION
    "A robot, its hardware, controllers and schedule are described in one file,
which is checked, run in hard real time or in simulated time, and watched.

This package has the program armature with its studio, the interface
compiler rcidl, their libraries, and the components of a robot's controller.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME armature-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, g++, cmake")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libgtest-dev, libgmock-dev, ninja-build")
set(CPACK_COMPONENT_DEV_DEPENDS armature)
set(CPACK_DEBIAN_DEV_DESCRIPTION
    "With the headers and CMake functions of this package, components of one's
own, drivers and programs that talk to applications are built for Armature.")

set(CPACK_DEBIAN_ROBOTS_PACKAGE_NAME armature-robots)
set(CPACK_DEBIAN_ROBOTS_PACKAGE_SECTION science)
set(CPACK_COMPONENT_ROBOTS_DEPENDS armature)
set(CPACK_DEBIAN_ROBOTS_DESCRIPTION
    "This package has robots to begin with: the two-joint head Janus, the Barrett
WAM and a rover that follows a ball, each with drivers, deployments, scripts
and a simulation, so that it runs on any machine.")

set(CPACK_DEBIAN_ROS2_PACKAGE_NAME armature-ros2)
set(CPACK_DEBIAN_ROS2_PACKAGE_SECTION science)
set(CPACK_COMPONENT_ROS2_DEPENDS armature)
set(CPACK_DEBIAN_ROS2_DESCRIPTION
    "With this package an application is a node of ROS 2: its joints, transforms,
images, diagnostics and ports are topics, and topics command its motions. It
needs no ROS: its component library speaks DDS by Eclipse Cyclone DDS.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-armature)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# The module is for one version of Python.
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11~), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "armature-robots, python3-cloudpickle")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-scipy, python3-distributed, jupyter-notebook")
set(CPACK_COMPONENT_PYTHON_DEPENDS armature)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${packaging}/python/postinst ${packaging}/python/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
    "With this package Python checks deployments, runs them in simulated time,
reads recordings as numpy arrays, connects to running applications, and has
components of its own in simulations.")

# What Debian wants of every package: its licence, its changes, and why it differs from the rules.
find_program(ARMATURE_GZIP gzip REQUIRED)
string(TIMESTAMP packaged "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${packaging}/changelog.in ${PROJECT_BINARY_DIR}/packaging/changelog @ONLY)
add_custom_command(
  OUTPUT packaging/changelog.gz
  COMMAND ${ARMATURE_GZIP} -9nkf packaging/changelog
  DEPENDS packaging/changelog)
add_custom_target(package_files ALL DEPENDS packaging/changelog.gz)
foreach(component IN LISTS packages)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${packaging}/copyright ${PROJECT_BINARY_DIR}/packaging/changelog.gz
          DESTINATION share/doc/${name} COMPONENT ${component})
  if(EXISTS ${packaging}/${name}.overrides)
    install(FILES ${packaging}/${name}.overrides DESTINATION share/lintian/overrides RENAME ${name}
            COMPONENT ${component})
  endif()
endforeach()

# Pages of the manual, from what the programs say of themselves.
find_program(ARMATURE_HELP2MAN help2man)
if(ARMATURE_HELP2MAN)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(manual ${PROJECT_BINARY_DIR}/packaging/manual)
  add_custom_command(
    OUTPUT ${manual}/made
    COMMAND ${Python3_EXECUTABLE} ${packaging}/manual.py ${manual} armature=$<TARGET_FILE:armature>
            armature=$<TARGET_FILE:rcidl> armature=$<TARGET_FILE:armature-cia402-emulator>
            robots=$<TARGET_FILE:armature-janus-plant> robots=$<TARGET_FILE:armature-wam-emulator>
    COMMAND ${ARMATURE_GZIP} -9nc ${packaging}/armature-guardian.1 > ${manual}/armature-guardian.1.gz
    COMMAND ${CMAKE_COMMAND} -E touch ${manual}/made
    DEPENDS ${packaging}/armature-guardian.1 ${packaging}/manual.py armature rcidl armature-cia402-emulator armature-janus-plant armature-wam-emulator
    VERBATIM)
  add_custom_target(manual ALL DEPENDS ${manual}/made)
  foreach(component IN ITEMS armature robots)
    install(DIRECTORY ${manual}/${component}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
  endforeach()
  install(FILES ${manual}/armature-guardian.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT armature)
endif()

# The service and completion are of the program: CMAKE_INSTALL_DEFAULT_COMPONENT_NAME is `dev` by now (ArmatureInstall).
install(FILES ${packaging}/armature@.service DESTINATION lib/systemd/system COMPONENT armature)
install(FILES ${packaging}/completion/armature.bash DESTINATION share/bash-completion/completions RENAME armature COMPONENT armature)
install(FILES ${packaging}/completion/_armature DESTINATION share/zsh/vendor-completions COMPONENT armature)
install(FILES ${packaging}/completion/armature.fish DESTINATION share/fish/vendor_completions.d COMPONENT armature)

include(CPack)
