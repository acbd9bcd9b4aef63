// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/tokens.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "armature/platform/file.hpp"

namespace armature::websocket::internal {
namespace {

constexpr std::size_t kMostBytes = 1 << 16;
constexpr std::string_view kWhite = " \t\r";

std::string_view without_white(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kWhite);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(kWhite) + 1 - begin);
}

bool is_token(std::string_view text) {
  return text.size() >= 16 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Origin and token.
std::optional<std::pair<std::string, std::string>> entry_in(std::string_view line) {
  const std::size_t hash = line.find("/#");
  const bool known = line.starts_with("http://") || line.starts_with("https://");
  if (!known || hash == std::string_view::npos || !is_token(line.substr(hash + 2))) {
    return std::nullopt;
  }
  return std::pair(std::string(line.substr(0, hash)), std::string(line.substr(hash + 2)));
}

void warn_of_readers_of_tokens(const std::string& path, base::Diagnostics& diagnostics) {
  using std::filesystem::perms;
  std::error_code failed;
  const perms others = std::filesystem::status(path, failed).permissions() & perms::others_read;
  if (failed || others == perms::none) return;
  diagnostics.warning({path, 0, 0}, "everyone on this machine may read the tokens", "chmod 600");
}

}  // namespace

Tokens Tokens::load(const std::string& path, base::Diagnostics& diagnostics) {
  if (path.empty()) return {};
  const auto text = platform::read_file(path, kMostBytes);
  if (!text) {
    diagnostics.error({path, 0, 0}, "the file of tokens cannot be read: " + text.error());
    return {};
  }
  warn_of_readers_of_tokens(path, diagnostics);
  return parse(text.value(), path, diagnostics);
}

Tokens Tokens::parse(std::string_view text, const std::string& file,
                     base::Diagnostics& diagnostics) {
  Tokens tokens;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = without_white(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    if (line.empty()) continue;
    if (auto entry = entry_in(line)) {
      tokens.by_origin_.insert_or_assign(std::move(entry->first), std::move(entry->second));
    } else {  // without the line itself: it may be half a secret
      diagnostics.error({file, number, 1}, "the line is no address of pages with its token",
                        "copy what the application says: http://127.0.0.1:8080/#4a33...");
    }
  }
  return tokens;
}

std::string Tokens::of(const std::string& origin) const {
  const auto found = by_origin_.find(origin);
  return found == by_origin_.end() ? std::string() : found->second;
}

}  // namespace armature::websocket::internal
