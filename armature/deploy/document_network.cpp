// SPDX-License-Identifier: Apache-2.0
// The section `network`.
#include "armature/deploy/internal/document_network.hpp"

#include <utility>

#include "armature/deploy/internal/document_reader.hpp"

namespace armature::deploy::internal {
namespace {

void read_path(const Value* value, std::string_view what, const ValueReader& reader,
               Reference& path) {
  if (value == nullptr) return;
  path.where = value->where;
  assign(reader.text(*value, what), path.name);
}

/// Half of what proves who somebody is proves nothing.
void read_tls(const Value& value, const ValueReader& reader, Network& network) {
  Fields fields(value, reader);
  const std::pair<const char*, Reference*> kFiles[] = {{"certificate", &network.certificate},
                                                       {"key", &network.key},
                                                       {"authority", &network.authority}};
  for (const auto& [key, file] : kFiles) {
    const Value* const given = fields.take(key);
    read_path(given, std::string(key) + " of tls", reader, *file);
    if (given == nullptr) {
      reader.error(value.where, "tls has no '" + std::string(key) + "'",
                   "it needs the files certificate, key and authority");
    }
  }
  fields.refuse_others();
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
  if (const Value* tls = fields.take("tls")) read_tls(*tls, reader, network);
  fields.refuse_others();
  return network;
}

}  // namespace armature::deploy::internal
