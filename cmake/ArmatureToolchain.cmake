# SPDX-License-Identifier: Apache-2.0
# Language, compiler and linker settings of everything in this tree.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
endif()
# Assertions stay on while developing; only Release turns them off.
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")

# -O3 makes the libraries half as large again, and a process keeps all of that in memory.
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

# For what never runs in real time, so that a process has little memory to keep.
function(armature_compact target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Os>)
endfunction()

# Most runs do not need this library: while an application runs, its code may not be in memory
# (cli/release_code.cpp). So what it instantiated of the standard library is not for others.
function(armature_not_in_every_run target)
  set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
  target_link_options(${target} PRIVATE LINKER:--version-script=${exports})
  set_target_properties(${target} PROPERTIES LINK_DEPENDS ${exports})
endfunction()

# Time goes on after 2038, also where a register has 32 bits.
if(CMAKE_SIZEOF_VOID_P EQUAL 4)
  add_compile_definitions(_TIME_BITS=64 _FILE_OFFSET_BITS=64)
endif()

# A fused multiply-add here and none there would make simulations differ between machines.
add_compile_options(-ffp-contract=off)

option(ARMATURE_WERROR "Treat warnings as errors" OFF)
function(armature_warnings target)
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow -Wpedantic -Wnon-virtual-dtor
                      $<$<BOOL:${ARMATURE_WERROR}>:-Werror>
                      # std::stable_sort of libstdc++ 12 itself uses a deprecated function
                      $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>
                      # GCC 12 warns of "text" + std::string (its bug 105651)
                      $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endfunction()

# The same layout as an installation, so that the program finds its libraries in the same way.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_INSTALL_RPATH $ORIGIN $ORIGIN/../${CMAKE_INSTALL_LIBDIR})

set(ARMATURE_SANITIZE "" CACHE STRING
    "Sanitizers as -fsanitize= takes them, such as address,undefined, thread or realtime")
set(ARMATURE_UNITY 1 CACHE STRING
    "So many sources of a library are compiled at a time: half the time for all of them, more for
one that changed; needs what each source file names for itself to be named once")
function(armature_unity target)
  if(ARMATURE_UNITY GREATER 1)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${ARMATURE_UNITY})
    # A class of a source file may have members of types that only this file knows (GCC), and a
    # function variables that are called like constants of another (clang).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>
                                             $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
  endif()
endfunction()
option(ARMATURE_FUZZ "Build the fuzz targets (clang only)" OFF)
# A sanitizer of threads has nothing to find where there is one, and building takes most of its time.
set(ARMATURE_TESTS "." CACHE STRING
    "Regular expression: of the tests in C++, only those with such a name are built and run")
# A test that is too slow or meaningless under a sanitizer can ask for it: "" if there is none.
add_compile_definitions(ARMATURE_SANITIZER="${ARMATURE_SANITIZE}")
if(ARMATURE_SANITIZE)
  # -O1 -g1 is enough for their reports, and compiles in half the time.
  add_compile_options(-fsanitize=${ARMATURE_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer -O1 -g1)
  add_link_options(-fsanitize=${ARMATURE_SANITIZE})
endif()
if(ARMATURE_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()

find_program(ARMATURE_CCACHE ccache)
if(ARMATURE_CCACHE)
  # Paths inside the checkout are not part of the key: clones and worktrees share what was compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros
      ${ARMATURE_CCACHE})
endif()
find_program(ARMATURE_MOLD mold)
if(ARMATURE_MOLD AND NOT CMAKE_CROSSCOMPILING)
  add_link_options(-fuse-ld=mold)
endif()
