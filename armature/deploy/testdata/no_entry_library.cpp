// SPDX-License-Identifier: Apache-2.0
// A shared object, but no component library.
extern "C" __attribute__((visibility("default"))) int answer() { return 42; }
