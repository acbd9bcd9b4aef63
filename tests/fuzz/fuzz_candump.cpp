// SPDX-License-Identifier: Apache-2.0
// What parse_candump takes is written and read again, and has to be the same.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "armature/can/candump.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  base::Diagnostics diagnostics;
  const auto entries = can::parse_candump(text, "fuzz.log", diagnostics);
  if (!diagnostics.ok()) return 0;
  const std::string written = can::to_text(entries);
  if (can::parse_candump(written, "again.log", diagnostics) == entries) return 0;
  std::fprintf(stderr, "the log has changed:\n%s%s", written.c_str(),
               diagnostics.to_text().c_str());
  std::abort();
}
