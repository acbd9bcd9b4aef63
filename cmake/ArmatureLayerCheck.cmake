# SPDX-License-Identifier: Apache-2.0
# Every build looks at what the files include; the check itself is tested too.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(check_layers ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/check_layers.py
                 ${PROJECT_SOURCE_DIR})

add_custom_target(check_layers ALL COMMAND ${check_layers} COMMENT "Checking the layers")
add_test(NAME layers COMMAND ${check_layers})
add_test(NAME layers_self_test COMMAND ${Python3_EXECUTABLE}
                                       ${PROJECT_SOURCE_DIR}/cmake/check_layers_test.py)
