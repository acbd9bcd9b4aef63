// SPDX-License-Identifier: Apache-2.0
// A message of a client of Foxglove is taken or refused with a reason, and what would be set by it
// is a text or refused; and values that are told as files have them become JSON whatever they are.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <variant>

#include "armature/foxglove/internal/flow_json.hpp"
#include "armature/foxglove/internal/protocol.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature::foxglove::internal;
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  const auto request = parse_request(content);
  if (!request && request.error().empty()) std::abort();
  if (request) {
    if (const auto* set = std::get_if<SetParameters>(&request.value())) {
      for (const Parameter& one : set->parameters) {
        const auto text = text_of_json(one.value);
        if (!text && text.error().empty()) std::abort();
      }
    }
  }
  const Shape list = shape_of("vector<double>", {});
  if (text_of(json_of_text(list, std::string(content))).empty()) std::abort();
  return 0;
}
