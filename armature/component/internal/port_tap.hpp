// SPDX-License-Identifier: Apache-2.0
#pragma once

// How the samples of an output port reach a tap.

#include <cstddef>
#include <cstdint>
#include <memory>

#include "armature/component/observing/tap.hpp"

namespace armature::component::internal {

class SampleForm;

/// The writer copies every n-th sample, and the reader brings it into its binary form.
/// @param value  of the port's type, in the shape that the port has
std::unique_ptr<AttachedTap> make_port_tap(const SampleForm& form, bool is_small, const void* value,
                                           std::size_t capacity, std::uint64_t every);

}  // namespace armature::component::internal
