# SPDX-License-Identifier: Apache-2.0
# What the toolchain files of boards have in common. Debian's cross compilers bring the C and C++
# libraries in /usr/<triplet> and nothing else; programs run there under qemu's user emulation.
set(CMAKE_C_COMPILER ${triplet}-gcc)
set(CMAKE_CXX_COMPILER ${triplet}-g++)
set(CMAKE_STRIP ${triplet}-strip)
# With the root of a system for the board (scripts/sysroot) all of it is there.
set(root /usr/${triplet})
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ARMATURE_SYSROOT)
if(ARMATURE_SYSROOT)
  set(root ${ARMATURE_SYSROOT})
  set(CMAKE_SYSROOT ${root})
  set(CMAKE_LIBRARY_ARCHITECTURE ${triplet})
endif()
set(CMAKE_CROSSCOMPILING_EMULATOR ${emulator} -L ${root})
set(CMAKE_FIND_ROOT_PATH ${root})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
