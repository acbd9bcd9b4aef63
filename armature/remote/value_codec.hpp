// SPDX-License-Identifier: Apache-2.0
#pragma once

// Values on the wire that are known by their description only (docs/ride.md, "Body").

#include <string>

#include "armature/component/operations/signature.hpp"
#include "armature/ride/codec.hpp"
#include "armature/types/type.hpp"

namespace armature::remote {

/// The type as the interface language has it: `Array<double>`, `struct Pose{double,double}`. 8-bit
/// integers are `char` and `byte`; texts of both kinds `String`; `enum Mode:byte{off=0,on=1}`.
std::string canonical(const types::Type& type);

/// False if values of the type are made by its own class only, so that no peer may send one.
bool can_travel(const types::Type& type);

/// A value somewhere in memory, to be sent.
struct Outgoing {
  const types::Type* type;
  const void* data;
};
void encode(ride::Encoder& to, const Outgoing& value);

/// Arguments of an operation, command or event, where they are, to be sent.
struct OutgoingArguments {
  const component::Signature* signature;
  const void* const* arguments;
};
void encode(ride::Encoder& to, const OutgoingArguments& all);

/// A place for a value that is received.
struct Incoming {
  const types::Type* type;
  void* data;
};
/// False if the body has no such value; a text is longer than there is room for, or a number
/// is none of the enumeration's. The place may hold
/// a part of it then.
bool decode(ride::Decoder& from, Incoming& value);

}  // namespace armature::remote
