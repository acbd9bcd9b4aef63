// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/round_trip.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  base::Diagnostics diagnostics;
  const document::Document document =
      deploy::parse_document(text, "fuzz.yaml", fuzz::options(), diagnostics);
  if (diagnostics.ok()) fuzz::check_round_trip(document);
  return 0;
}
