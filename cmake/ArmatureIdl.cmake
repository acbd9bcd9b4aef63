# SPDX-License-Identifier: Apache-2.0
# Part of the installed package: the same function inside this tree and after find_package(armature).

# armature_idl(NAME chassis IDL chassis.idl [NAMESPACE robot] [JSON] [TYPESCRIPT] [LINK geometry])
#
# A static library of what rcidl generates from interface definitions: for each X.idl the headers
# X_types.hpp, X_client.hpp and X_service.hpp, found by whoever links the library.
#   NAMESPACE  of all of them; otherwise each file's name
#   JSON       writes X.json, too, beside the headers
#   TYPESCRIPT writes X.ts and X_service.ts, too: placeholders and services for pages and Node.js
#   LINK       libraries of this function whose files are imported
# Generated anew when a file or one that it imports has changed. The target's property IDL_FOLDER
# says where.
function(armature_idl)
  cmake_parse_arguments(PARSE_ARGV 0 arg "JSON;TYPESCRIPT" "NAME;NAMESPACE" "IDL;LINK")
  if(NOT arg_NAME OR NOT arg_IDL OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "armature_idl(NAME <name> IDL <files> [NAMESPACE <namespace>] [JSON] "
                        "[TYPESCRIPT] [LINK <targets>]) was called with: ${ARGV}")
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${arg_NAME}_idl)
  set(options)
  if(arg_NAMESPACE)
    list(APPEND options --namespace ${arg_NAMESPACE})
  endif()
  if(arg_JSON)
    list(APPEND options --json)
  endif()
  if(arg_TYPESCRIPT)
    list(APPEND options --typescript)
  endif()

  set(sources)
  foreach(idl IN LISTS arg_IDL)
    cmake_path(ABSOLUTE_PATH idl BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    cmake_path(GET idl STEM LAST_ONLY stem)
    set(generated ${stem}_types.hpp ${stem}_client.hpp ${stem}_client.cpp ${stem}_service.hpp
                  ${stem}_service.cpp)
    if(arg_JSON)
      list(APPEND generated ${stem}.json)
    endif()
    if(arg_TYPESCRIPT)
      list(APPEND generated ${stem}.ts ${stem}_service.ts)
    endif()
    list(TRANSFORM generated PREPEND ${folder}/)
    add_custom_command(
      OUTPUT ${generated}
      COMMAND armature::rcidl ${idl} --out ${folder} --depends
              ${folder}/${stem}.d ${options}
      DEPENDS ${idl} $<TARGET_FILE:armature::rcidl>
      DEPFILE ${folder}/${stem}.d
      COMMENT "Generating C++ from ${stem}.idl"
      VERBATIM)
    list(APPEND sources ${generated})
  endforeach()

  add_library(${arg_NAME} STATIC ${sources})
  target_link_libraries(${arg_NAME} PUBLIC armature::ride armature::types ${arg_LINK})
  target_include_directories(${arg_NAME} PUBLIC ${folder})
  # A component library that uses it exports nothing of its own.
  set_target_properties(
    ${arg_NAME}
    PROPERTIES POSITION_INDEPENDENT_CODE ON
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               IDL_FOLDER ${folder})
  if(COMMAND armature_warnings)
    armature_warnings(${arg_NAME})
  endif()
endfunction()
