// SPDX-License-Identifier: Apache-2.0
// Not part of the program: how long this compiles is the reference of compile_time.
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

int main() { return 0; }
