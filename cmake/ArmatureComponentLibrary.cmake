# SPDX-License-Identifier: Apache-2.0
# Part of the installed package: the same function inside this tree and after find_package(armature).

set(ARMATURE_COMPONENT_LIBRARY_EXPORTS ${CMAKE_CURRENT_LIST_DIR}/component_library.map)

# armature_component_library(NAME motion SOURCES pid.cpp axes_generator.cpp LINK ...)
#
# A library of components that the deployment loads: lib/armature/lib<NAME>.so. It exports
# nothing of its own but its one extern "C" function, by two names, and shares the runtime with its host.
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
  # By this name a program that is linked with several libraries finds each of them.
  string(MAKE_C_IDENTIFIER ${arg_NAME} identifier)
  target_link_options(${arg_NAME} PRIVATE
                      LINKER:--defsym=armature_component_library_${identifier}=armature_component_library)
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

# armature_link_components(wave LIBRARIES wave controls)
#
# Links a program, as `armature generate` writes it, with component libraries. They are looked for in the
# folders of the variable ARMATURE_LIBRARY_PATH, then among those that are installed with Armature.
function(armature_link_components target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES")
  foreach(library IN LISTS arg_LIBRARIES)
    find_library(
      ARMATURE_COMPONENTS_${library}
      NAMES lib${library}.so
      PATHS ${ARMATURE_LIBRARY_PATH} ${ARMATURE_COMPONENT_FOLDER}
      NO_DEFAULT_PATH)
    if(NOT ARMATURE_COMPONENTS_${library})
      message(FATAL_ERROR "component library '${library}' was not found: no lib${library}.so in "
                          "'${ARMATURE_LIBRARY_PATH}' and '${ARMATURE_COMPONENT_FOLDER}'; "
                          "name its folder by -DARMATURE_LIBRARY_PATH=FOLDER")
    endif()
    target_link_libraries(${target} PRIVATE ${ARMATURE_COMPONENTS_${library}})
  endforeach()
endfunction()
