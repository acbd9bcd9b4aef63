// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/log.hpp"

#include <charconv>

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

std::string LogArgument::to_text() const {
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
      return std::string(text_.view());
  }
  return {};
}

std::string LogRecord::message() const {
  std::string text;
  std::size_t next = 0;
  for (const char* at = format; *at != '\0'; ++at) {
    if (at[0] == '{' && at[1] == '}' && next < arguments.size()) {
      text += arguments[next++].to_text();
      ++at;
    } else {
      text += *at;
    }
  }
  return text;
}

}  // namespace armature::rt
