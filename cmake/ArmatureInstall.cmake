# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` gives beyond the libraries and the program: headers, and what
# find_package(armature) needs. armature::armature is all libraries at once.
include(CMakePackageConfigHelpers)
# All of it is for building: the package armature-dev.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/armature)

get_property(libraries GLOBAL PROPERTY ARMATURE_LIBRARIES)
add_library(armature_all INTERFACE)
add_library(armature::armature ALIAS armature_all)
target_link_libraries(armature_all INTERFACE ${libraries})
set_target_properties(armature_all PROPERTIES EXPORT_NAME armature)
install(TARGETS armature_all EXPORT armature)

install(EXPORT armature NAMESPACE armature:: FILE armatureTargets.cmake DESTINATION ${package_dir})
install(DIRECTORY armature DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING
        PATTERN "*.hpp"
        REGEX "armature/(guard|testing/model)$" EXCLUDE
        PATTERN "test_*" EXCLUDE)

install(FILES LICENSE DESTINATION share/doc/armature COMPONENT armature)

write_basic_package_version_file(armatureConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/armatureConfig.cmake cmake/ArmatureComponentLibrary.cmake
              cmake/component_library.map cmake/ArmatureIdl.cmake
              ${PROJECT_BINARY_DIR}/armatureConfigVersion.cmake
        DESTINATION ${package_dir})
