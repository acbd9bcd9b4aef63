# SPDX-License-Identifier: Apache-2.0
# cmake --install: headers, libraries, the program and what find_package(armature) needs.
