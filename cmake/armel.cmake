# SPDX-License-Identifier: Apache-2.0
# A board with 32-bit ARM that has neither floating point nor atomics of its own (ARMv5TE, as Debian's armel has it).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv5tel)
set(triplet arm-linux-gnueabi)
set(emulator qemu-arm -cpu arm926)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)

# GCC notes at every vector that its ABI once was another.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
