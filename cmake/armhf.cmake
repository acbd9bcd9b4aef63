# SPDX-License-Identifier: Apache-2.0
# A board with 32-bit ARM (ARMv7 with floating point, as Debian's armhf has it).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(triplet arm-linux-gnueabihf)
set(emulator qemu-arm)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)

# GCC notes at every vector that its ABI once was another.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
