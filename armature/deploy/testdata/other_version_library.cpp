// SPDX-License-Identifier: Apache-2.0
extern "C" int of_another_installation();
extern "C" int uses_another_installation() { return of_another_installation(); }
