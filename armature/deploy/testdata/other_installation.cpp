// SPDX-License-Identifier: Apache-2.0
// Stands for a library of another installation: by its name, with nothing that the right one has.
extern "C" int of_another_installation() { return 1; }
