// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/journal.hpp"

#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include "armature/platform/file.hpp"

namespace armature::studio::internal {

using Json = nlohmann::json;

namespace {

/// Files hold any bytes, JSON only UTF-8: so a byte is a character of it.
Json::string_t as_characters(const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) {
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0x80) {
      text += byte;
    } else {
      text += static_cast<char>(0xC0 | (code >> 6));
      text += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return text;
}

std::string as_bytes(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    if (code < 0x80 || i + 1 == text.size()) {
      bytes += text[i];
    } else {
      bytes += static_cast<char>(((code & 0x03) << 6) | (text[++i] & 0x3F));
    }
  }
  return bytes;
}

}  // namespace

Unsaved Journal::left() const {
  Unsaved unsaved;
  const auto text = platform::read_file(path_);
  const Json json = Json::parse(text ? text.value() : "", nullptr, false);
  if (!json.is_object()) return unsaved;
  for (const auto& [path, file] : json.items()) {
    const bool whole = file.is_object() && file.contains("text") && file.contains("disk") &&
                       file["text"].is_string() && file["disk"].is_string();
    if (!whole) return {};
    unsaved[path] = {as_bytes(file["text"]), as_bytes(file["disk"])};
  }
  return unsaved;
}

base::Result<void> Journal::keep(const Unsaved& unsaved) const {
  if (unsaved.empty()) {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    return {};
  }
  Json json = Json::object();
  for (const auto& [path, file] : unsaved) {
    json[path] = {{"text", as_characters(file.text)}, {"disk", as_characters(file.disk)}};
  }
  return platform::write_file(path_, json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace armature::studio::internal
