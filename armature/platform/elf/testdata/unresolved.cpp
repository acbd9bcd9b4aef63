// SPDX-License-Identifier: Apache-2.0
// A shared object that needs what no library has.
extern "C" int function_that_nobody_has();
extern "C" int needs_it() { return function_that_nobody_has(); }
