# SPDX-License-Identifier: Apache-2.0
include(${CMAKE_CURRENT_LIST_DIR}/armatureTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/ArmatureComponentLibrary.cmake)
cmake_path(SET ARMATURE_COMPONENT_FOLDER NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../../armature)
include(${CMAKE_CURRENT_LIST_DIR}/ArmatureIdl.cmake)
