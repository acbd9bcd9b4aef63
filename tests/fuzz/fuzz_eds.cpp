// SPDX-License-Identifier: Apache-2.0
// What parse_eds takes is written and read again, and has to be the same.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "drives/canopen/eds.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  base::Diagnostics diagnostics;
  const auto eds = canopen::parse_eds(text, "fuzz.eds", 3, diagnostics);
  if (!eds) {
    if (!diagnostics.ok()) return 0;
    std::fprintf(stderr, "refused without a reason\n");
    std::abort();
  }
  canopen::ObjectDictionary dictionary;
  canopen::add_objects(*eds, dictionary);
  const std::string written = canopen::to_text(*eds);
  if (canopen::parse_eds(written, "again.eds", 3, diagnostics) == eds) return 0;
  std::fprintf(stderr, "the file has changed:\n%s%s", written.c_str(),
               diagnostics.to_text().c_str());
  std::abort();
}
