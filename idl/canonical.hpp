// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "idl/model.hpp"

namespace armature::idl {

// Declarations in the one form that both sides of a connection hash: types and names of what is
// called, structs and enums written out. `program` is one that was loaded without errors.

/// `Array<struct Pose{double,double},3>`
std::string canonical(const Program& program, const Type& type);
/// `enum Mode:byte{idle=0,position=4}`, whose names count, as both sides use them
std::string canonical(const Enumeration& enumeration);
/// `event ObjectPosition{int,int}`, `struct Pose{double,double}`
std::string canonical(const Program& program, const Structure& structure);
/// `void setVelocity(float,float)`
std::string canonical(const Program& program, const Operation& operation);

/// What stands for a declaration on the wire: the 32-bit FNV-1a hash of its canonical form.
std::uint32_t number_of(std::string_view canonical);

/// The canonical declarations of all operations and events of an interface, sorted.
std::vector<std::string> declarations(const Program& program, const Interface& interface);

/// The hash of `declarations` joined by `;`: equal exactly if both sides mean the same interface.
std::uint32_t digest(const Program& program, const Interface& interface);

}  // namespace armature::idl
