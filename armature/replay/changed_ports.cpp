// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/changed_ports.hpp"

#include "armature/base/utf8.hpp"
#include "armature/component/interface.hpp"

namespace armature::replay {
namespace {

constexpr std::size_t kLongest = 80;

/// No letter of more than one byte is cut in two.
std::string cut_off(std::string text) {
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while (end > 0 && base::continues_character(text[end])) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

ChangedPorts::ChangedPorts(const exec::Application& application) {
  for (const exec::Index index : application.plan().start_order) {
    const component::Component& component = *application.blueprint().components[index].component;
    for (const auto* port : component::interface_of(component).outputs) {
      ports_.push_back({component.name() + '.' + port->name(), port, 0, {}});
    }
  }
}

std::string ChangedPorts::look() {
  std::string changes;
  for (Seen& seen : ports_) {
    const std::uint64_t sequence = seen.port->current_sequence();
    if (sequence == seen.sequence) continue;
    seen.sequence = sequence;
    std::string value = types::to_text(seen.port->type(), seen.port->current());
    if (value == seen.value) continue;
    seen.value = std::move(value);
    changes += (changes.empty() ? "" : ", ") + seen.name + " = " + cut_off(seen.value);
  }
  return changes;
}

}  // namespace armature::replay
