// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "armature/orocos/property_file.hpp"
#include "tests/fuzz/round_trip.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const document::Limits limits = fuzz::options().limits;
  base::Diagnostics diagnostics;
  const auto properties = orocos::parse_cpf(text, "fuzz.cpf", diagnostics, limits);
  if (!diagnostics.ok()) return 0;
  const std::string written = orocos::write_cpf(properties);
  const auto again = orocos::parse_cpf(written, "again.cpf", diagnostics);
  if (!diagnostics.ok()) fuzz::fail(diagnostics.to_text().c_str(), written, "");
  if (const std::string after = orocos::write_cpf(again); after != written) {
    fuzz::fail("the properties have changed", written, after);
  }
  return 0;
}
