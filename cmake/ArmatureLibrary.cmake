# SPDX-License-Identifier: Apache-2.0
# armature_library() for the folders of armature/, armature_static_library() for those beside them,
# and armature_test() for everything else.
include(${CMAKE_CURRENT_LIST_DIR}/layers.cmake)

if(CMAKE_CROSSCOMPILING)
  # Its package has the libraries for this machine, and the sources.
  set(INSTALL_GTEST OFF)
  add_subdirectory(/usr/src/googletest ${PROJECT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
else()
  find_package(GTest REQUIRED)
endif()

if(ARMATURE_FUZZ)
  add_custom_target(fuzz_targets)
endif()

function(armature_test_options target)
  # What is tested, not the test, needs the speed, and tests are compiled far more often than a
  # debugger sees them: this takes half off.
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O0;-g1>)
endfunction()

# What nearly every test includes is read once, which halves what clang takes for a test; GCC gains
# little. A precompiled header knows its source by the whole path, and ccache hands it to other
# checkouts: so the source is one of the system's, not of this tree, which rules out
# target_precompile_headers(), too.
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  find_path(ARMATURE_GMOCK_FOLDER gmock/gmock.h REQUIRED)
  set(gmock ${ARMATURE_GMOCK_FOLDER}/gmock/gmock.h)
  set_source_files_properties(${gmock} PROPERTIES LANGUAGE CXX)
  add_library(armature_test_headers OBJECT ${gmock})
  set(ARMATURE_TEST_HEADERS CMakeFiles/armature_test_headers.dir${gmock}.o)
  target_link_libraries(armature_test_headers PRIVATE GTest::gmock)
  armature_test_options(armature_test_headers)
  set_target_properties(armature_test_headers PROPERTIES POSITION_INDEPENDENT_CODE OFF LINKER_LANGUAGE CXX)
  target_compile_options(
    armature_test_headers PRIVATE -fPIE "SHELL:-x c++-header" -fpch-instantiate-templates
                                  "SHELL:-Xclang -emit-pch" "SHELL:-Xclang -fno-pch-timestamp")
  foreach(header IN ITEMS algorithm array atomic chrono cmath filesystem fstream functional limits map
                          memory optional random string string_view thread utility variant vector)
    target_compile_options(armature_test_headers PRIVATE "SHELL:-include ${header}")
  endforeach()
endif()

# Stops the configuration if `library` declares a use that layers.cmake does not allow.
function(armature_check_uses library)
  set(layers ${ARMATURE_LAYERS})
  list(FILTER layers INCLUDE REGEX "^${library}:")
  if(NOT layers)
    message(FATAL_ERROR "${library} is not in cmake/layers.cmake: add it there")
  endif()
  string(REGEX MATCHALL "[a-z0-9_]+" allowed "${layers}")
  list(REMOVE_AT allowed 0)
  foreach(used IN LISTS ARGN)
    if(NOT used IN_LIST allowed)
      list(JOIN allowed ", " allowed_text)
      message(FATAL_ERROR "armature/${library} may not use ${used}; it may use: ${allowed_text} "
                          "(cmake/layers.cmake)")
    endif()
  endforeach()
endfunction()

# armature_library(NAME rt USES platform LINK fmt::fmt SOURCES log.cpp TESTS log_test.cpp ...)
#
# The library of one folder: libarmature_rt.so, target armature::rt; header-only without SOURCES.
#   USES       other libraries of armature/, passed on to whoever uses this one
#   LINK       third-party targets; private, because public headers do not include theirs
#   TESTS      each file becomes the executable and test <NAME>_<file>
#   TEST_USES, TEST_LINK   what the tests need beyond that
#
# Shared, so that a process has one copy of each registry and thread-local variable no matter how
# many component libraries it loads, and so that a test builds only what lies below it.
function(armature_library)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "USES;LINK;SOURCES;TESTS;TEST_USES;TEST_LINK")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "armature_library(${arg_NAME}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  armature_check_uses(${arg_NAME} ${arg_USES})
  set(target armature_${arg_NAME})
  list(TRANSFORM arg_USES PREPEND armature::)

  if(arg_SOURCES)
    add_library(${target} SHARED ${arg_SOURCES})
    set(public PUBLIC)
    target_link_libraries(${target} PRIVATE ${arg_LINK})
    armature_warnings(${target})
    armature_unity(${target})
    armature_runtime_options(${target})
  else()
    add_library(${target} INTERFACE)
    set(public INTERFACE)
  endif()
  add_library(armature::${arg_NAME} ALIAS ${target})
  target_link_libraries(${target} ${public} ${arg_USES} ${ARMATURE_ATOMICS})
  target_compile_features(${target} ${public} cxx_std_20)
  target_include_directories(
    ${target} ${public} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  armature_install_library(${arg_NAME})

  foreach(test IN LISTS arg_TESTS)
    cmake_path(GET test STEM stem)
    armature_test(NAME ${arg_NAME}_${stem} SOURCES ${test} USES ${arg_NAME} ${arg_TEST_USES}
                  LINK ${arg_LINK} ${arg_TEST_LINK})
  endforeach()
endfunction()

# armature_static_library(NAME janus LAYER robots USES sim can LINK ... SOURCES ... TESTS ...)
#
# A library beside those of armature/: target armature::janus, static and not installed.
#   LAYER            its line in cmake/layers.cmake
#   USES             libraries of armature/, as far as that allows
#   LINK             third-party targets; private
#   TESTS            each file becomes the executable and test <NAME>_<file>
#   TEST_USES        what the tests need beyond that
#   TEST_PATHS       names and paths, as for armature_test_paths()
function(armature_static_library)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;LAYER"
                        "USES;LINK;SOURCES;TESTS;TEST_USES;TEST_PATHS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "armature_static_library(${arg_NAME}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  armature_check_uses(${arg_LAYER} ${arg_USES})
  set(target armature_${arg_NAME})
  list(TRANSFORM arg_USES PREPEND armature::)
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(armature::${arg_NAME} ALIAS ${target})
  target_link_libraries(${target} PUBLIC ${arg_USES} PRIVATE ${arg_LINK})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  armature_warnings(${target})
  armature_unity(${target})
  foreach(test IN LISTS arg_TESTS)
    cmake_path(GET test STEM stem)
    armature_test(NAME ${arg_NAME}_${stem} SOURCES ${test} USES ${arg_NAME} ${arg_TEST_USES})
    armature_test_paths(${arg_NAME}_${stem} ${arg_TEST_PATHS})
  endforeach()
endfunction()

# armature_robot(NAME janus USES sim can SOURCES ... TESTS ... TEST_USES ...)
#
# What one robot is made of beside its components: drivers, firmware, plant; static, since the
# robot's component library and its tests are all that use it.
function(armature_robot)
  armature_static_library(LAYER robots ${ARGV}
                          TEST_PATHS ROBOT_FOLDER ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()

# Calls inside the library and accesses to its thread-local variables cost no detour.
function(armature_runtime_options target)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION 0.1)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition -ftls-model=initial-exec)
  target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
  if(NOT ARMATURE_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,-z,defs)  # an undeclared use does not link
  endif()
endfunction()

# Everything goes into the package; guard and testing are for tests and for watching, so they are
# no part of armature::armature.
function(armature_install_library name)
  set_target_properties(armature_${name} PROPERTIES EXPORT_NAME ${name})
  # Without a version, links and archives are what others are linked with.
  install(TARGETS armature_${name} EXPORT armature
          LIBRARY NAMELINK_COMPONENT dev
          ARCHIVE COMPONENT dev)
  if(NOT name MATCHES "^(guard|testing)$")
    set_property(GLOBAL APPEND PROPERTY ARMATURE_LIBRARIES armature::${name})
  endif()
endfunction()

# armature_program(NAME armature SOURCES main.cpp USES cli LINK CLI11::CLI11)
#
# An executable that is installed into bin/; the package knows it as armature::program, or by the
# name in EXPORT.
function(armature_program)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;EXPORT" "SOURCES;USES;LINK")
  if(NOT arg_EXPORT)
    set(arg_EXPORT program)
  endif()
  list(TRANSFORM arg_USES PREPEND armature::)
  add_executable(${arg_NAME} ${arg_SOURCES})
  add_executable(armature::${arg_EXPORT} ALIAS ${arg_NAME})
  target_link_libraries(${arg_NAME} PRIVATE ${arg_USES} ${arg_LINK})
  armature_warnings(${arg_NAME})
  armature_unity(${arg_NAME})
  set_target_properties(${arg_NAME} PROPERTIES EXPORT_NAME ${arg_EXPORT})
  install(TARGETS ${arg_NAME} EXPORT armature)
endfunction()

# armature_test(NAME stop_order SOURCES stop_order_test.cpp USES exec testing LINK ...)
#
# A GoogleTest executable and the test of that name. A test that would take minutes under a
# sanitizer gets the label `slow`: set_tests_properties(<name> PROPERTIES LABELS slow).
function(armature_test)
  armature_test_program(${ARGV})
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "")
  add_test(NAME ${arg_NAME} COMMAND ${arg_NAME} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  if(NOT arg_NAME MATCHES "${ARMATURE_TESTS}")
    armature_leave_out(${arg_NAME})
  endif()
endfunction()

# armature_test_paths(janus_deployed_arming JANUS ${PROJECT_SOURCE_DIR}/robots/janus ...)
#
# Macros for the sources of a test. The paths are relative to the root of the tree, where tests run:
# so they are the same in each checkout, and ccache gives one what another has compiled.
function(armature_test_paths test)
  while(ARGN)
    list(POP_FRONT ARGN name path)
    target_compile_definitions(${test} PRIVATE "${name}=\"$<PATH:RELATIVE_PATH,${path},${PROJECT_SOURCE_DIR}>\"")
  endwhile()
endfunction()

# For a test that defines operator new to count allocations: the thread sanitizer of clang has its
# own, which cannot be replaced.
function(armature_counts_allocations test)
  if(ARMATURE_SANITIZE STREQUAL thread)
    armature_leave_out(${test})
  endif()
endfunction()

# armature_sanitized_cases(janus_deployed_switch "-SwitchTwice.*")
#
# The cases of a test that run under a sanitizer, as a filter of GoogleTest. Left out are long ones that
# differ from others in values alone: what a sanitizer can see in them, it sees in the others too.
function(armature_sanitized_cases test filter)
  if(ARMATURE_SANITIZE)
    set_tests_properties(${test} PROPERTIES ENVIRONMENT "GTEST_FILTER=${filter}")
  endif()
endfunction()

# The test is neither built nor run in this build.
function(armature_leave_out test)
  set_target_properties(${test} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  set_tests_properties(${test} PROPERTIES LABELS unneeded)
endfunction()

# The executable alone, for a test that does not run on this machine's own kernel.
function(armature_test_program)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;USES;LINK")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "armature_test(${arg_NAME}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  list(TRANSFORM arg_USES PREPEND armature::)
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE ${arg_USES} ${arg_LINK} GTest::gmock GTest::gtest_main)
  armature_warnings(${arg_NAME})
  if(ARMATURE_PARTS STREQUAL program)
    set_target_properties(${arg_NAME} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  endif()
  armature_test_options(${arg_NAME})
  if(TARGET armature_test_headers)
    target_compile_options(${arg_NAME} PRIVATE "SHELL:-Xclang -include-pch -Xclang ${ARMATURE_TEST_HEADERS}")
    set_property(SOURCE ${arg_SOURCES} APPEND PROPERTY
                 OBJECT_DEPENDS ${PROJECT_BINARY_DIR}/${ARMATURE_TEST_HEADERS})
  endif()
  set_target_properties(${arg_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
endfunction()

# armature_kernel_test(NAME wam_deployed_kernel_test SOURCES on_can_kernel_test.cpp
#                      WITH armature wam ${PROJECT_SOURCE_DIR}/robots/wam/deployments)
#
# A test that runs on the kernel of scripts/test-socketcan, or is skipped where there is none. WITH:
# targets, files and folders that it starts or reads, which are there at the paths that they have here.
function(armature_kernel_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;USES;WITH")
  armature_test_program(NAME ${arg_NAME} SOURCES ${arg_SOURCES} USES ${arg_USES})
  if(NOT TARGET kernel_tests)
    add_custom_target(kernel_tests)
  endif()
  add_dependencies(kernel_tests ${arg_NAME})
  set(with)
  foreach(each IN LISTS arg_WITH)
    if(TARGET ${each})
      add_dependencies(${arg_NAME} ${each})
      get_target_property(type ${each} TYPE)
      if(type STREQUAL EXECUTABLE)
        set(each $<TARGET_FILE:${each}>)
      else()
        set(each $<TARGET_LINKER_FILE:${each}>) # by which it is loaded
      endif()
    endif()
    list(APPEND with ${each})
  endforeach()
  add_test(NAME ${arg_NAME} COMMAND ${PROJECT_SOURCE_DIR}/scripts/test-socketcan $<TARGET_FILE:${arg_NAME}> ${with})
  set_tests_properties(${arg_NAME} PROPERTIES LABELS slow TIMEOUT 1200 SKIP_RETURN_CODE 77)
endfunction()

# armature_fuzz_target(NAME fuzz_yaml SOURCES fuzz_yaml.cpp USES deploy)
#
# A libFuzzer target with its corpus in the folder corpus/<NAME> beside it. With ARMATURE_FUZZ the
# test of that name fuzzes for 10 seconds from a fixed seed (a change is not refused for what another
# seed would have found before it; scripts/fuzz takes any), and keeps what it finds in
# build/asan/fuzz/<NAME>.found; without, it replays the corpus.
function(armature_fuzz_target)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;USES;LINK")
  list(TRANSFORM arg_USES PREPEND armature::)
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE ${arg_USES} ${arg_LINK})
  armature_warnings(${arg_NAME})
  set(folder ${PROJECT_BINARY_DIR}/fuzz)
  set_target_properties(${arg_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${folder})
  set(corpus ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${arg_NAME})
  if(ARMATURE_FUZZ)
    target_link_options(${arg_NAME} PRIVATE -fsanitize=fuzzer)
    add_dependencies(fuzz_targets ${arg_NAME})
    set(found ${folder}/${arg_NAME}.found)
    file(MAKE_DIRECTORY ${found})
    add_test(NAME ${arg_NAME} COMMAND ${arg_NAME} ${found} ${corpus} -artifact_prefix=${found}/
                                      -seed=1 -max_total_time=10 -timeout=10 -print_final_stats=1)
    set_tests_properties(${arg_NAME} PROPERTIES LABELS fuzz)
  else()
    target_sources(${arg_NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests/fuzz/replay.cpp)
    add_test(NAME ${arg_NAME} COMMAND ${arg_NAME} ${corpus})
  endif()
endfunction()
