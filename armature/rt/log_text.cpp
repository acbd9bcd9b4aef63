// SPDX-License-Identifier: Apache-2.0
// How log lines become text: apart from how they are kept, which small programs have without it.
#include <charconv>

#include "armature/rt/log.hpp"

namespace armature::rt {
namespace {

template <typename Number>
std::string number_text(Number value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

}  // namespace

std::string_view name_of(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return "debug";
    case LogLevel::kInfo:
      return "info";
    case LogLevel::kWarning:
      return "warning";
    case LogLevel::kError:
      return "error";
  }
  return "error";
}

std::string LogArgument::to_text(std::string_view text) const {
  switch (kind_) {
    case Kind::kNone:
      return {};
    case Kind::kSigned:
      return number_text(signed_);
    case Kind::kUnsigned:
      return number_text(unsigned_);
    case Kind::kDouble:
      return number_text(double_);
    case Kind::kBool:
      return unsigned_ != 0 ? "true" : "false";
    case Kind::kText:
      return std::string(text);
  }
  return {};
}

std::string LogRecord::message() const {
  std::string text;
  std::size_t next = 0;
  for (const char* at = format; *at != '\0'; ++at) {
    if (at[0] == '{' && at[1] == '}' && next < kArguments) {
      const std::size_t begin = next == 0 ? 0 : text_ends_[next - 1];
      text += arguments_[next].to_text(texts_.view().substr(begin, text_ends_[next] - begin));
      ++next;
      ++at;
    } else {
      text += *at;
    }
  }
  return text;
}

}  // namespace armature::rt
