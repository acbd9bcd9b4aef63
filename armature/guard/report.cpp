// SPDX-License-Identifier: Apache-2.0
#include "armature/guard/internal/report.hpp"

#include "armature/base/quoted.hpp"

namespace armature::guard {

using base::quoted;

namespace {

std::string counted(std::uint64_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string call_text(const Sighting& sighting) {
  const std::string detail(sighting.detail.view());
  if (sighting.call == std::string_view("throw"))
    return "threw " + platform::demangled(detail.c_str());
  return std::string("called ") + sighting.call + "(" + detail + ")";
}

/// Deeper than this lies only how the runtime came to call the component.
bool ends_stack(const std::string& function) {
  return function.rfind("armature::exec::Engine::", 0) == 0;
}

}  // namespace

std::string describe(const Place& place, platform::Symbols& symbols) {
  const Sighting& first = place.first;
  const std::string who =
      first.component.empty() ? "no component, but the runtime," : quoted(first.component);
  std::string text = who + " in thread " + quoted(first.thread) + " " + call_text(first) + ", " +
                     counted(place.count.load(std::memory_order_relaxed), "time") + "\n";
  for (std::size_t i = 0; i < first.frame_count; ++i) {
    const platform::Symbols::Function function = symbols.at(first.frames[i]);
    text += "    " + (function.name.empty() ? std::string("?") : function.name) + "  [" +
            function.place + "]\n";
    if (ends_stack(function.name)) break;
  }
  return text;
}

std::string summary(const Places& places) {
  std::uint64_t known = 0;
  for (const Place& place : places.all()) known += place.complete ? 1 : 0;
  std::string text = counted(places.violations(), "violation") + " at " + counted(known, "place");
  if (places.elsewhere() > 0) text += " and " + std::to_string(places.elsewhere()) + " elsewhere";
  return text;
}

}  // namespace armature::guard
