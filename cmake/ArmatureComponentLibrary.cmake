# SPDX-License-Identifier: Apache-2.0
# Part of the installed package: the same function inside this tree and after find_package(armature).

set(ARMATURE_COMPONENT_LIBRARY_EXPORTS ${CMAKE_CURRENT_LIST_DIR}/component_library.map)

# armature_component_library(NAME motion SOURCES pid.cpp axes_generator.cpp LINK ...)
#
# A library of components that the deployment loads: lib/armature/lib<NAME>.so. It exports
# nothing of its own but its one extern "C" function, and shares the runtime with its host.
function(armature_component_library)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;LINK")
  if(NOT arg_NAME OR NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "armature_component_library(NAME <name> SOURCES <files> [LINK <targets>]) "
                        "was called with: ${ARGV}")
  endif()
  add_library(${arg_NAME} MODULE ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE armature::component ${arg_LINK})
  target_compile_options(${arg_NAME} PRIVATE -ffp-contract=off)
  # Templates of the standard library run from here, also if another library has them too.
  target_link_options(${arg_NAME} PRIVATE LINKER:-Bsymbolic-functions
                                          LINKER:--version-script=${ARMATURE_COMPONENT_LIBRARY_EXPORTS})
  set_target_properties(
    ${arg_NAME}
    PROPERTIES PREFIX lib
               SUFFIX .so
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/armature)
  if(COMMAND armature_warnings)
    armature_warnings(${arg_NAME})
    armature_unity(${arg_NAME})
  endif()
endfunction()
