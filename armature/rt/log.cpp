// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/log.hpp"

#include <algorithm>

namespace armature::rt {

LogArgument LogArgument::without_text() const {
  LogArgument bare = *this;
  bare.text_ = {};
  return bare;
}

void LogRecord::take(std::span<const LogArgument> arguments) {
  constexpr std::string_view kCut = "...";
  texts_.clear();
  arguments_.fill({});
  for (std::size_t i = 0; i < kArguments; ++i) {
    if (i < arguments.size()) {
      arguments_[i] = arguments[i].without_text();
      const std::string_view text = arguments[i].text();
      // Each that follows can say at least that it is cut.
      const auto others = arguments.subspan(i + 1);
      const auto texts = std::ranges::count_if(others, &LogArgument::is_text);
      const std::size_t of_others = static_cast<std::size_t>(texts) * kCut.size();
      const std::size_t room = kTextRoom - of_others - texts_.view().size();
      if (text.size() <= room) {
        texts_.append(text);
      } else {
        texts_.append(text.substr(0, room - kCut.size())).append(kCut);
      }
    }
    text_ends_[i] = static_cast<std::uint16_t>(texts_.view().size());
  }
}

}  // namespace armature::rt
