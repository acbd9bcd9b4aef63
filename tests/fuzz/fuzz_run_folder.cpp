// SPDX-License-Identifier: Apache-2.0
// The folder of a run may come from anybody: whatever its acts and its experiment say, they are
// read, or refused with the place and the reason.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "armature/replay/acts.hpp"
#include "armature/replay/experiment.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto acts = replay::parse_acts(text, "acts.jsonl");
  const auto experiment = replay::parse_experiment(text, "experiment.json");
  const bool acts_say_why = acts.ok() || acts.error().starts_with("acts.jsonl:");
  const bool experiment_says_why =
      experiment.ok() || experiment.error().starts_with("'experiment.json'");
  if (acts_say_why && experiment_says_why) return 0;
  std::fprintf(stderr, "it was refused without its place\n");
  std::abort();
}
