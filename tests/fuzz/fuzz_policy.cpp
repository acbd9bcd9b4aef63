// SPDX-License-Identifier: Apache-2.0
// What Policy::parse takes is written and read again, and has to be the same; what it does not take
// allows nothing.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "armature/ride/policy.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  base::Diagnostics diagnostics;
  const auto policy = ride::Policy::parse(text, "fuzz.policy", diagnostics);
  const bool allows_all = policy.allows({"tls", "anna", "Vision", ride::Access::kRead}) &&
                          policy.allows({"unix", "", "Arm", ride::Access::kConfigure});
  const std::string written = policy.to_text();
  const auto again = ride::Policy::parse(written, "again.policy", diagnostics);
  const bool is_same = again.to_text() == written;
  const bool is_closed = diagnostics.ok() || (policy.rules().empty() && !allows_all);
  if (is_same && is_closed) return 0;
  std::fprintf(stderr, "the policy has changed, or is open in spite of mistakes:\n%s%s",
               written.c_str(), diagnostics.to_text().c_str());
  std::abort();
}
