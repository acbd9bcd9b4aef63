# SPDX-License-Identifier: Apache-2.0
# cmake -D PROGRAM=... -D ARGUMENTS=a;b -D EXPECTED=file -P run_and_compare.cmake
# Fails if the program fails or says something else on standard error than the file holds.
execute_process(COMMAND ${PROGRAM} ${ARGUMENTS} RESULT_VARIABLE status ERROR_VARIABLE said)
file(READ ${EXPECTED} expected)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "exit status ${status}:\n${said}")
endif()
if(NOT said STREQUAL expected)
  message(FATAL_ERROR "it said:\n${said}\nexpected was:\n${expected}")
endif()
