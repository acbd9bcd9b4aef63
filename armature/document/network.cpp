// SPDX-License-Identifier: Apache-2.0
// The section `network`.
#include "armature/document/network.hpp"

#include <charconv>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "armature/document/reader.hpp"

namespace armature::document {
namespace {

void read_path(const Value* value, std::string_view what, const ValueReader& reader,
               Reference& path) {
  if (value == nullptr) return;
  path.where = value->where;
  assign(reader.text(*value, what), path.name);
}

/// Half of what proves who somebody is proves nothing. Pages have no certificates: an authority is
/// needed by those that have, and alone by those who only connect.
void read_tls(const Value& value, const ValueReader& reader, Network& network) {
  Fields fields(value, reader);
  const auto take = [&](const char* key, Reference& file) {
    const Value* const given = fields.take(key);
    read_path(given, std::string(key) + " of tls", reader, file);
    return given != nullptr;
  };
  const bool certificate = take("certificate", network.certificate);
  const bool key = take("key", network.key);
  const bool authority = take("authority", network.authority);
  const bool only_connects = authority && !certificate && !key;
  const std::pair<const char*, bool> kOwn[] = {{"certificate", certificate}, {"key", key}};
  for (const auto& [name, given] : kOwn) {
    if (given || only_connects) continue;
    reader.error(value.where, "tls has no '" + std::string(name) + "'",
                 "it needs the files certificate and key, and for tls:// the authority");
  }
  fields.refuse_others();
}

/// `0660`, as chmod has it.
std::optional<unsigned> read_mode(const Value& value, const ValueReader& reader) {
  const auto text = reader.text(value, "socket_mode");
  if (!text) return std::nullopt;
  constexpr unsigned kMost = 0777;
  unsigned mode = 0;
  const char* const end = text->data() + text->size();
  const auto [last, problem] = std::from_chars(text->data(), end, mode, 8);
  if (problem == std::errc{} && last == end && mode <= kMost && text->size() >= 3) return mode;
  reader.error(value.where,
               "socket_mode must be file permissions as chmod has them, found '" + *text + "'",
               "for example 0600 or 0660");
  return std::nullopt;
}

/// `{most: 20, least: 10}`
std::optional<Serving> read_serving(const Value& value, const ValueReader& reader) {
  constexpr int kHighest = 99;
  Serving serving;
  serving.where = value.where;
  Fields fields(value, reader);
  bool whole = true;
  const std::pair<const char*, int*> kEnds[] = {{"most", &serving.most}, {"least", &serving.least}};
  for (const auto& [key, priority] : kEnds) {
    const Value* const given = fields.take(key);
    const auto read = given == nullptr ? std::nullopt
                                       : reader.whole_number(
                                             *given, std::string(key) + " of serving", 1, kHighest);
    if (given == nullptr)
      reader.error(value.where, "serving has no '" + std::string(key) + "'",
                   "for example serving: {most: 20, least: 10}");
    whole &= read.has_value();
    *priority = read.value_or(0);
  }
  fields.refuse_others();
  if (!whole) return std::nullopt;
  if (serving.least <= serving.most) return serving;
  reader.error(value.where, "least of serving is above most", "exchange them");
  return std::nullopt;
}

}  // namespace

Network read_network(const Value& value, const ValueReader& reader) {
  Network network;
  Fields fields(value, reader);
  for (const Value* address : items_of(fields.take("listen"))) {
    if (auto text = reader.text(*address, "listen")) {
      network.listen.push_back({std::move(*text), address->where});
    }
  }
  for (const Value* input : items_of(fields.take("inputs"))) {
    if (auto connection = read_input(*input, reader)) {
      network.inputs.push_back(std::move(*connection));
    }
  }
  read_path(fields.take("policy"), "policy", reader, network.policy);
  read_path(fields.take("pages"), "pages", reader, network.pages);
  if (const Value* tls = fields.take("tls")) read_tls(*tls, reader, network);
  if (const Value* memory = fields.take("memory_kB")) {
    constexpr int kLeast = 1000;
    constexpr int kMost = 2'000'000;
    network.memory_kb = reader.whole_number(*memory, "memory_kB of network", kLeast, kMost);
  }
  if (const Value* mode = fields.take("socket_mode")) {
    network.socket_mode = read_mode(*mode, reader);
  }
  if (const Value* serving = fields.take("serving")) {
    network.serving = read_serving(*serving, reader);
  }
  fields.refuse_others();
  return network;
}

}  // namespace armature::document
